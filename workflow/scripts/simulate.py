"""Run one simulation; a failed one leaves its record beside the place of the result."""

import sys
from pathlib import Path

from nucleation import datasets, provenance
from nucleation.parameters import Parameters
from nucleation.progress import LogProgress
from nucleation.simulation import simulate

params, output = snakemake.params, Path(snakemake.output[0])
failed = output.with_suffix(".failed.nc")
with open(snakemake.log[0], "w", encoding="utf-8") as log:
    dataset = simulate(Parameters.from_dict(params.parameters), progress=LogProgress(log))
command = f"snakemake {output}"
attributes = provenance.attributes(params.parameters, params.digest, command)
completed = bool(dataset.attrs["completed"])
datasets.write(dataset, output if completed else failed, **attributes)
if not completed:
    sys.exit(f"{output.stem}: {dataset.attrs['status']}; what was recorded is in {failed}")
failed.unlink(missing_ok=True)
