"""Draws and quantiles of lengths against closed forms; what is drawn, counted and refused."""

import math

import numpy as np
import pytest
from asked import critical_length, lengths, stability_length
from numpy.testing import assert_allclose
from scipy.stats import norm

from nucleation.api import draw_samples, quantiles
from nucleation.lengths.draws import QUANTILES, errors_of_quantiles, with_never
from nucleation.model.quantities import ParameterError

FAULT = {"shear_modulus": 30e9, "poisson_ratio": 0.25, "normal_stress": 50e6}
FRICTION = {"a": 0.010, "zeta": 0.005}
KNOWN = FAULT | FRICTION
MEDIAN = math.pi * 40e9 * 5e-6 / (0.005 * 50e6)  # L_c (m) at D = 5 um, Eq. (6)


def test_a_distance_of_a_range():
    """L_c is proportional to D: the range's own quantiles, with unequal sides."""
    drawn = draw_samples(KNOWN | {"slip_distance": "5um (4 to 10um)"}, draws=151)
    found = {key: quantiles(answer.value) for key, answer in lengths(**drawn.values).items()}
    below, above = math.log(5 / 4) / norm.ppf(0.95), math.log(10 / 5) / norm.ppf(0.95)
    expected = [MEDIAN * math.exp((below if q < 0.5 else above) * norm.ppf(q)) for q in QUANTILES]
    assert_allclose(found["critical_length"], expected, rtol=1e-3)
    assert_allclose(found["rice_ruina"], np.array(expected) / 4, rtol=1e-3)
    ratio = float(stability_length(**KNOWN, slip_distance=5e-6)) / MEDIAN
    assert_allclose(found["stability_length"], np.array(expected) * ratio, rtol=1e-3)


def test_two_ranges_are_independent():
    """The logarithms' variances add up."""
    uncertain = {"slip_distance": "5um (4 to 6.25)", "normal_stress": "50MPa (32 to 78.125)"}
    lengths = critical_length(**draw_samples(KNOWN | uncertain, draws=4000).values)
    width = math.hypot(math.log(1.25), math.log(1.5625)) / norm.ppf(0.95)
    expected = MEDIAN * np.exp(width * norm.ppf(QUANTILES))
    assert_allclose(np.quantile(lengths, QUANTILES), expected, rtol=0.03)


def test_a_signed_parameter_is_normal_and_may_be_stable():
    """A stable draw has an infinite length: quantiles are those of zeta from its other end."""
    uncertain = {"zeta": "0.005 (-0.001 to 0.011)", "slip_distance": 5e-6, "a": 0.01}
    found = lengths(**draw_samples(FAULT | uncertain, draws=100).values)
    critical = found["critical_length"]
    width = 0.006 / norm.ppf(0.95)
    share = np.isfinite(critical.value).mean()
    assert share == pytest.approx(1 - norm.cdf(-0.005 / width), abs=0.006)
    assert (np.asarray(critical.status) == "stable").mean() == pytest.approx(1 - share)
    zeta = 0.005 + width * norm.ppf(1.0 - np.array(QUANTILES))
    expected = MEDIAN * 0.005 / zeta[:4]
    for key in ("critical_length", "homogeneous_sliding"):
        own = quantiles(with_never(found[key].value, found[key].status))
        assert_allclose(own[:4], expected, rtol=0.03)
        assert np.isinf(own[4]) and zeta[4] < 0.0
    errors = errors_of_quantiles(with_never(critical.value, critical.status))
    assert np.isfinite(errors[:3]).all() and np.isinf(errors[4])


def test_quantiles_hold_within_their_errors():
    """Of other seeds, and of ten times as many draws: not more than three errors off."""
    uncertain = KNOWN | {"slip_distance": "5um (3 to 10)", "normal_stress": "50MPa (20 to 90)"}
    few = [critical_length(**draw_samples(uncertain, 200, seed).values) for seed in range(5)]
    exact = np.quantile(critical_length(**draw_samples(uncertain, draws=20000).values), QUANTILES)
    for lengths_of_draws in few:
        off = np.abs(quantiles(lengths_of_draws) - exact)
        assert (off < 3.0 * errors_of_quantiles(lengths_of_draws)).all()
    scatter = np.std([quantiles(x) for x in few], axis=0)
    stated = errors_of_quantiles(few[0])
    assert (scatter < 2.0 * stated).all() and (stated < 0.2 * exact).all()


def test_samples_are_joint():
    """Of each row its own length; an infinite height is a half-space."""
    rows = {"normal_stress": np.array([4e7, 5e7, 6e7]), "height": np.array([0.1, np.inf, 10.0])}
    own = FAULT | {"a": 0.01, "zeta": [0.005, 0.004, 0.003], "slip_distance": 5e-6} | rows
    found = critical_length(**draw_samples(own).values)
    for i, length in enumerate(found):
        one = {name: np.asarray(x)[i] if np.ndim(x) else x for name, x in own.items()}
        assert length == pytest.approx(critical_length(**one), rel=1e-12)


def test_draws_repeat_and_do_not_depend_on_other_ranges():
    one = KNOWN | {"slip_distance": "5um (4 to 10)"}
    first, again, other = draw_samples(one), draw_samples(one), draw_samples(one, seed=1)
    more = draw_samples({"poisson_ratio": ""} | one | {"poisson_ratio": "0.2 (0.1 to 0.3)"})
    for drawn in (again, more):
        assert np.array_equal(first.values["slip_distance"], drawn.values["slip_distance"])
    assert not np.array_equal(first.values["slip_distance"], other.values["slip_distance"])


def test_invalid_draws_are_left_out_and_counted():
    uncertain = KNOWN | {"slip_distance": 5e-6}
    with pytest.raises(ParameterError, match=r"0.5.*must lie in"):
        draw_samples(uncertain | {"poisson_ratio": "0.45 (0.4 to 0.5)"})
    found = draw_samples(uncertain | {"poisson_ratio": "0.45 (0.35 to 0.499)"}, draws=40)
    beyond = 1 - norm.cdf(0.05 / 0.049 * norm.ppf(0.95))
    assert found.invalid["poisson_ratio"] == pytest.approx(40 * beyond, abs=1)
    assert found.total == 40 == found.values["poisson_ratio"].size + sum(found.invalid.values())
    with pytest.raises(ParameterError, match=r"no draw is a valid fault.*slip_distance"):
        draw_samples(KNOWN | {"slip_distance": [-1.0, np.nan]})


@pytest.mark.parametrize(
    "changed, message",
    [
        ({"slip_distance": "5um (6 to 10)"}, "VALUE .LOW to HIGH.*5 and 95 %"),
        ({"slip_distance": "5um (4MPa to 10)"}, "4MPa.*stress.*m is needed"),
        ({"slip_distance": "5um (-4 to 10)"}, r"-4e-06 m .*must lie in \[1e-15"),
        ({"height": "5cm (1 to inf)"}, "finite"),
        ({"slip_distance": 5e-6}, "no parameter has a range"),
        ({"slip_distance": [5e-6, 6e-6], "a": [0.01] * 3}, "equal in number.*slip_distance 2"),
        ({"slip_distance": [[5e-6]]}, "numbers in a row"),
    ],
)
def test_what_is_wrong_is_named(changed, message):
    with pytest.raises(ParameterError, match=message):
        draw_samples(KNOWN | changed)
