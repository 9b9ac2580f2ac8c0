"""The status beside each NaN: which it is, and what its reason names."""

import math
import re

import numpy as np
import xarray as xr
from asked import critical_length, lengths, lengths_in_use, stability_length

ROCK = {"shear_modulus": 30e9, "poisson_ratio": 0.25, "normal_stress": 50e6, "slip_distance": 5e-6}
NEUTRAL = 0.0148  # of a, where a/b = 0.987 and no patch up to 3 L_c grows
A = [0.010, NEUTRAL, 0.016]


def of(found, key):
    """Length, statuses and reasons of one key."""
    one = found[key]
    return one.value, np.asarray(one.status).tolist(), np.asarray(one.reason).tolist()


def test_the_theory():
    found = lengths(**ROCK, a=A, b=0.015)
    length, status, reason = of(found, "critical_length")
    np.testing.assert_array_equal(length, critical_length(**ROCK, a=A, b=0.015))
    assert status == ["value", "value", "stable"]
    assert reason[:2] == ["", ""] and "friction does not weaken with slip rate" in reason[2]
    patch, status, reason = of(found, "stability_length")
    np.testing.assert_array_equal(patch, stability_length(**ROCK, a=A, b=0.015))
    assert status == ["value", "beyond", "stable"]
    assert reason[0] == ""
    assert "no patch up to 3 L_c has a growing mode" in reason[1]


def test_the_literature_has_the_same_lengths():
    known = lengths_in_use(**ROCK, a=A, b=0.015)
    found = lengths(**ROCK, a=A, b=0.015)
    for key in set(found) & set(known):
        length, status, reason = of(found, key)
        np.testing.assert_array_equal(length, known[key])
        there = np.isfinite(length)
        assert [one == "value" for one in status] == there.tolist()
        assert [one == "" for one in reason] == there.tolist()
    _, status, reason = of(found, "rubin_ampuero_localised")
    assert status == ["unknown", "unknown", "stable"]
    assert reason[0] == "needs a/b < 0.3781: a/b = 0.6667"
    _, status, reason = of(found, "thin_limit")
    assert status[0] == "unknown" and reason[0].endswith("H = inf m")


def test_a_creep_that_opens_the_fault_is_not_a_long_patch():
    """Of a patch on a softer body under very large friction nothing is known."""
    bodies = {"second_shear_modulus": 1e9, "second_poisson_ratio": 0.1, "friction": 5.0}
    found = lengths(**ROCK | bodies | {"shear_modulus": 3e9}, a=0.01, zeta=0.01)
    length, status, reason = of(found, "stability_length")
    assert math.isnan(length) and status == "unknown"
    assert re.fullmatch(r"the creep opens the fault at a patch length of 0\.\d+ L_c", reason)


def test_named_dimensions_stay():
    a = xr.DataArray(A, dims="a")
    height = xr.DataArray([0.1, math.inf], dims="height")
    found = lengths(**ROCK, a=a, b=0.015, height=height)
    found = found.dataset()
    assert found.sizes == {"length": found.sizes["length"], "a": 3, "height": 2}
    one = found.sel(length="critical_length").isel(a=2, height=0)
    assert str(one["status"].values) == "stable"
