"""Draw the changes of the critical length with parameters and definitions."""

from pathlib import Path

from nucleation import datasets
from nucleation.figures import figure_sensitivity, style

drawn = figure_sensitivity.draw(datasets.read(snakemake.input.table))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
