"""Draw Figure S2."""

from pathlib import Path

from nucleation.analysis.lengths import row
from nucleation.datasets import netcdf
from nucleation.figures import style
from nucleation.figures.paper import figure_s2

table = netcdf.read(snakemake.input.lengths)
drawn = figure_s2.draw(netcdf.read(snakemake.input.simulation), row(table, snakemake.params.id))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
