"""Kick the patch of one run at several of its lengths, and follow the kicks."""

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.model.parameters import Parameters
from nucleation.patch.twins import follow_twins
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    if not job.fetched():
        run = job.params.run
        parameters = Parameters.from_dict(run["parameters"])
        settings = ExtractionSettings(**job.params.extraction)
        twins = follow_twins(parameters, run["theory_length"], settings)
        job.write(twins, job.output[0], run["parameters"])
        job.keep()
