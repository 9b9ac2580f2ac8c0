"""Make a result: the function that the rule names, with the rule's inputs and parameters."""

from nucleation.pipeline.job import run

run(snakemake)
