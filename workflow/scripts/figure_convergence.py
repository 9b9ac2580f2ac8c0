"""Draw critical lengths against mesh and steps, and the hops of the front."""

from pathlib import Path

from nucleation.datasets import netcdf
from nucleation.figures import style
from nucleation.figures.checks import figure_convergence

drawn = figure_convergence.draw(
    netcdf.read(snakemake.input.table),
    [netcdf.read(path) for path in snakemake.input.hops],
    netcdf.read(snakemake.input.patch),
)
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
