"""Values as other programs, libraries and languages write them: the value, or what is meant."""

import os
import subprocess
import sys
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pint
import pytest
import xarray as xr
from asked import GRANITE as ROCK

import nucleation
from nucleation.api import PAPER, Fault
from nucleation.model.hints import ImplausibleWarning
from nucleation.model.quantities import ParameterError

PLAIN = Fault(**ROCK).critical_length()


@pytest.mark.parametrize("value", [Decimal("0.008"), Fraction(1, 125)])
def test_numbers_of_python(value):
    assert Fault(**ROCK | {"a": value}).critical_length() == PLAIN


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("6d6", "write the exponent with e, 6e6"),
        ("6.0D+6Pa", "write the exponent with e, 6.0e+6Pa"),
        ("6.0*MPa", "write the unit without *, 6.0 MPa"),
        ("6.0 * MPa", "write the unit without *, 6.0 MPa"),
    ],
)
def test_what_is_meant(text, meant):
    with pytest.raises(ParameterError) as refused:
        Fault(**ROCK | {"normal_stress": text})
    assert meant in str(refused.value)


def test_a_unit_is_that_of_its_own_registry():
    """MPa was taken by its name, a million times as much."""
    own = pint.UnitRegistry()
    own.define("MPa = 1 pascal")
    own.define("load = 6 megapascal")
    redefined = Fault(**ROCK | {"normal_stress": own.Quantity(6e6, "MPa")})
    assert redefined.normal_stress == pytest.approx(6e6)
    assert Fault(**ROCK | {"normal_stress": own.Quantity(1.0, "load")}).normal_stress == 6e6
    exact = Fault(**ROCK | {"slip_distance": pint.UnitRegistry().Quantity(5.0, "um")})
    assert exact.slip_distance == 5e-6


def test_a_quantity_beside_named_arrays():
    stress = pint.UnitRegistry().Quantity(6.0, "MPa")
    height = xr.DataArray([0.1, 0.2], dims="h")
    found = Fault(**ROCK | {"normal_stress": stress, "height": height}).critical_length()
    assert found.dims == ("h",) and float(found[0]) == PLAIN and found.attrs["units"] == "m"


@pytest.mark.parametrize("sides", [np.array(["free", "free"]), ["free"], 1])
def test_a_far_side_is_one_word(sides):
    with pytest.raises(ParameterError, match=r"far_side = .* is not allowed: .* one of velocity"):
        Fault(**ROCK | {"far_side": sides})


def test_settings_of_numpy_do_not_matter():
    fault = Fault(**ROCK, velocity=1e-6, friction=0.65)
    expected = fault.lengths()["drop_length"]
    with np.errstate(all="raise"):
        assert fault.lengths()["drop_length"] == expected


def test_python_without_docstrings():
    code = "from nucleation.api import PAPER; print(PAPER.lengths('none')['critical_length'].value)"
    place = {**os.environ, "PYTHONPATH": str(Path(nucleation.__file__).parents[1])}
    words = [sys.executable, "-OO", "-c", code]
    ended = subprocess.run(words, capture_output=True, text=True, check=True, env=place)
    assert float(ended.stdout) == pytest.approx(PAPER.critical_length())


@pytest.mark.parametrize("a", [0.002, 1e-4])
def test_one_range_of_a_for_all_lengths(a):
    """No law had a below f/300, so that L was refused where L_c was answered."""
    found = Fault(**ROCK | {"a": a}, velocity=1e-6, friction=0.74).lengths()
    assert found["critical_length"].exists
    assert found["drop_length"].exists or "law" not in found["drop_length"].reason


def test_a_length_of_the_size_of_a_country_is_warned_of():
    """D = 0.4 m: L_c = 89 km without a word."""
    with pytest.warns(ImplausibleWarning, match="critical_length = .* is implausible"):
        Fault(**ROCK | {"slip_distance": 0.4, "height": np.inf}).lengths("none")
