"""Lay links to what a target shows, and say where it is."""

from nucleation.pipeline.view import run

run(snakemake)
