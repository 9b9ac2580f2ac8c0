"""Draw Figure 2."""

from pathlib import Path

from nucleation import datasets
from nucleation.figures import figure_2, style

drawn = figure_2.draw(datasets.read(snakemake.input.theory))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
