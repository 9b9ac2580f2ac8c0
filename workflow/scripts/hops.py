"""Follow the hops of one simulation's front."""

import json

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.patch.hops import follow_hops
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    if not job.fetched():
        simulation = job.read(job.input[0])
        found = follow_hops(simulation, ExtractionSettings(**job.params.extraction))
        job.write(found, job.output[0], json.loads(simulation.attrs["parameters"]))
        job.keep()
