"""Take the film of a simulation."""

from nucleation import datasets, provenance
from nucleation.film import film_dataset
from nucleation.lengths import row

params = snakemake.params
simulation = datasets.read(snakemake.input.simulation)
entry = row(datasets.read(snakemake.input.lengths), params.id)
film = film_dataset(simulation, entry)
attributes = provenance.attributes({"id": params.id}, params.digest, "snakemake animation")
attributes["parameters"] = film.attrs["parameters"]  # of the run, as in its own dataset
datasets.write(film, snakemake.output[0], **attributes)
