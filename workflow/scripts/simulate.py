"""Make simulations, one or several; one that fails leaves its record among the unfinished."""

from nucleation.pipeline.running import run

run(snakemake)
