"""Compute all curves of the linear theory."""

from nucleation import datasets, provenance
from nucleation.elasticity import Material
from nucleation.friction import Friction
from nucleation.parameters import Loading
from nucleation.stability import InterfaceState
from nucleation.theory import Curves, theory_dataset

params = snakemake.params
dataset = theory_dataset(
    Material(**params.material),
    Friction(**params.friction),
    Loading(**params.loading),
    InterfaceState(**params.main_text_interface),
    Curves(**params.curves),
)
settings = {name: value for name, value in params.items() if name != "digest"}
attributes = provenance.attributes(settings, params.digest, "snakemake theory")
datasets.write(dataset, snakemake.output[0], **attributes)
