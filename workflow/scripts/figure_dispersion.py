"""Draw the dispersion figure."""

from pathlib import Path

from nucleation.datasets import netcdf
from nucleation.figures import style
from nucleation.figures.checks import figure_dispersion

drawn = figure_dispersion.draw(netcdf.read(snakemake.input.dispersion))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
