"""Follow the linear stability of one simulation's creeping patch."""

from nucleation import datasets, provenance
from nucleation.settings import ExtractionSettings
from nucleation.stability_length import follow_patch

params, output = snakemake.params, snakemake.output[0]
simulation = datasets.read(snakemake.input[0])
patch = follow_patch(simulation, ExtractionSettings(**params.extraction))
attributes = provenance.attributes(
    params.extraction, params.digest, f"snakemake {output}", snakemake.input
)
attributes["parameters"] = simulation.attrs["parameters"]
datasets.write(patch, output, **attributes)
