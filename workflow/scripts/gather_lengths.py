"""Join the tables of lengths of several studies."""

from nucleation.analysis import lengths
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    table = lengths.join(job.read_all(job.input))
    job.write(table, job.output.dataset, {})
    job.write_text(lengths.to_csv(table), job.output.table)
    job.write_text(lengths.columns_csv(), job.output.columns)
