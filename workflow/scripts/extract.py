"""Gather onset times and critical lengths of all simulations into one table."""

from nucleation import datasets, lengths, provenance
from nucleation.settings import ExtractionSettings

params = snakemake.params
table = lengths.gather(
    params.runs, map(datasets.read, snakemake.input), ExtractionSettings(**params.extraction)
)
settings = {"runs": params.runs, "extraction": params.extraction}
attributes = provenance.attributes(settings, params.digest, "snakemake lengths")
datasets.write(table, snakemake.output.dataset, **attributes)
datasets.write_text(lengths.to_csv(table), snakemake.output.table)
