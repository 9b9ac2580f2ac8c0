"""Follow the linear stability of one simulation's creeping patch."""

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.datasets import netcdf, provenance
from nucleation.patch.growth import follow_patch

params, output = snakemake.params, snakemake.output[0]
simulation = netcdf.read(snakemake.input[0])
patch = follow_patch(simulation, ExtractionSettings(**params.extraction))
attributes = provenance.attributes(
    params.extraction, params.digest, f"snakemake {output}", snakemake.input
)
attributes["parameters"] = simulation.attrs["parameters"]
netcdf.write(patch, output, **attributes)
