"""Join the tables of a study's batches, with the runs in their order."""

from nucleation.analysis import lengths
from nucleation.patch.batches import in_order
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    table = in_order(lengths.join(job.read_all(job.input)), job.params.ids)
    job.write(table, job.output.dataset, {"ids": job.params.ids})
    job.write_text(lengths.to_csv(table), job.output.table)
