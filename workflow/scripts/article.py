"""Write the article on the replication from its template."""

import json
from pathlib import Path

from nucleation.claims import article
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    text = article.render(
        job.params.template,
        json.loads(Path(job.input.claims).read_text(encoding="utf-8")),
        list(job.read_all(job.input.lengths)),
    )
    job.write_text(text, job.output[0])
