"""Draw the orders of convergence."""

from pathlib import Path

from nucleation import datasets
from nucleation.figures import figure_verification, style

drawn = figure_verification.draw(datasets.read(snakemake.input.convergence))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
