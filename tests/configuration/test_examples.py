"""The example configurations: valid, planned without warnings, their smallest runs nucleate."""

import math

import pytest
from configurations import CONFIG

from nucleation.extraction.extraction import extract
from nucleation.simulation.run import simulate
from replication.configuration.advice import warned
from replication.configuration.load import load

EXAMPLES = sorted((CONFIG / "examples").glob("*.yaml"))
NAMES = [path.stem for path in EXAMPLES]


def test_examples_are_there():
    assert {"crustal_fault", "granite_laboratory", "length_map", "rock"} <= set(NAMES)


@pytest.mark.parametrize("path", EXAMPLES, ids=NAMES)
def test_example_is_valid_and_needs_no_warning(path):
    config = load(path)
    assert config.results == f"results/{path.stem}"
    assert warned(config.runs) == []
    assert f"config/examples/{path.name}" in path.read_text(), "how to run it"


def test_map_is_a_hundred_runs():
    config = load(CONFIG / "examples" / "length_map.yaml")
    assert len(config.runs) == 100
    for run in config.runs:
        friction = run.run.law.expansion(run.run.fault.velocity)
        assert friction.zeta / friction.a == pytest.approx(run.given["zeta_over_a"], rel=1e-9)
        assert (friction.f0, friction.a) == pytest.approx((0.41, 0.0068), rel=1e-9)


def test_shortest_run_of_the_map_nucleates():
    """The run with the fewest steps, on a still coarser mesh than the example's."""
    config = load(CONFIG / "examples" / "length_map.yaml")
    run = min(config.runs, key=lambda run: run.critical_length**2 / run.run.fault.height)
    parameters = run.run.replaced(n_x=60, n_y=4, grading=4.0)
    found = extract(simulate(parameters), config.extraction)
    assert math.isfinite(found["onset_time"])
    assert 0.4 < found["length"] / run.critical_length < 1.3


@pytest.mark.slow
def test_rock_nucleates_under_a_load_far_from_the_fault():
    """The lowest blocks, on elements twice as large as the example's."""
    config = load(CONFIG / "examples" / "rock.yaml")
    lowest = (x for x in config.runs if "H0.25" in x.id and "loadingremote" in x.id)
    run = next(lowest)
    parameters = run.run.replaced(n_x=121, n_y=8, grading=6.0)
    length = extract(simulate(parameters), config.extraction)["length"]
    assert length == pytest.approx(0.567, rel=0.05)
