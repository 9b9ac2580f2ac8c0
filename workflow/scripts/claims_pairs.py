"""Evaluate what the paper's theory says of two bodies by simulations of them."""

from nucleation.claims import table
from nucleation.claims.statements import two_bodies
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    pairs, modes = job.read(job.input.table), job.read(job.input.modes)
    rows = two_bodies.evaluate(pairs, modes)
    job.write_text(table.to_csv(rows), job.output.csv)
    job.write_text(table.to_markdown(rows), job.output.markdown)
