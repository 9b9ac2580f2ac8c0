"""Measure the orders of convergence on manufactured solutions."""

from nucleation.pipeline.job import Job
from nucleation.verification.orders import convergence_dataset, to_csv

with Job(snakemake, __file__) as job:
    dataset = convergence_dataset()
    job.write(dataset, job.output.dataset, {})
    job.write_text(to_csv(dataset), job.output.table)
