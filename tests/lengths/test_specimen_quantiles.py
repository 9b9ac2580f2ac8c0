"""Shares of uncertain faults whose length fits into a specimen, against closed forms."""

import math

import numpy as np
import pytest
from scipy.stats import norm

from nucleation.api import ParameterError, specimen_quantiles
from nucleation.lengths.specimen import Fit
from nucleation.lengths.specimen_quantiles import at_share

FAULT = {"shear_modulus": 30e9, "poisson_ratio": 0.25, "a": 0.010, "zeta": 0.005}
LENGTH = 2.0
STRESS = math.pi * 40e9 * 5e-6 / (0.005 * LENGTH)
"""sigma0 (Pa) at which L_c, Eq. (6), is the specimen's length for D = 5 um."""
WIDTH = math.log(1.25) / norm.ppf(0.95)


def stress_at(share):
    """sigma0 (Pa) from which so many draws fit: L_c goes as D/sigma0, and D is log-normal."""
    return STRESS * math.exp(WIDTH * norm.ppf(share))


def test_a_distance_of_a_range():
    given = FAULT | {"slip_distance": "5um (4 to 6.25)"}
    found = specimen_quantiles("normal_stress", LENGTH, **given, draws=100)
    for share, intervals in found.intervals.items():
        ((first, last),) = intervals
        ((error, at_end),) = found.errors[share]
        assert last == found.searched[1] and at_end == 0.0
        assert first == pytest.approx(stress_at(share), rel=0.03)
        assert abs(first - stress_at(share)) < 3.0 * error
    assert math.isnan(found.share) and (found.draws, found.invalid) == (100, 0)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.9])
def test_the_share_at_the_value_that_is_given(share):
    given = FAULT | {"slip_distance": "5um (4 to 6.25)", "normal_stress": stress_at(share)}
    found = specimen_quantiles("normal_stress", LENGTH, **given, draws=50)
    assert found.share == pytest.approx(share, abs=0.02)
    assert found.share_error == pytest.approx(math.sqrt(share * (1.0 - share) / 50), rel=0.1)


def test_the_parameter_that_is_looked_for_may_be_uncertain_itself():
    """Half of the draws nucleate where its median is the threshold's."""
    given = FAULT | {"slip_distance": 5e-6, "normal_stress": [0.5 * STRESS, 0.9 * STRESS] * 10}
    given["normal_stress"] = np.array(given["normal_stress"] + [1.1 * STRESS] * 20)
    found = specimen_quantiles("normal_stress", LENGTH, **given, draws=40)
    assert found.share == 0.5
    assert found.intervals[0.05] == found.intervals[0.95]


def test_progress_is_reported_after_every_draw():
    seen = []
    given = FAULT | {"slip_distance": np.linspace(4e-6, 6e-6, 5)}
    specimen_quantiles("normal_stress", LENGTH, **given, progress=lambda *now: seen.append(now))
    assert seen == [(i + 1, 5) for i in range(5)]


def test_draws_may_have_several_intervals_or_none():
    fits = [
        Fit("x", "m", intervals, (1.0, 100.0), True, True, "value", "")
        for intervals in (((1.0, 4.0), (10.0, 100.0)), ((2.0, 5.0),), ((3.0, 20.0),), ())
    ]
    assert at_share(fits, 0.25) == ((1.0, 100.0),)
    assert at_share(fits, 0.5) == ((2.0, 5.0), (10.0, 20.0))
    assert at_share(fits, 0.75) == ((3.0, 4.0),)
    assert at_share(fits, 1.0) == ()


def test_without_uncertainty_it_is_refused():
    with pytest.raises(ParameterError, match="no parameter has a range"):
        specimen_quantiles("normal_stress", LENGTH, **FAULT, slip_distance=5e-6)
