"""Gather lengths and stability of the patches between two deformable bodies."""

from nucleation.analysis import lengths
from nucleation.analysis.definitions import ExtractionSettings
from nucleation.patch import pairs
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    simulations, patches = job.read_all(job.input.simulations), job.read_all(job.input.patches)
    settings = ExtractionSettings(**job.params.extraction)
    table = pairs.gather(job.params.runs, simulations, patches, settings)
    job.write(table, job.output.dataset, job.params.runs)
    job.write_text(lengths.to_csv(table), job.output.table)
