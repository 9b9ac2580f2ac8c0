"""Compute all curves of the linear theory."""

from nucleation import datasets, provenance
from nucleation.elasticity import Material
from nucleation.friction import Friction
from nucleation.settings import Curves
from nucleation.stability import InterfaceState
from nucleation.theory import theory_dataset

params = snakemake.params
dataset = theory_dataset(
    Material(**params.material),
    Friction(**params.friction),
    InterfaceState(**params.main_text_interface),
    Curves(**params.curves),
)
settings = {name: value for name, value in params.items() if name != "digest"}
attributes = provenance.attributes(settings, params.digest, "snakemake theory")
datasets.write(dataset, snakemake.output[0], **attributes)
