"""Compare the runs of the two solvers."""

from nucleation import crosscheck, datasets, lengths, provenance
from nucleation.settings import ExtractionSettings

params, own, freefem = snakemake.params, snakemake.input.own, snakemake.input.freefem
settings = ExtractionSettings(**params.extraction)
rows = {
    name: crosscheck.compare(datasets.read(first), datasets.read(second), settings)
    for name, first, second in zip(params.ids, own, freefem, strict=True)
}
table = crosscheck.gather(rows)
attributes = provenance.attributes(
    params.extraction, params.digest, "snakemake crosscheck", [*own, *freefem]
)
datasets.write(table, snakemake.output.dataset, **attributes)
datasets.write_text(lengths.to_csv(table, crosscheck.COLUMNS), snakemake.output.table)
