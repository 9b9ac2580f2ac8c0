"""Run simulations of the study drop one after another, and keep where each drops."""

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.analysis.drops import measure_drops
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    if not job.fetched():
        runs, extraction = job.params.runs, job.params.extraction
        found = measure_drops(runs, ExtractionSettings(**extraction))
        job.write(found, job.output[0], {"runs": runs, "extraction": extraction})
        job.keep()
