"""Write the article on the replication from its template."""

import json
from pathlib import Path

from nucleation import article, datasets

given = snakemake.input
text = article.render(
    snakemake.params.template,
    json.loads(Path(given.claims).read_text(encoding="utf-8")),
    [datasets.read(path) for path in given.lengths],
)
datasets.write_text(text, snakemake.output[0])
