"""Draw the dispersion figure."""

from pathlib import Path

from nucleation import datasets
from nucleation.figures import figure_dispersion, style

drawn = figure_dispersion.draw(datasets.read(snakemake.input.dispersion))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
