"""Draw Figure 3 with the lengths at which the patches turn unstable."""

from pathlib import Path

from nucleation.datasets import netcdf
from nucleation.figures import style
from nucleation.figures.beyond import figure_3_extended

drawn = figure_3_extended.draw(
    *(netcdf.read(snakemake.input[name]) for name in ("theory", "lengths", "table"))
)
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
