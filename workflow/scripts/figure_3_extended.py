"""Draw Figure 3 with the lengths at which the patches turn unstable."""

from pathlib import Path

from nucleation import datasets
from nucleation.figures import figure_3_extended, style

drawn = figure_3_extended.draw(
    *(datasets.read(snakemake.input[name]) for name in ("theory", "lengths", "table"))
)
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
