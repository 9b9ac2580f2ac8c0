"""``nucleation length`` with ranges and samples against the library."""

import json
import math
import re

import numpy as np
import pytest

from nucleation import api
from nucleation.commands.uncertainty import as_sure

ROCK = ["length", "--shear-modulus", "30GPa", "--normal-stress", "50MPa", "--slip-distance", "5um"]
WORDS = [*ROCK, "--poisson-ratio", "0.25 (0.2 to 0.3)", "--b", "0.015"]
FAULT = {"shear_modulus": 30e9, "normal_stress": 50e6, "slip_distance": 5e-6}
A = [0.010, 0.011, 0.012, 0.016]


@pytest.fixture
def samples(tmp_path):
    """A file of four samples of a, the last of a fault that is stable."""
    path = tmp_path / "posterior.csv"
    path.write_text("a\n" + "\n".join(map(str, A)))
    return ["--samples", path]


def test_the_library_s_numbers(nucleation, samples):
    ended = nucleation(*WORDS, *samples, "--json")
    expected = api.length_quantiles(**FAULT, poisson_ratio="0.25 (0.2 to 0.3)", b=0.015, a=A)
    found = json.loads(ended.out)
    assert (ended.code, found["stable"], found["draws"], found["invalid"]) == (0, 1, 4, 0)
    assert sorted(found["uncertain"]) == ["a", "poisson_ratio"]
    assert found["parameters"]["a"] == 0.0115
    for entry in found["lengths"]:
        own = expected.sel(key=entry["key"])
        assert entry["share"] == own["share"]
        values = [math.nan if x is None else float(x) for x in entry["quantiles"].values()]
        np.testing.assert_allclose(values, own["value"], rtol=1e-12)
    lines = nucleation(*WORDS, *samples).out.splitlines()
    (line,) = (line for line in lines if "critical length L_c" in line)
    own = expected.sel(key="critical_length")
    row = [as_sure(*pair) for pair in zip(own["value"].values, own["error"].values, strict=True)]
    assert line.split()[-6:] == [*row, "75.0%"] and "stable" in row
    assert any(x.startswith("4 draws of poisson_ratio, a: 0 left out, 1 of the") for x in lines)


def test_values_per_decade(nucleation, samples, tmp_path):
    decimal = tmp_path / "decimal.csv"
    decimal.write_text("a\n" + "\n".join(str(a * math.log(10)) for a in A))
    own = [*WORDS[:-1], str(0.015 * math.log(10)), "--per-decade", "--samples", decimal]
    assert nucleation(*own).out == nucleation(*WORDS, *samples).out


def test_the_second_body_is_like_the_first(nucleation, samples):
    """Unless it is another one: the pair's own lengths are among the others then."""
    assert "two half-spaces of the two" not in nucleation(*WORDS, *samples).out
    other = nucleation(*WORDS, *samples, "--second-body", "60GPa,0.3", "--friction", "0.6")
    pair, first = (
        f"for two {x} half-spaces of the" if x else "for two half-spaces of the two"
        for x in ("", "identical")
    )
    assert 0 < other.out.index(pair) < other.out.index(first)


def test_ranges_in_a_file(nucleation, samples, tmp_path):
    words = dict(zip(WORDS[1::2], WORDS[2::2], strict=True))
    file = tmp_path / "rock.yaml"
    file.write_text("\n".join(f"{k[2:].replace('-', '_')}: {v}" for k, v in words.items()))
    given, one = ["--parameters", file], ["specimen", "--length", "1m"]
    from_file = nucleation("length", *given, *samples)
    assert from_file == nucleation(*WORDS, *samples) and from_file.code == 0
    ended = nucleation("simulate", tmp_path / "x.nc", *given)
    assert ended.code == 2 and "a range is not allowed here" in ended.err
    own = [*given, "--a", "0.01", "--draws", "20"]
    assert "20 draws of poisson_ratio" in nucleation("length", *own).out
    assert "in  50% of the draws" in nucleation(*one, *own).out


def test_a_law_that_is_named(nucleation, samples, tmp_path):
    """Its fault has both bodies and zeta in numbers; b stays, and the second body varies too."""
    file = tmp_path / "fault.yaml"
    file.write_text("friction_law: dieterich_ruina\nfriction: 0.6\nvelocity: 1um/s\nheight: 20cm")
    found = json.loads(nucleation(*WORDS, *samples, "--parameters", file, "--json").out)
    expected = api.length_quantiles(
        **FAULT, poisson_ratio="0.25 (0.2 to 0.3)", b=0.015, a=A, height=0.2
    )
    values = list(map(float, found["lengths"][0]["quantiles"].values()))
    np.testing.assert_allclose(values, expected["value"][0], rtol=1e-12)


def test_a_fault_that_is_stable_in_all_draws(nucleation, samples):
    ended = nucleation(*ROCK, "--poisson-ratio", "0.25", "--zeta", "-0.01", *samples)
    assert (ended.code, ended.err) == (3, "")
    assert "4 of the others stable" in ended.out


@pytest.mark.parametrize(
    "words, message",
    [
        ([*WORDS, "--a", "0.01"], "a is given twice: as an option and in .*posterior.csv"),
        ([*ROCK, "--poisson-ratio", ".25"], "zeta or b is needed beside an uncertain a"),
        ([*WORDS, "--density", "2700"], "density is not allowed beside ranges"),
        ([*WORDS, "--height", "2m (3 to 4)"], "--height.*VALUE .LOW to HIGH"),
    ],
)
def test_what_is_refused(nucleation, samples, words, message):
    ended = nucleation(*words, *samples)
    assert ended.code == 2
    assert re.search(message, ended.err)


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (2.8083, 0.04, "2.81"),
        (8.09, 0.6, "8.1"),
        (9.19, 1.1, "9"),
        (4.89012, 1e-5, "4.890"),
        (12.3, 20.0, "10"),
        (3.2e-7, 1e-9, "3.20e-07"),
        (math.inf, math.inf, "stable"),
        (3.0, math.inf, "3"),
        (math.nan, math.nan, "nan"),
    ],
)
def test_digits_follow_the_error(value, error, text):
    assert as_sure(value, error) == text
