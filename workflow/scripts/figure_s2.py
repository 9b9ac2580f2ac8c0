"""Draw Figure S2."""

from pathlib import Path

from nucleation import datasets
from nucleation.figures import figure_s2, style
from nucleation.lengths import row

table = datasets.read(snakemake.input.lengths)
drawn = figure_s2.draw(datasets.read(snakemake.input.simulation), row(table, snakemake.params.id))
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
