"""Integrate single modes between two sliding layers and compare with the spectrum."""

from nucleation.model.friction.law import Friction
from nucleation.model.material import Material
from nucleation.model.parameters import Loading, Parameters
from nucleation.pipeline.job import Job
from nucleation.verification.pair_modes import pair_modes, to_csv

with Job(snakemake, __file__) as job:
    given = {name: dict(job.params[name]) for name in ("material", "friction", "loading")}
    parameters = Parameters(
        material=Material(**given["material"]),
        friction=Friction(**given["friction"]),
        loading=Loading(**given["loading"]),
    )
    modes = pair_modes(parameters)
    job.write(modes, job.output.dataset, given)
    job.write_text(to_csv(modes), job.output.table)
