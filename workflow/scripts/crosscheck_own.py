"""Run one simulation of the crosscheck with the project's own solver."""

import sys

from nucleation.datasets import netcdf, provenance
from nucleation.model.parameters import Parameters
from nucleation.verification.crosscheck.compare import simulate_timed

params, output = snakemake.params, snakemake.output[0]
record = simulate_timed(Parameters.from_dict(params.parameters))
if not record.attrs["completed"]:
    sys.exit(f"{output}: {record.attrs['status']}")
attributes = provenance.attributes(params.parameters, params.digest, f"snakemake {output}")
netcdf.write(record, output, **attributes)
