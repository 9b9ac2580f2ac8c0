"""Take the film of a simulation."""

from nucleation.analysis.film import film_dataset
from nucleation.analysis.lengths import row
from nucleation.datasets import netcdf, provenance

params = snakemake.params
simulation = netcdf.read(snakemake.input.simulation)
entry = row(netcdf.read(snakemake.input.lengths), params.id)
film = film_dataset(simulation, entry)
attributes = provenance.attributes({"id": params.id}, params.digest, "snakemake animation")
attributes["parameters"] = film.attrs["parameters"]  # of the run, as in its own dataset
netcdf.write(film, snakemake.output[0], **attributes)
