"""Measure the orders of convergence on manufactured solutions."""

from nucleation.datasets import netcdf, provenance
from nucleation.verification.orders import convergence_dataset, to_csv

dataset = convergence_dataset()
attributes = provenance.attributes({}, snakemake.params.digest, "snakemake figure_verification")
netcdf.write(dataset, snakemake.output.dataset, **attributes)
netcdf.write_text(to_csv(dataset), snakemake.output.table)
