"""Run one simulation of the crosscheck with FreeFem++."""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.model.parameters import Parameters
from nucleation.pipeline.job import Job
from nucleation.verification.crosscheck import freefem
from nucleation.verification.crosscheck.plan import CrosscheckSettings

with Job(snakemake, __file__) as job, TemporaryDirectory() as directory:
    params = job.params
    settings = {**params.settings, "heights": tuple(params.settings["heights"])}
    try:
        record = freefem.run(
            Path(job.input.scripts[0]).parent,
            Path(directory),
            Parameters.from_dict(params.parameters),
            CrosscheckSettings(**settings),
            ExtractionSettings(**params.extraction),
        )
    except freefem.FreeFemError as error:
        sys.exit(str(error))
    job.write(record, job.output[0], params.parameters)
