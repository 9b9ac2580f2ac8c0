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
    "--slip-distance", "5um", "--velocity", "1mm/yr", "--friction", "0.6", "--height", "20cm",
)  # fmt: skip
STRESS = ("--normal-stress", "50MPa")
RANGE = ("--poisson-ratio", "0.25 (0.2 to 0.3)", "--draws", "20")
COMMANDS = {
    "length": ("length", *GRANITE, *STRESS),
    "patch": ("length", *GRANITE, *STRESS, "--outside-zeta", "-0.005", "--width", "1m"),
    "quantiles": ("length", *GRANITE, *STRESS, *RANGE),
    "specimen": ("specimen", "--length", "20cm", *GRANITE, *STRESS),
    "simulate": ("simulate", "x.nc", *GRANITE, *STRESS, "--dry-run"),
    "mistake": ("length", "--shear-modulus", "30um"),
}
SYSTEM = ("length", "specimen", "simulate")


def said(ended):
    return (ended.out + ended.err).splitlines()


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS.keys())
def test_lines_fit_and_words_are_those_of_a_file(nucleation, monkeypatch, command):
    wide = said(nucleation(*command))
    for columns in (80, 70):
        monkeypatch.setenv("COLUMNS", str(columns))
        narrow = said(nucleation(*command))
        assert max(map(len, narrow)) <= columns
        assert sorted(" ".join(narrow).split()) == sorted(" ".join(wide).split())
    assert max(map(len, wide)) > 80


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


@pytest.mark.parametrize("command", SYSTEM)
def test_values_are_printed_as_engineers_write_them(nucleation, command):
    told = nucleation(*COMMANDS[command]).out
    for text in ("modulus = 30 GPa", "height = 200 mm", "distance = 5 um", "stress = 50 MPa"):
        assert text in told
    assert not re.search(r"\de[+-]?\d+ (Pa|m)(?![\w/])", told.partition("theory")[0])


@given(
    value=st.floats(1e-20, 1e20),
    unit=st.sampled_from(["m", "s", "m/s", "Pa", "Pa/s", "Pa/m", "kg/m^3", "1"]),
)
def test_an_engineering_unit_keeps_the_value(value, unit):
    again = parse("value", in_unit(value, unit, digits=6), Quantity("value", unit=unit))
    assert again == pytest.approx(value, rel=1e-5)
