"""Names and values as people write them, and arrays that carry a unit."""

import math
from decimal import Decimal
from types import SimpleNamespace

import numpy as np
import pint
import pytest
import xarray as xr

from nucleation.fault.parameters import parameters
from nucleation.model.hints import hint
from nucleation.model.quantities import ParameterError, declarations, declared
from nucleation.model.units import UNITS, in_unit, magnitude, parse, registry, sizes
from nucleation.theory.values import QUANTITIES
from replication.configuration.settings import GROUPS

DENSITIES = ["kg/m^3", "kg/m3", "kg m-3", "kg⋅m⁻³", "kg m**-3", "mg/cm3"]


@pytest.mark.parametrize(
    ("key", "text", "value"),
    [
        ("shear_modulus", "30GPa", 30e9),
        ("shear_modulus", " 3.1E+9 Pa ", 3.1e9),
        ("shear_modulus", "1e6 psi", 6.894757e9),
        ("slip_distance", "5um", 5e-6),
        ("slip_distance", "5 µm", 5e-6),
        ("slip_distance", "5 μm", 5e-6),
        ("height", "3ft", 0.9144),
        ("height", "inf", math.inf),
        ("velocity", "1 mm/yr", 1e-3 / (365.25 * 86400)),
        ("poisson_ratio", "25 %", 0.25),
        ("poisson_ratio", "1/3", 1 / 3),
        ("height", "1 / 4 m", 0.25),
        ("velocity", "1 m s-1", 1.0),
        ("shear_modulus", "3e10 N/m²", 3e10),
        ("shear_modulus", "3e10 N m-2", 3e10),
        ("far_side", "velocity", "velocity"),
        *(("density", f"2700 {unit}", 2700.0) for unit in DENSITIES),
    ],
)
def test_values_in_si_units(key, text, value):
    found = parse(key, text, parameters()[key] if key == "density" else QUANTITIES[key])
    assert found == value if isinstance(value, str) else found == pytest.approx(value, rel=1e-6)


@pytest.mark.parametrize(("unit", "name"), [(unit, name) for unit in UNITS for name in UNITS[unit]])
def test_a_common_unit_has_the_size_of_the_units_library(unit, name):
    found = registry().Quantity(Decimal(1), registry().parse_units(name)).to(unit).magnitude
    assert float(found) == float(sizes(unit)[name])


@pytest.mark.parametrize("unit", UNITS)
def test_common_units_are_in_the_order_of_their_sizes(unit):
    assert list(sizes(unit).values()) == sorted(sizes(unit).values())


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.015, "m", "15 mm"),
        (7200.0, "s", "7200 s"),
        (1e-12, "m", "1e-12 m"),
        (-5e4, "Pa", "-50 kPa"),
        (3.16880878e-11, "m/s", "1 mm/yr"),
        (math.inf, "m", "inf m"),
        (2700.0, "kg/m^3", "2700 kg/m^3"),
    ],
)
def test_a_number_is_shown_in_the_unit_of_its_size(value, unit, text):
    assert in_unit(value, unit) == text


@pytest.mark.parametrize(
    ("key", "text", "words"),
    [
        ("shear_modulus", "30 m", "m is a unit of length, but Pa is needed"),
        ("shear_modulus", "30 GPA", "GPA is not a known unit"),
        ("shear_modulus", "GPa", "it is no number with a unit"),
        ("shear_modulus", "3,1 GPa", "write a decimal point, 3.1 in place of 3,1"),
        ("shear_modulus", " ,5 GPa", "write a decimal point, 0.5 in place of ,5"),
        ("shear_modulus", "5,0e6", "write a decimal point, 5.0 in place of 5,0"),
        ("shear_modulus", "-3,5 MPa", "write a decimal point, -3.5 in place of -3,5"),
        ("shear_modulus", "1.234,5 Pa", "without separators of thousands"),
        ("shear_modulus", "1,234,567 Pa", "without separators of thousands"),
        ("poisson_ratio", "1/0", "it is no number"),
        ("shear_modulus", "inf", r"\[1e-09, 1e\+13\) Pa"),
        ("shear_modulus", "-30 GPa", "shear_modulus = -30000000000.0 Pa is not allowed"),
        ("shear_modulus", "30 __import__('os')", "not a known unit"),
        ("poisson_ratio", "0.25 m", "unit of length, but it has no dimension"),
        ("far_side", "Velocity", "one of velocity, free"),
    ],
)
def test_values_refused(key, text, words):
    with pytest.raises(ParameterError, match=words) as refused:
        parse(key, text, QUANTITIES[key])
    assert str(refused.value).startswith(f"{key} = ")


@pytest.mark.parametrize("number", ["5", "0.3", "1.7", "4.45", "1e-1"])
def test_units_cost_no_rounding(number):
    for key, unit, factor in (("height", "um", "e-6"), ("shear_modulus", "GPa", "e9")):
        expected = float(f"{float(number)}{factor}")
        assert parse(key, f"{number} {unit}", QUANTITIES[key]) == expected


def test_integers():
    entry = declared("number", "[2, 10]", kind="int")
    assert parse("n", " 7 ", entry) == 7
    for text in ("7.0", "7 m", "1e1", "11", "1" * 5000, "", "0x7"):
        with pytest.raises(ParameterError, match=r"must be an integer in \[2, 10\]"):
            parse("n", text, entry)


def test_every_declared_unit_is_known_to_the_units_library():
    groups = [declarations(cls) for cls in GROUPS.values()]
    entries = [*parameters().values(), *QUANTITIES.values()]
    entries += [entry for group in groups for entry in group.values()]
    for entry in entries:
        if entry.unit != "1":
            registry().parse_units(entry.unit)


STRESS = QUANTITIES["normal_stress"]
ROW = xr.DataArray([20.0, 30.0], dims="s", coords={"s": [1, 2]}, attrs={"units": "MPa"})
Q = pint.UnitRegistry().Quantity


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (Q(np.array([20.0, 30.0]), "MPa"), [20e6, 30e6]),
        (Q("0.2 kbar"), 20e6),
        ([Q(20, "MPa"), Q(300, "bar")], [20e6, 30e6]),
        (ROW, [20e6, 30e6]),
        (ROW.assign_attrs(units="N mm-2"), [20e6, 30e6]),
        (xr.DataArray(Q([20.0, 30.0], "MPa"), dims="s"), [20e6, 30e6]),
        (20e6, 20e6),
        (xr.DataArray(5.0), 5.0),
    ],
)
def test_arrays_that_carry_a_unit(value, expected):
    found = magnitude("normal_stress", value, STRESS)
    np.testing.assert_array_equal(found, expected)
    if isinstance(value, xr.DataArray):
        assert found.dims == value.dims and list(found.coords) == list(value.coords)
        assert found.attrs.get("units", "Pa") == "Pa"


def test_units_of_arrays_cost_one_rounding_at_most():
    lengths = np.array([5.0, 0.3, 1.7, 4.45])
    found = magnitude("height", Q(lengths, "um"), QUANTITIES["height"])
    np.testing.assert_allclose(found, [5e-6, 3e-7, 1.7e-6, 4.45e-6], rtol=2.3e-16)
    assert found.tolist()[:3] == [5e-6, 3e-7, 1.7e-6]
    ratio = xr.DataArray(25.0, attrs={"units": "%"})
    assert magnitude("poisson_ratio", ratio, QUANTITIES["poisson_ratio"]) == 0.25
    for none in ("1", "", "dimensionless"):
        alone = ratio.assign_attrs(units=none)
        assert magnitude("a", alone, QUANTITIES["a"]) == 25.0


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (ROW.assign_attrs(units="mm"), "mm is a unit of length, but Pa is needed"),
        (ROW.assign_attrs(units="MPA"), "MPA is not a known unit"),
        (ROW.assign_attrs(units=6), "6, which is no text"),
        (Q(1, "m"), "meter is a unit of length, but Pa is needed"),
        ([Q(1, "MPa"), Q(1, "m")], r"normal_stress\[1\].* unit of length"),
        (SimpleNamespace(unit="MPa", value=3.0), "not known here"),
    ],
)
def test_arrays_refused(value, words):
    with pytest.raises(ParameterError, match=words) as refused:
        magnitude("normal_stress", value, STRESS)
    assert str(refused.value).startswith("normal_stress")


API = tuple(QUANTITIES)
OPTIONS = tuple("--" + name.replace("_", "-") for name in API)
FILE = ("a", "zeta", "slip_distance", "height")
SYMBOLS = {
    "Dc": "slip_distance",
    "D_RS": "slip_distance",
    "sigma_n": "normal_stress",
    "f0": "friction",
    "G": "shear_modulus",
    "nu": "poisson_ratio",
    "V_pl": "velocity",
}


@pytest.mark.parametrize(("name", "meant"), SYMBOLS.items())
def test_symbols_of_other_texts(name, meant):
    assert hint(name, API) == f"did you mean {meant}?"
    assert hint("--" + name, OPTIONS) == f"did you mean --{meant.replace('_', '-')}?"


@pytest.mark.parametrize("name", ["E", "youngs_modulus", "--youngs-modulus", "Young's modulus"])
def test_youngs_modulus_is_not_the_shear_modulus(name):
    assert hint(name, API) == "give shear_modulus: mu = E/(2 (1 + nu))"


@pytest.mark.parametrize("name", ["a-b", "a_minus_b", "b-a"])
def test_the_difference_of_a_and_b_has_its_sign(name):
    assert hint(name, API).startswith("give zeta: zeta = b - a")
    assert hint(name, FILE).startswith("give zeta: ")


def test_misspelt_names():
    assert hint("heigth", API) == "did you mean height?"
    assert hint("xyz", API) == ""
