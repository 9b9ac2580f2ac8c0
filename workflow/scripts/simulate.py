"""Run one simulation; a failed one leaves its record beside the place of the result."""

import sys
from pathlib import Path

sys.stderr = open(snakemake.log[0], "a", buffering=1, encoding="utf-8")  # noqa: SIM115 to the end

from nucleation import datasets, provenance  # noqa: E402
from nucleation.checkpoints import Checkpoint, Stopped  # noqa: E402
from nucleation.parameters import Parameters  # noqa: E402
from nucleation.progress import Progress  # noqa: E402
from nucleation.simulation import simulate  # noqa: E402

params, output = snakemake.params, Path(snakemake.output[0])
parameters = Parameters.from_dict(params.parameters)
checkpoint = Checkpoint(
    output.with_suffix(".checkpoint.npz"), provenance.fingerprint(params.parameters, params.digest)
)
checkpoint.listen()
try:
    dataset = simulate(
        parameters,
        progress=Progress(parameters, sys.stderr),
        start=checkpoint.load(),
        keep=checkpoint.keep,
    )
except Stopped as stopped:
    sys.exit(f"{output.stem}: {stopped}")
attributes = provenance.attributes(params.parameters, params.digest, f"snakemake {output}")
failed = output.with_suffix(".failed.nc")
if not dataset.attrs["completed"]:
    datasets.write(dataset, failed, **attributes)
    checkpoint.remove()
    sys.exit(f"{output.stem}: {dataset.attrs['status']}; its record is in {failed}")
datasets.write(dataset, output, **attributes)
checkpoint.remove()
failed.unlink(missing_ok=True)
