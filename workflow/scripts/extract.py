"""Gather onset times and critical lengths of all simulations of a study into one table."""

from nucleation.analysis import lengths
from nucleation.analysis.definitions import ExtractionSettings
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    parameters = job.params.parameters
    extraction = ExtractionSettings(**parameters["extraction"])
    table = lengths.gather(parameters["runs"], job.read_all(job.input), extraction)
    job.write(table, job.output.dataset, parameters)
    job.write_text(lengths.to_csv(table), job.output.table)
