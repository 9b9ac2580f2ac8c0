"""List the results that are not current; remove unused ones if that is asked for."""

from nucleation.pipeline.check import run

run(snakemake)
