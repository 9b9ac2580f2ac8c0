"""Measure the orders of convergence on manufactured solutions."""

from nucleation import datasets, provenance
from nucleation.convergence import convergence_dataset, to_csv

dataset = convergence_dataset()
attributes = provenance.attributes({}, snakemake.params.digest, "snakemake figure_verification")
datasets.write(dataset, snakemake.output.dataset, **attributes)
datasets.write_text(to_csv(dataset), snakemake.output.table)
