"""Draw Figure 1."""

from pathlib import Path

from nucleation.figures import figure_1, style

style.save(figure_1.draw(), Path(snakemake.output[0]).with_suffix(""))
