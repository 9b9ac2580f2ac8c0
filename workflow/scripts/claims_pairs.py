"""Evaluate what the paper's theory says of two bodies by simulations of them."""

from nucleation.claims import table
from nucleation.claims.statements import two_bodies
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    pairs = job.read(job.input[0])
    rows = [
        {"subject": "two bodies, simulated", **claim.evaluate(pairs)} for claim in two_bodies.CLAIMS
    ]
    job.write_text(table.to_csv(rows), job.output.csv)
    job.write_text(table.to_markdown(rows), job.output.markdown)
