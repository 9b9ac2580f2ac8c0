"""Draw Figure 3."""

from pathlib import Path

from nucleation import datasets
from nucleation.figures import figure_3, style
from nucleation.lengths import row

table = datasets.read(snakemake.input.lengths)
drawn = figure_3.draw(
    datasets.read(snakemake.input.theory),
    table,
    datasets.read(snakemake.input.simulation),
    row(table, snakemake.params.id),
)
style.save(drawn, Path(snakemake.output[0]).with_suffix(""), snakemake.params.digest)
