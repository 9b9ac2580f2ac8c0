"""Gather the lengths at which the patches of simulations turn unstable."""

from nucleation.analysis import lengths
from nucleation.datasets import netcdf, provenance
from nucleation.patch import growth

params = snakemake.params
table = growth.gather(params.runs, map(netcdf.read, snakemake.input))
attributes = provenance.attributes(
    params.runs, params.digest, "snakemake figure_patch_stability", snakemake.input
)
netcdf.write(table, snakemake.output.dataset, **attributes)
netcdf.write_text(lengths.to_csv(table, growth.COLUMNS), snakemake.output.table)
