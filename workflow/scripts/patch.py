"""Follow the linear stability of the creeping patches of simulations, one or several."""

import json

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.patch.growth import follow_patch
from nucleation.pipeline.job import Job
from nucleation.pipeline.keys import key_in

with Job(snakemake, __file__) as job:
    extraction = ExtractionSettings(**job.params.extraction)
    for source, result in zip(job.input, job.results, strict=True):
        if result.path.is_file() or job.fetched(result):
            continue
        simulation = job.read(source, key_in(source))
        found = follow_patch(simulation, extraction)
        job.write(found, result, json.loads(simulation.attrs["parameters"]), [source])
        job.keep(result)
