"""Follow the hops of one simulation's front."""

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.datasets import netcdf, provenance
from nucleation.patch.hops import follow_hops

params, output = snakemake.params, snakemake.output[0]
followed = follow_hops(netcdf.read(snakemake.input[0]), ExtractionSettings(**params.extraction))
attributes = provenance.attributes(
    params.extraction, params.digest, f"snakemake {output}", snakemake.input
)
attributes["parameters"] = followed.attrs["parameters"]
netcdf.write(followed, output, **attributes)
