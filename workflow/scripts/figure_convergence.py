"""Draw critical lengths against mesh and steps, and the hops of the front."""

from pathlib import Path

from nucleation import datasets
from nucleation.figures import figure_convergence, style

drawn = figure_convergence.draw(
    datasets.read(snakemake.input.table),
    [datasets.read(path) for path in snakemake.input.hops],
    datasets.read(snakemake.input.patch),
)
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
