"""The example configurations: valid, planned without warnings, their smallest runs nucleate."""

import pytest
from configurations import CONFIG

from nucleation.extraction.extraction import extract
from nucleation.simulation.run import simulate
from replication.configuration.advice import warned
from replication.configuration.load import load

EXAMPLES = sorted((CONFIG / "examples").glob("*.yaml"))
NAMES = [path.stem for path in EXAMPLES]


@pytest.mark.parametrize("path", EXAMPLES, ids=NAMES)
def test_example_is_valid_and_needs_no_warning(path):
    config = load(path)
    assert config.results == f"results/{path.stem}"
    assert warned(config.runs) == []
    assert f"config/examples/{path.name}" in path.read_text(), "how to run it"


@pytest.mark.slow
def test_rock_nucleates_under_a_load_far_from_the_fault():
    """The lowest blocks, on elements twice as large as the example's."""
    config = load(CONFIG / "examples" / "rock.yaml")
    lowest = (x for x in config.runs if "H0.25" in x.id and "loadingremote" in x.id)
    run = next(lowest)
    parameters = run.run.replaced(n_x=121, n_y=8, grading=6.0)
    length = extract(simulate(parameters), config.extraction)["length"]
    assert length == pytest.approx(0.567, rel=0.05)
