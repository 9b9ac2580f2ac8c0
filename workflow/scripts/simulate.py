"""Run one simulation; a failed one leaves its record beside the place of the result."""

import sys
from pathlib import Path

from nucleation.model.parameters import Parameters
from nucleation.pipeline.job import Job
from nucleation.pipeline.progress import Progress
from nucleation.pipeline.running import checkpoint_of, run_to_file
from nucleation.simulation.checkpoints import Stopped
from nucleation.simulation.run import simulate

with Job(snakemake, __file__) as job:
    output = Path(job.output[0])
    parameters = Parameters.from_dict(job.params.parameters)
    if not job.fetched():
        checkpoint = checkpoint_of(parameters, output, job.params.code)
        checkpoint.listen()
        try:
            dataset, path = run_to_file(
                simulate,
                parameters,
                output,
                job.attributes(parameters.to_dict()),
                checkpoint=checkpoint,
                progress=Progress(parameters, sys.stderr),
            )
        except Stopped as stopped:
            job.end(f"{output.stem}: {stopped}")
        if path != output:
            job.end(f"{output.stem}: {dataset.attrs['status']}; its record is in {path}")
        job.keep()
