"""Make the simulations of a batch, and the table of what is measured of them."""

from nucleation.pipeline.running import run_batch

run_batch(snakemake)
