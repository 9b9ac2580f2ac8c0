"""Gather the growth of kicks in all twin runs."""

from nucleation.analysis import lengths
from nucleation.datasets import netcdf, provenance
from nucleation.patch import twins

params = snakemake.params
table = twins.gather(params.runs, map(netcdf.read, snakemake.input))
attributes = provenance.attributes(
    params.runs, params.digest, "snakemake figure_patch_stability", snakemake.input
)
netcdf.write(table, snakemake.output.dataset, **attributes)
netcdf.write_text(lengths.to_csv(table, twins.COLUMNS), snakemake.output.table)
