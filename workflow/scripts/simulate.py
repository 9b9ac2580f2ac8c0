"""Run one simulation; a failed one leaves its record beside the place of the result."""

from nucleation.model.parameters import Parameters
from nucleation.pipeline.job import Job
from nucleation.pipeline.running import Failed, record_of
from nucleation.simulation.checkpoints import Stopped
from nucleation.simulation.run import simulate

with Job(snakemake, __file__) as job:
    try:
        record_of(job, simulate, Parameters.from_dict(job.params.parameters), job.own)
    except Failed as failure:
        job.end(str(failure))
    except Stopped as stopped:
        job.end(f"{job.own.path.stem}: {stopped}")
