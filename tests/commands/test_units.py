"""Values as people write them."""

import math

import pytest

from nucleation.commands.units import parse, registry
from nucleation.configuration.load import schema
from nucleation.configuration.settings import Limits
from nucleation.configuration.studies import STUDY_PARAMETERS
from nucleation.model.quantities import ParameterError, Quantity, declarations
from nucleation.theory.fault import QUANTITIES


@pytest.mark.parametrize(
    ("key", "text", "value"),
    [
        ("shear_modulus", "30 GPa", 30e9),
        ("shear_modulus", "30GPa", 30e9),
        ("shear_modulus", "30e9", 30e9),
        ("shear_modulus", " 3.1E+9 Pa ", 3.1e9),
        ("shear_modulus", "300 kbar", 30e9),
        ("shear_modulus", "3e10 N/m^2", 3e10),
        ("shear_modulus", "3e10 N/m**2", 3e10),
        ("shear_modulus", "1e6 psi", 6.894757e9),
        ("normal_stress", "50MPa", 50e6),
        ("slip_distance", "5um", 5e-6),
        ("slip_distance", "5 µm", 5e-6),
        ("slip_distance", "5 μm", 5e-6),
        ("slip_distance", "5 micrometers", 5e-6),
        ("slip_distance", ".5mm", 5e-4),
        ("height", "10 km", 1e4),
        ("height", "3ft", 0.9144),
        ("height", "inf", math.inf),
        ("height", "infinity", math.inf),
        ("velocity", "1 mm/yr", 1e-3 / (365.25 * 86400)),
        ("velocity", "35 mm/year", 0.035 / (365.25 * 86400)),
        ("velocity", "10 um/s", 1e-5),
        ("poisson_ratio", "0.25", 0.25),
        ("poisson_ratio", "25 %", 0.25),
        ("poisson_ratio", "-0.1", -0.1),
        ("zeta", "5e-3", 0.005),
        ("far_side", "velocity", "velocity"),
    ],
)
def test_values_in_si_units(key, text, value):
    found = parse(key, text, QUANTITIES[key])
    assert found == value if isinstance(value, str) else found == pytest.approx(value, rel=1e-6)


@pytest.mark.parametrize(
    ("key", "text", "words"),
    [
        ("shear_modulus", "30 m", "m is a unit of length, but Pa is needed"),
        ("shear_modulus", "30 kg/m^3", "unit of density, but Pa"),
        ("shear_modulus", "30 GPA", "GPA is not a known unit"),
        ("shear_modulus", "30 GPa/2", "not a known unit"),
        ("shear_modulus", "GPa", "it is no number with a unit"),
        ("shear_modulus", "", "it is no number with a unit"),
        ("shear_modulus", "thirty", "it is no number with a unit"),
        ("shear_modulus", "3,1 GPa", "not a known unit"),
        ("shear_modulus", "nan", "it is no number"),
        ("shear_modulus", "nan GPa", "it is no number"),
        ("shear_modulus", "inf", r"\(0, 1e\+13\) Pa"),
        ("shear_modulus", "-30 GPa", "shear_modulus = -30000000000.0 Pa is not allowed"),
        ("shear_modulus", "1e999", "is not allowed"),
        ("shear_modulus", "30 __import__('os')", "not a known unit"),
        ("velocity", "1 mm", "m/s is needed"),
        ("poisson_ratio", "0.25 m", "unit of length, but it has no dimension"),
        ("poisson_ratio", "0.5", r"poisson_ratio = 0.5 is not allowed: Poisson's ratio"),
        ("far_side", "Velocity", "one of velocity, traction"),
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
    entry = Quantity("number", low=2, high=10, closed="both", kind="int")
    assert parse("n", " 7 ", entry) == 7
    for text in ("7.0", "7 m", "1e1", "11", "1" * 5000, "", "0x7"):
        with pytest.raises(ParameterError, match=r"must be an integer in \[2, 10\]"):
            parse("n", text, entry)


def test_every_declared_unit_is_known_to_the_units_library():
    groups = [declarations(Limits), *map(schema.group_entries, schema.GROUPS)]
    entries = [entry for _, entry in STUDY_PARAMETERS.values()] + list(QUANTITIES.values())
    entries += [entry for group in groups for entry in group.values()]
    for entry in entries:
        if entry.unit != "1":
            registry().parse_units("megabyte" if entry.unit == "MB" else entry.unit)
