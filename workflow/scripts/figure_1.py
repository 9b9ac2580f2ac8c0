"""Draw Figure 1."""

from pathlib import Path

from nucleation.figures import style
from nucleation.figures.paper import figure_1

drawn = figure_1.draw()
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
