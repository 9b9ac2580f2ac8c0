"""Lay links to what a target shows, and say where it is."""

from nucleation.pipeline.check import run_show

run_show(snakemake)
