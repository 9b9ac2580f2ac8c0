"""What the theory's functions are given: every value that is accepted has an answer."""

import itertools
import math

import numpy as np
import pytest
import xarray as xr
from asked import ROCK, critical_length, critical_mode, lengths_in_use, stability_length

from nucleation.model.quantities import ParameterError
from nucleation.theory.values import QUANTITIES

FAULT = ROCK | {"velocity": 1e-9}
FUNCTIONS = (critical_length, critical_mode, stability_length, lengths_in_use)
BAD = {
    "masked": (np.ma.array([50e6, 1e6], mask=[False, True]), "some of its values are masked"),
    "none": (None, "is missing"),
    "ragged": ([[1e6], [1e6, 2e6]], "must be a number, an array of numbers or a DataArray"),
    "dataset": (xr.Dataset({"a": 1.0}), "and not this Dataset"),
    "in an object": ([1e6, None], "must lie in"),
    "a date": (np.datetime64("2020-01-01"), "must lie in"),
    "tiny": (5e-324, "must lie in [1e-06, 1e+13) Pa"),
    "zero": (0.0, "must lie in"),
}


@pytest.mark.parametrize("function", FUNCTIONS)
@pytest.mark.parametrize(("value", "message"), BAD.values(), ids=BAD)
def test_bad_value_is_refused_by_its_key(function, value, message):
    with pytest.raises(ParameterError) as refused:
        function(**FAULT | {"normal_stress": value})
    assert str(refused.value).startswith("normal_stress") and message in str(refused.value)


def test_a_mask_without_masked_values_does_not_matter():
    plain = np.array([50e6, 1e6])
    found = critical_length(**FAULT | {"normal_stress": np.ma.array(plain)})
    np.testing.assert_array_equal(found, critical_length(**FAULT | {"normal_stress": plain}))


MORE = {
    "second_height": {"height": 1.0, "friction": 0.6},
    "zone_thickness": {"zone_shear_modulus": 1e9},
    "zone_shear_modulus": {"zone_thickness": 0.1},
}
"""Parameters that others need."""


@pytest.mark.filterwarnings("ignore::nucleation.model.hints.ImplausibleWarning")
@pytest.mark.parametrize("name", [name for name, entry in QUANTITIES.items() if entry.low > 0.0])
def test_the_least_value_of_each_parameter_has_an_answer(name):
    entry = QUANTITIES[name]
    more = MORE.get(name, {})
    for value in (entry.low, entry.low * (1.0 + 1e-9)):
        given = FAULT | more | {name: value, "friction": 0.6}
        assert math.isfinite(critical_length(**given)) and critical_length(**given) > 0.0
    with pytest.raises(ParameterError, match=rf"{name} = .* is not allowed: .* must lie in \["):
        critical_length(**FAULT | more | {name: 0.5 * entry.low})


@pytest.mark.filterwarnings("ignore::nucleation.model.hints.ImplausibleWarning")
def test_corners_of_the_ranges_have_an_answer():
    names = ("shear_modulus", "normal_stress", "slip_distance", "height")
    ends = [(QUANTITIES[name].low, min(0.99 * QUANTITIES[name].high, 1e30)) for name in names]
    for corner in itertools.product(*ends):
        given = FAULT | dict(zip(names, corner, strict=True))
        length, stable = critical_length(**given), stability_length(**given)
        assert 0.0 < length < math.inf and 0.0 < stable < 3.0 * length
