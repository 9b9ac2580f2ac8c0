"""What a person sees: lines fit the terminal, values have the units in which they were given."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nucleation.commands.text import in_unit, table
from nucleation.model.quantities import Quantity
from nucleation.model.units import parse

GRANITE = (
    "--shear-modulus", "30GPa", "--poisson-ratio", "0.25", "--a", "0.010", "--b", "0.015",
    "--slip-distance", "5um", "--height", "20cm", "--normal-stress", "50MPa",
)  # fmt: skip
MOVED = ("--velocity", "1mm/yr", "--friction", "0.6")
RANGE = ("--poisson-ratio", "0.25 (0.2 to 0.3)", "--draws", "20")
COMMANDS = {
    "length": ("length", *GRANITE, *MOVED),
    "patch": ("length", *GRANITE, "--outside-zeta", "-0.005", "--width", "1m"),
    "quantiles": ("length", *GRANITE, *RANGE),
    "specimen": ("specimen", "--length", "20cm", *GRANITE),
    "simulate": ("simulate", "x.nc", *GRANITE, *MOVED, "--dry-run"),
    "mistake": ("length", "--shear-modulus", "30um"),
}


@pytest.mark.parametrize("kind", COMMANDS)
def test_lines_fit_and_values_are_as_engineers_write_them(nucleation, monkeypatch, kind):
    """Their words are those of a file."""
    ended = nucleation(*COMMANDS[kind])
    wide = (ended.out + ended.err).splitlines()
    monkeypatch.setenv("COLUMNS", "70")
    narrow = "".join(nucleation(*COMMANDS[kind])[1:]).splitlines()
    assert max(map(len, narrow)) <= 70 and max(map(len, wide)) > 80
    assert sorted(" ".join(narrow).split()) == sorted(" ".join(wide).split())
    if kind in ("length", "specimen", "simulate"):
        for text in ("modulus = 30 GPa", "height = 200 mm", "distance = 5 um", "stress = 50 MPa"):
            assert text in ended.out
        assert not re.search(r"\de[+-]?\d+ (Pa|m)(?![\w/])", ended.out.partition("theory")[0])


def test_the_last_column_of_a_table_wraps(monkeypatch):
    rows = [("L", "2 m", "a meaning " * 9), "and a line", ("L_run", "20 m", "short")]
    assert table(rows)[2] == "  L_run  20 m  short"
    monkeypatch.setenv("COLUMNS", "60")
    lines = table(rows)
    assert max(map(len, lines)) <= 60
    starts = {len(line) - len(line.lstrip()) for line in lines if "meaning" in line}
    assert starts == {2, len("  L_run  20 m  ")}
    numbers = table([("id", "1"), ("b", "200")], right=[1])
    assert numbers == ["  id    1", "  b   200"]


@given(
    value=st.floats(1e-20, 1e20),
    unit=st.sampled_from(["m", "s", "m/s", "Pa", "Pa/s", "Pa/m", "kg/m^3", "1"]),
)
def test_an_engineering_unit_keeps_the_value(value, unit):
    again = parse("value", in_unit(value, unit, digits=6), Quantity("value", unit=unit))
    assert again == pytest.approx(value, rel=1e-5)
