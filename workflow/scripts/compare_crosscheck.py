"""Compare the runs of the two solvers."""

from nucleation.analysis import lengths
from nucleation.analysis.definitions import ExtractionSettings
from nucleation.datasets import netcdf, provenance
from nucleation.verification.crosscheck import compare

params, own, freefem = snakemake.params, snakemake.input.own, snakemake.input.freefem
settings = ExtractionSettings(**params.extraction)
rows = {
    name: compare.compare(netcdf.read(first), netcdf.read(second), settings)
    for name, first, second in zip(params.ids, own, freefem, strict=True)
}
table = compare.gather(rows)
attributes = provenance.attributes(
    params.extraction, params.digest, "snakemake crosscheck", [*own, *freefem]
)
netcdf.write(table, snakemake.output.dataset, **attributes)
netcdf.write_text(lengths.to_csv(table, compare.COLUMNS), snakemake.output.table)
