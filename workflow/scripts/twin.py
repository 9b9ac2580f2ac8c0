"""Kick the patch of one run at several of its lengths, and follow the kicks."""

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.datasets import netcdf, provenance
from nucleation.model.parameters import Parameters
from nucleation.patch.twins import follow_twins

params, output = snakemake.params, snakemake.output[0]
parameters = Parameters.from_dict(params.run["parameters"])
settings = ExtractionSettings(**params.extraction)
twins = follow_twins(parameters, params.run["theory_length"], settings)
attributes = provenance.attributes(params.run["parameters"], params.digest, f"snakemake {output}")
netcdf.write(twins, output, **attributes)
