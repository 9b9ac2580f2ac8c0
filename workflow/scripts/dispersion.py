"""Integrate single modes of homogeneous sliding and compare with the spectrum."""

from nucleation.datasets import netcdf, provenance
from nucleation.model.friction.law import Friction
from nucleation.model.material import Material
from nucleation.model.parameters import Loading, Parameters
from nucleation.verification.dispersion import dispersion_dataset, to_csv

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
netcdf.write(dataset, snakemake.output.dataset, **attributes)
netcdf.write_text(to_csv(dataset), snakemake.output.table)
