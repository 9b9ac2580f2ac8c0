"""Follow the oscillating mode of one quiet simulation's patch, and how forcings stir it."""

import json

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.patch.mode_history import follow_mode, to_dataset
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    if not job.fetched():
        simulation = job.read(job.input[0])
        found = to_dataset(follow_mode(simulation, ExtractionSettings(**job.params.extraction)))
        job.write(found, job.output[0], json.loads(simulation.attrs["parameters"]))
        job.keep()
