"""Compute all curves of the linear theory."""

from nucleation.datasets import netcdf, provenance
from nucleation.model.friction.law import Friction
from nucleation.model.linearised import InterfaceState
from nucleation.model.material import Material
from nucleation.theory.curves import Curves, theory_dataset

params = snakemake.params
parameters = params.parameters
dataset = theory_dataset(
    Material(**parameters["material"]),
    Friction(**parameters["friction"]),
    InterfaceState(**parameters["main_text_interface"]),
    Curves(**parameters["curves"]),
)
attributes = provenance.attributes(parameters, params.digest, "snakemake theory")
netcdf.write(dataset, snakemake.output[0], **attributes)
