"""Make simulations, one or several, or the table of a batch of them."""

from nucleation.pipeline.running import run

run(snakemake)
