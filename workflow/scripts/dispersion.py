"""Integrate single modes of homogeneous sliding and compare with the spectrum."""

from nucleation import datasets, provenance
from nucleation.dispersion import dispersion_dataset, to_csv
from nucleation.elasticity import Material
from nucleation.friction import Friction
from nucleation.parameters import Loading, Parameters

params = snakemake.params
dataset = dispersion_dataset(
    Parameters(
        material=Material(**params.material),
        friction=Friction(**params.friction),
        loading=Loading(**params.loading),
    )
)
settings = {name: value for name, value in params.items() if name != "digest"}
attributes = provenance.attributes(settings, params.digest, "snakemake figure_dispersion")
datasets.write(dataset, snakemake.output.dataset, **attributes)
datasets.write_text(to_csv(dataset), snakemake.output.table)
