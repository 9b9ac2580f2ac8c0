"""Draw the growth of the frozen patches, the shape of their modes, and twin runs."""

from pathlib import Path

from nucleation import datasets
from nucleation.figures import figure_patch_stability, style

drawn = figure_patch_stability.draw(
    datasets.read(snakemake.input.table),
    [datasets.read(path) for path in snakemake.input.patches],
    datasets.read(snakemake.input.twins),
)
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
