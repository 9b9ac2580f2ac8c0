"""Gather where runs drop, beside what the law of the drop says."""

from nucleation.analysis import lengths
from nucleation.patch import drop_table
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    drops = [*job.read_all(job.input.drops), *job.read_all(job.input.quiet)]
    table = drop_table.gather(drops, job.read_all(job.input.modes))
    job.write(table, job.output.dataset, {})
    job.write_text(lengths.to_csv(table), job.output.table)
