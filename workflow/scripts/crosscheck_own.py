"""Run one simulation of the crosscheck with the project's own solver."""

import sys

from nucleation import datasets, provenance
from nucleation.crosscheck import simulate_timed
from nucleation.parameters import Parameters

params, output = snakemake.params, snakemake.output[0]
record = simulate_timed(Parameters.from_dict(params.parameters))
if not record.attrs["completed"]:
    sys.exit(f"{output}: {record.attrs['status']}")
attributes = provenance.attributes(params.parameters, params.digest, f"snakemake {output}")
datasets.write(record, output, **attributes)
