"""Draw Figure 2."""

from pathlib import Path

from nucleation.datasets import netcdf
from nucleation.figures import style
from nucleation.figures.paper import figure_2

drawn = figure_2.draw(netcdf.read(snakemake.input.theory))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
