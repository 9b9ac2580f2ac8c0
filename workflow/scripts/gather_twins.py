"""Gather the growth of kicks in all twin runs."""

from nucleation.analysis import lengths
from nucleation.patch.tables import gather_twins
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    table = gather_twins(job.params.runs, job.read_all(job.input))
    job.write(table, job.output.dataset, job.params.runs)
    job.write_text(lengths.to_csv(table), job.output.table)
