"""Gather the map: lengths at the drop and of the patch's stability, over height and weakening."""

from nucleation.analysis import lengths
from nucleation.patch import map_table
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    table = map_table.gather(job.read(job.input[0]))
    job.write(map_table.on_grid(table), job.output.dataset, {})
    job.write_text(lengths.to_csv(table), job.output.table)
