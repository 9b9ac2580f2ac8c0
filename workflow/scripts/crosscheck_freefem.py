"""Run one simulation of the crosscheck with FreeFem++."""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.datasets import netcdf, provenance
from nucleation.model.parameters import Parameters
from nucleation.verification.crosscheck import freefem
from nucleation.verification.crosscheck.plan import CrosscheckSettings

params, output = snakemake.params, snakemake.output[0]
settings = {**params.settings, "heights": tuple(params.settings["heights"])}
with TemporaryDirectory() as directory:
    try:
        record = freefem.run(
            Path(snakemake.input.script),
            Path(directory),
            Parameters.from_dict(params.parameters),
            CrosscheckSettings(**settings),
            ExtractionSettings(**params.extraction),
        )
    except freefem.FreeFemError as error:
        sys.exit(str(error))
attributes = provenance.attributes(params.parameters, params.digest, f"snakemake {output}")
netcdf.write(record, output, **attributes)
