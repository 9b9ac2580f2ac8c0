"""The committed reference set against what the code gives today."""

import pytest
from configurations import papers
from docs.prose import table

from nucleation.extraction.extraction import extract
from nucleation.simulation.run import simulate

SETTINGS = papers()
RUNS = {run.id: run for run in SETTINGS.runs if SETTINGS.studies[run.study].table == "lengths"}
LENGTHS = table("lengths").set_index("id")


def test_reference_has_the_runs_of_the_configuration():
    assert set(LENGTHS.index) == set(RUNS)
    assert LENGTHS["status"].str.startswith("completed").all()
    for identifier, run in RUNS.items():
        stated = LENGTHS["critical_length"][identifier]
        assert stated == pytest.approx(run.critical_length, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "tolerance"),
    [("converged-aging-H0.02-phi1-seed1", 1e-3), ("paper-aging-H0.005-phi1", 2e-3)],
)
def test_fresh_simulation_gives_the_reference(name, tolerance):
    """Perturbed, the drop is one number on all machines; else round-off grows in the event."""
    parameters = RUNS[name].run.replaced(time_after_event=0.0)
    measured = extract(simulate(parameters))
    for column, value in measured.items():
        assert value == pytest.approx(LENGTHS[column][name], rel=tolerance), column
