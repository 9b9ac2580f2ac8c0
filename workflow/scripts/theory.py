"""Compute all curves of the linear theory."""

from nucleation.model.friction.law import Friction
from nucleation.model.linearised import InterfaceState
from nucleation.model.material import Material
from nucleation.pipeline.job import Job
from nucleation.theory.curves import Curves, theory_dataset

with Job(snakemake, __file__) as job:
    parameters = job.params.parameters
    dataset = theory_dataset(
        Material(**parameters["material"]),
        Friction(**parameters["friction"]),
        InterfaceState(**parameters["main_text_interface"]),
        Curves(**parameters["curves"]),
    )
    job.write(dataset, job.output[0], parameters)
