"""Gather onset times and critical lengths of all simulations into one table."""

from nucleation.analysis import lengths
from nucleation.analysis.definitions import ExtractionSettings
from nucleation.datasets import netcdf, provenance

params = snakemake.params
runs, extraction = params.parameters["runs"], params.parameters["extraction"]
simulations = map(netcdf.read, snakemake.input)
table = lengths.gather(runs, simulations, ExtractionSettings(**extraction))
attributes = provenance.attributes(
    params.parameters, params.digest, "snakemake lengths", snakemake.input
)
netcdf.write(table, snakemake.output.dataset, **attributes)
netcdf.write_text(lengths.to_csv(table), snakemake.output.table)
