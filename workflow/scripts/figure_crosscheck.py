"""Draw the crosscheck's figure."""

from pathlib import Path

import numpy as np
from nucleation import crosscheck, datasets
from nucleation.figures import figure_crosscheck, style
from nucleation.settings import ExtractionSettings

params, own, freefem = snakemake.params, snakemake.input.own, snakemake.input.freefem
table = datasets.read(snakemake.input.table)
shown = [i for i, name in enumerate(params.ids) if name != crosscheck.TIMING]
drawn = figure_crosscheck.draw(
    [(datasets.read(own[i]), datasets.read(freefem[i])) for i in shown],
    table.isel(run=np.array(shown)),
    ExtractionSettings(**params.extraction),
)
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
