"""Which runs a job of a cluster has, from its command."""

import pytest
from nucleation.pipeline.planning import names_asked_for

ONE = "simulate:name=map-aging-H0.1,key=0123456789abcdef"
BATCH = "batch:name=map-07,key=0123456789abcdee"


@pytest.mark.parametrize(
    ("command", "names"),
    [
        (["snakemake", "--target-jobs", ONE, "--cores", "2"], {"map-aging-H0.1"}),
        (["snakemake", "--target-jobs", ONE, BATCH, "--mode", "remote"],
         {"map-aging-H0.1", "map-07"}),
        (["snakemake", "--cores", "1", "--target-jobs", BATCH], {"map-07"}),
        (["snakemake", "--target-jobs", ONE, "extract:study=map"], None),
        (["snakemake", "--target-jobs", "theory:"], None),
        (["snakemake", "figure_map", "--cores", "2"], None),
    ],
)  # fmt: skip
def test_names_are_those_of_jobs_that_are_known_by_key(command, names):
    assert names_asked_for(command) == names
