"""Draw the orders of convergence."""

from pathlib import Path

from nucleation.datasets import netcdf
from nucleation.figures import style
from nucleation.figures.checks import figure_verification

drawn = figure_verification.draw(netcdf.read(snakemake.input.verification))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
