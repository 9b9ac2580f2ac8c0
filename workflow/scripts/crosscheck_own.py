"""Run one simulation of the crosscheck with the project's own solver."""

import sys

from nucleation.model.parameters import Parameters
from nucleation.pipeline.job import Job
from nucleation.verification.crosscheck.timed import simulate_timed

with Job(snakemake, __file__) as job:
    record = simulate_timed(Parameters.from_dict(job.params.parameters))
    if not record.attrs["completed"]:
        sys.exit(f"{job.output[0]}: {record.attrs['status']}")
    job.write(record, job.output[0], job.params.parameters)
