"""Compare each run of the convergence studies with the next coarser one."""

from nucleation.analysis import convergence, lengths
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    table = convergence.refinement_table(lengths.join(job.read_all(job.input)))
    job.write(table, job.output.dataset, {})
    job.write_text(lengths.to_csv(table), job.output.table)
