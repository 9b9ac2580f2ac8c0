"""The faults of the study other_faults are those that were drawn, with nothing changed since."""

from configurations import PAPER
from other_faults import drawn


def test_the_faults_are_the_drawn_ones():
    runs = PAPER["studies"]["other_faults"]["runs"]
    given = [{**run.pop("defaults"), **run} for run in map(dict, runs)]
    assert given == drawn()
