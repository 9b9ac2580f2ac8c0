"""Draw Figure S1."""

from pathlib import Path

from nucleation.datasets import netcdf
from nucleation.figures import style
from nucleation.figures.paper import figure_s1

drawn = figure_s1.draw(netcdf.read(snakemake.input.theory))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
