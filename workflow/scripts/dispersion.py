"""Integrate single modes of homogeneous sliding and compare with the spectrum."""

from nucleation.model.friction.law import Friction
from nucleation.model.material import Material
from nucleation.model.parameters import Loading, Parameters
from nucleation.pipeline.job import Job
from nucleation.verification.dispersion import dispersion_dataset, to_csv

with Job(snakemake, __file__) as job:
    given = {name: dict(job.params[name]) for name in ("material", "friction", "loading")}
    parameters = Parameters(
        material=Material(**given["material"]),
        friction=Friction(**given["friction"]),
        loading=Loading(**given["loading"]),
    )
    dataset = dispersion_dataset(parameters)
    job.write(dataset, job.output.dataset, given)
    job.write_text(to_csv(dataset), job.output.table)
