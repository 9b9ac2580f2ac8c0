"""The theory over the number that a study varies, as its figure shows it."""

import pytest
from configurations import study

from nucleation.configuration.load import configure
from nucleation.configuration.studies import theory_curves


def curves(*runs, **settings):
    made = configure(study(*runs, **settings))
    return made.runs, theory_curves(
        list(made.runs), made.studies["s"], made.base, made.main_text_interface
    )


@pytest.mark.parametrize("interface", ["main_text", "friction_law"])
def test_curve_goes_through_the_runs(interface):
    runs, found = curves(
        {"height": [0.01, 0.1], "evolution": ["aging", "slip"], "n_x": 400}, interface=interface
    )
    assert set(found) == {"aging", "slip"}
    for run in runs:
        curve = found[run.labels["evolution"]]
        at = curve["x"].index(run.labels["height"])
        assert curve["length"][at] == pytest.approx(run.theory_length, rel=1e-7)
    assert len(curve["x"]) > 50


def test_constants_of_friction_may_vary():
    runs, found = curves({"height": 0.01, "zeta_over_a": [1.0, 4.0]})
    assert found[""]["length"][0] == pytest.approx(runs[0].theory_length, rel=1e-6)
    assert found[""]["length"][0] > 1.5 * found[""]["length"][-1]


def test_no_curve_over_two_numbers_or_numbers_of_elements():
    assert curves({"height": [0.01, 0.1], "phi0": [1.0, 2.0]})[1] == {}
    assert curves({"height": 0.01, "n_x": [100, 200]})[1] == {}
