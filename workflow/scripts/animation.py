"""Draw the animation."""

from nucleation import datasets
from nucleation.figures import animation
from nucleation.lengths import row

film = datasets.read(snakemake.input.film)
entry = row(datasets.read(snakemake.input.lengths), snakemake.params.id)
animation.save(animation.frames(film, entry), snakemake.output[0])
