"""Draw Figure S1."""

from pathlib import Path

from nucleation import datasets
from nucleation.figures import figure_s1, style

drawn = figure_s1.draw(datasets.read(snakemake.input.theory))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
