"""Draw the growth of the frozen patches, the shape of their modes, and twin runs."""

from pathlib import Path

from nucleation.datasets import netcdf
from nucleation.figures import style
from nucleation.figures.beyond import figure_patch_stability

drawn = figure_patch_stability.draw(
    netcdf.read(snakemake.input.table),
    [netcdf.read(path) for path in snakemake.input.patches],
    netcdf.read(snakemake.input.twins),
)
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
