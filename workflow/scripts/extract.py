"""Gather onset times and critical lengths of all simulations into one table."""

from nucleation import datasets, lengths, provenance
from nucleation.settings import ExtractionSettings

params = snakemake.params
runs, extraction = params.parameters["runs"], params.parameters["extraction"]
simulations = map(datasets.read, snakemake.input)
table = lengths.gather(runs, simulations, ExtractionSettings(**extraction))
attributes = provenance.attributes(
    params.parameters, params.digest, "snakemake lengths", snakemake.input
)
datasets.write(table, snakemake.output.dataset, **attributes)
datasets.write_text(lengths.to_csv(table), snakemake.output.table)
