"""Where quiet runs drop, and the declared strength that would let them drop there."""

from nucleation.analysis import lengths
from nucleation.patch import drop_table
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    table = drop_table.floors(job.read_all(job.input.quiet), job.read_all(job.input.modes))
    job.write(table, job.output.dataset, {})
    job.write_text(lengths.to_csv(table), job.output.table)
