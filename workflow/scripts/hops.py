"""Follow the hops of one simulation's front."""

from nucleation import datasets, provenance
from nucleation.hops import follow_hops
from nucleation.settings import ExtractionSettings

params, output = snakemake.params, snakemake.output[0]
followed = follow_hops(datasets.read(snakemake.input[0]), ExtractionSettings(**params.extraction))
attributes = provenance.attributes(
    params.extraction, params.digest, f"snakemake {output}", snakemake.input
)
attributes["parameters"] = followed.attrs["parameters"]
datasets.write(followed, output, **attributes)
