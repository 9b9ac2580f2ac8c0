"""Compute all curves of the linear theory."""

from nucleation import datasets, provenance
from nucleation.elasticity import Material
from nucleation.friction import Friction
from nucleation.settings import Curves
from nucleation.stability import InterfaceState
from nucleation.theory import theory_dataset

params = snakemake.params
parameters = params.parameters
dataset = theory_dataset(
    Material(**parameters["material"]),
    Friction(**parameters["friction"]),
    InterfaceState(**parameters["main_text_interface"]),
    Curves(**parameters["curves"]),
)
attributes = provenance.attributes(parameters, params.digest, "snakemake theory")
datasets.write(dataset, snakemake.output[0], **attributes)
