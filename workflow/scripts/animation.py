"""Draw the animation."""

from nucleation.analysis.lengths import row
from nucleation.datasets import netcdf
from nucleation.figures.beyond import animation

film = netcdf.read(snakemake.input.film)
entry = row(netcdf.read(snakemake.input.lengths), snakemake.params.id)
animation.save(animation.frames(film, entry), snakemake.output[0])
