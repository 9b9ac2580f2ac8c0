"""Draw the crosscheck's figure."""

from pathlib import Path

import numpy as np
from nucleation.analysis.definitions import ExtractionSettings
from nucleation.datasets import netcdf
from nucleation.figures import style
from nucleation.figures.checks import figure_crosscheck
from nucleation.verification.crosscheck import plan

params, own, freefem = snakemake.params, snakemake.input.own, snakemake.input.freefem
table = netcdf.read(snakemake.input.table)
shown = [i for i, name in enumerate(params.ids) if name != plan.TIMING]
drawn = figure_crosscheck.draw(
    [(netcdf.read(own[i]), netcdf.read(freefem[i])) for i in shown],
    table.isel(run=np.array(shown)),
    ExtractionSettings(**params.extraction),
)
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
