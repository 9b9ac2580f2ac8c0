"""Compare each run of the convergence studies with the next coarser one."""

from nucleation.analysis import convergence, lengths
from nucleation.datasets import netcdf, provenance

table = convergence.refinement_table(lengths.join(map(netcdf.read, snakemake.input)))
attributes = provenance.attributes(
    {}, snakemake.params.digest, "snakemake figure_convergence", snakemake.input
)
netcdf.write(table, snakemake.output.dataset, **attributes)
netcdf.write_text(lengths.to_csv(table, convergence.COLUMNS), snakemake.output.table)
