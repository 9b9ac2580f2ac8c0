"""Run one simulation; a failed one leaves its record beside the place of the result."""

import sys
from pathlib import Path

sys.stderr = open(snakemake.log[0], "a", buffering=1, encoding="utf-8")  # noqa: SIM115 to the end

from nucleation.model.parameters import Parameters  # noqa: E402
from nucleation.pipeline.job import checkpoint_of, run_to_file  # noqa: E402
from nucleation.pipeline.progress import Progress  # noqa: E402
from nucleation.simulation.checkpoints import Stopped  # noqa: E402

params, output = snakemake.params, Path(snakemake.output[0])
parameters = Parameters.from_dict(params.parameters)
checkpoint = checkpoint_of(parameters, output, params.digest)
checkpoint.listen()
try:
    dataset, path = run_to_file(
        parameters,
        output,
        params.digest,
        f"snakemake {output}",
        checkpoint=checkpoint,
        progress=Progress(parameters, sys.stderr),
    )
except Stopped as stopped:
    sys.exit(f"{output.stem}: {stopped}")
if path != output:
    sys.exit(f"{output.stem}: {dataset.attrs['status']}; its record is in {path}")
