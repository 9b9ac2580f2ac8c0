"""Run one simulation; a failed one leaves its record beside the place of the result."""

import sys
from pathlib import Path

sys.stderr = open(snakemake.log[0], "w", buffering=1, encoding="utf-8")  # noqa: SIM115 to the end

from nucleation import datasets, provenance  # noqa: E402
from nucleation.parameters import Parameters  # noqa: E402
from nucleation.progress import LogProgress  # noqa: E402
from nucleation.simulation import simulate  # noqa: E402

params, output = snakemake.params, Path(snakemake.output[0])
dataset = simulate(Parameters.from_dict(params.parameters), progress=LogProgress(sys.stderr))
attributes = provenance.attributes(params.parameters, params.digest, f"snakemake {output}")
failed = output.with_suffix(".failed.nc")
if not dataset.attrs["completed"]:
    datasets.write(dataset, failed, **attributes)
    sys.exit(f"{output.stem}: {dataset.attrs['status']}; its record is in {failed}")
datasets.write(dataset, output, **attributes)
failed.unlink(missing_ok=True)
