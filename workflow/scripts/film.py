"""Take the film of a simulation."""

import json

from nucleation.analysis.film import film_dataset
from nucleation.analysis.lengths import row
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    entry = row(job.read(job.input.lengths), job.params.id)
    film = film_dataset(job.read(job.input.simulation), entry)
    # the parameters are those of the run, as in its own dataset
    job.write(film, job.output[0], json.loads(film.attrs["parameters"]))
