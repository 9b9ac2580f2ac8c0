"""Draw the animation."""

from nucleation.analysis.lengths import row
from nucleation.figures.beyond import animation
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    film = job.read(job.input.film)
    entry = row(job.read(job.input.lengths), job.params.id)
    animation.save(animation.frames(film, entry), job.output[0])
