"""Names of other texts are answered with the name that a parameter has here."""

import pytest

from nucleation.model.hints import hint
from nucleation.theory.values import QUANTITIES

API = tuple(QUANTITIES)
OPTIONS = tuple("--" + name.replace("_", "-") for name in API)
FILE = ("a", "zeta", "slip_distance", "height")


SYMBOLS = {
    "Dc": "slip_distance", "D_RS": "slip_distance", "sigma_n": "normal_stress", "f0": "friction",
    "G": "shear_modulus", "nu": "poisson_ratio", "V_pl": "velocity",
}  # fmt: skip


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
