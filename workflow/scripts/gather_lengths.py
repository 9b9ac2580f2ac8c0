"""Join the tables of lengths of several studies."""

from nucleation.analysis import lengths
from nucleation.datasets import netcdf, provenance

params = snakemake.params
table = lengths.join(map(netcdf.read, snakemake.input))
attributes = provenance.attributes({}, params.digest, "snakemake lengths", snakemake.input)
netcdf.write(table, snakemake.output.dataset, **attributes)
netcdf.write_text(lengths.to_csv(table), snakemake.output.table)
