"""Quantiles over many drops: what is counted, and how realisations scatter."""

import math

import numpy as np
import pytest
from scipy.stats import norm

from nucleation.drop import drop_quantiles as module
from nucleation.drop.delay import ClosedForm, Drop
from nucleation.drop.expected_drop import ExpectedDrop, expected_drop
from nucleation.model.parameters import Parameters
from nucleation.theory.status import NoLength

CLOSED = ClosedForm(0.25, 0.322, 0.014, 50.0, 1e-5)
BASE = Parameters().replaced({"perturbation": "normal_load", "strength": 1e-4, "height": 0.02})


def answer(length, doubt=""):
    return ExpectedDrop(
        0.25, Drop(length, 0.9 * length, 1.2 * length, 14.0, 13.5, 14.5), CLOSED, doubt
    )


@pytest.fixture
def answers(monkeypatch):
    """In place of the law: the answers in a list, one after another."""

    def use(made):
        rest = list(made)

        def law(_):
            one = rest.pop(0)
            if isinstance(one, Exception):
                raise one
            return one

        monkeypatch.setattr(module, "expected_drop", law)
        return module.drop_quantiles([BASE] * len(made))

    return use


def test_realisations_scatter_as_the_law_has_it(answers):
    """All draws of one fault: median, 16 and 84 % are the law's own."""
    found = answers([answer(0.3)] * 200)["value"].sel(key="expected_length")
    expected = [0.27, 0.3, 0.36]
    np.testing.assert_allclose(found.sel(quantile=[0.16, 0.5, 0.84]), expected, rtol=0.01)
    low = 0.3 * 0.9 ** (norm.ppf(0.95) / norm.ppf(0.84))
    assert float(found.sel(quantile=0.05)) == pytest.approx(low, rel=0.01)


def test_draws_without_a_drop(answers):
    """Beyond what is searched counts as infinite; what is not known is left out."""
    beyond, unknown = NoLength("too long", "beyond"), NoLength("not followed", "unknown")
    made = [answer(0.3)] * 10 + [beyond] * 5 + [unknown] * 5
    found = answers(made)
    drop = found.sel(key="expected_length")
    assert float(drop["share"]) == 0.5
    assert np.isinf(drop["value"].sel(quantile=0.84)) and np.isfinite(drop["value"][2])
    known = answers([answer(0.3)] * 10 + [unknown] * 10).sel(key="expected_length")
    assert np.isfinite(known["value"]).all()


def test_doubts_are_counted_and_named_once(answers):
    found = answers([answer(0.3), answer(0.3, "it is strong"), answer(0.4, "it is strong")])
    assert (found.attrs["doubtful"], found.attrs["doubts"]) == (2, "it is strong")


@pytest.mark.slow
def test_a_stable_fault_counts_as_infinite():
    """And the lengths of the theory are those of each run."""
    stable = BASE.replaced({"friction.aging_coefficient": 0.0})
    found = module.drop_quantiles([BASE, BASE, BASE, stable])
    assert found["share"].values.tolist() == [0.75] * 3
    assert "friction grows with slip rate" in found["why_not"].values[0]
    own = expected_drop(BASE)
    medians = found["value"].sel(quantile=0.5)
    assert float(medians.sel(key="stability_length")) == pytest.approx(own.stability_length)
    assert float(medians.sel(key="expected_length")) == pytest.approx(own.length, rel=0.05)
    assert math.isinf(found["value"].sel(key="critical_length", quantile=0.95))
