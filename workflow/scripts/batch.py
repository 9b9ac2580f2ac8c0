"""Run the simulations of a batch one after another, and measure each if its table is asked for.

Each has its own dataset as soon as it is finished: whatever happens to the others, it is used when
the batch is made again. One that fails does not keep the others from being made.
"""

import sys

from nucleation.analysis import lengths
from nucleation.analysis.definitions import ExtractionSettings
from nucleation.model.parameters import Parameters
from nucleation.patch.batches import measured
from nucleation.pipeline.job import Job
from nucleation.pipeline.running import Failed, record_of
from nucleation.simulation.checkpoints import Stopped
from nucleation.simulation.run import simulate

with Job(snakemake, __file__) as job:
    params = job.params
    measure = params.get("measure")
    if measure is None or not job.fetched():
        rows, failures = [], []
        for run, result in zip(params.runs, job.results, strict=True):
            try:
                parameters = Parameters.from_dict(run["parameters"])
                record = record_of(job, simulate, parameters, result)
            except Failed as failure:
                failures.append(str(failure))
                print(failure, file=sys.stderr)
                continue
            except Stopped as stopped:
                job.end(f"{run['id']}: {stopped}")
            if measure:
                extraction = ExtractionSettings(**params.extraction)
                rows.append(measured(run, record, extraction, measure))
        if failures:
            count = f"{len(failures)} of {len(params.runs)} runs failed"
            job.end("\n  ".join([f"{count}, the others are kept:", *failures]))
        if measure:
            given = {name: params[name] for name in ("runs", "extraction", "measure")}
            job.write(lengths.join(rows), job.output[0], given)
            job.keep()
