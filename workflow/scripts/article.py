"""Write the article on the replication from its template."""

import json
from pathlib import Path

from nucleation.claims import article
from nucleation.datasets import netcdf

given = snakemake.input
text = article.render(
    snakemake.params.template,
    json.loads(Path(given.claims).read_text(encoding="utf-8")),
    [netcdf.read(path) for path in given.lengths],
)
netcdf.write_text(text, snakemake.output[0])
