"""Draw the changes of the critical length with parameters and definitions."""

from pathlib import Path

from nucleation.datasets import netcdf
from nucleation.figures import style
from nucleation.figures.beyond import figure_sensitivity

drawn = figure_sensitivity.draw(netcdf.read(snakemake.input.table))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
