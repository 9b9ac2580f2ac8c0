"""``nucleation length`` with ranges against the library."""

import json
import re

import numpy as np
import pytest

from nucleation.api import Fault, draw_samples, quantiles
from nucleation.theory.creep import front

ROCK = ["length", "--shear-modulus", "30GPa", "--normal-stress", "50MPa", "--slip-distance", "5um"]
WORDS = [*ROCK, "--poisson-ratio", "0.25 (0.2 to 0.3)", "--b", "0.015"]
FAULT = {"shear_modulus": 30e9, "normal_stress": 50e6, "slip_distance": 5e-6}
A = "0.012 (0.008 to 0.016)"  # in a few draws the fault is stable
DRAWN = ["--a", A, "--draws", "40"]


def test_the_library_s_numbers(nucleation):
    ended = nucleation(*WORDS, *DRAWN, "--json")
    drawn = draw_samples(FAULT | {"poisson_ratio": "0.25 (0.2 to 0.3)", "b": 0.015, "a": A}, 40)
    expected = Fault(**drawn.values).lengths("none")
    found = json.loads(ended.out)
    stable = int(np.isnan(expected["critical_length"].value).sum())
    assert (ended.code, found["draws"], found["invalid"]) == (0, 40, 0)
    assert found["stable"] == stable and 0 < stable < 10
    assert sorted(found["uncertain"]) == ["a", "poisson_ratio"]
    assert [entry["key"] for entry in found["lengths"]] == list(expected)
    critical = expected["critical_length"].value
    (entry,) = (entry for entry in found["lengths"] if entry["key"] == "critical_length")
    counted = np.where(np.isfinite(critical), critical, np.inf)
    values = [float(x) for x in entry["quantiles"].values()]
    np.testing.assert_allclose(values, quantiles(counted), rtol=1e-12)
    assert entry["share"] == 1.0 - stable / 40
    assert "sliding is stable" in entry["why_not"]
    lines = nucleation(*WORDS, *DRAWN).out.splitlines()
    (line,) = (line for line in lines if "critical length L_c" in line)
    assert line.split()[-1] == f"{100.0 - 2.5 * stable:.1f}%"
    text = rf"40 draws of (a, )?poisson_ratio(, a)?: 0 left out, {stable} of the"
    assert any(re.match(text, line) for line in lines)


def test_the_length_at_the_drop_of_draws(nucleation, monkeypatch):
    monkeypatch.setattr(front, "FINE", 20)  # roughly, in a second
    monkeypatch.setattr(front, "AT_REST", 20)
    range_ = ["--slip-distance", "5um (4 to 6)", "--draws", "20"]
    words = [*ROCK[:-2], *range_, "--poisson-ratio", ".25", "--a", ".005", "--b", ".02"]
    own = [*words, "--velocity", "1um/s", "--friction", ".6", "--height", "2m"]
    assert "runs away" not in nucleation(*own).out
    found = json.loads(nucleation(*own, "--strength", "1e-4", "--json").out)
    (drop,) = (entry for entry in found["lengths"] if entry["key"] == "drop_length")
    assert drop["share"] == 1.0 and drop["quantiles"]["0.05"] < drop["quantiles"]["0.95"]


def test_ranges_in_a_file(nucleation, tmp_path):
    words = dict(zip(WORDS[1::2], WORDS[2::2], strict=True))
    file = tmp_path / "rock.yaml"
    file.write_text("\n".join(f"{k[2:].replace('-', '_')}: {v}" for k, v in words.items()))
    from_file = nucleation("length", "--parameters", file, *DRAWN)
    assert from_file == nucleation(*WORDS, *DRAWN) and from_file.code == 0
    for command in (("simulate", tmp_path / "x.nc"), ("specimen", "--length", "2m")):
        ended = nucleation(*command, "--parameters", file, "--b", "0.015", "--a", "0.01")
        assert ended.code == 2 and "a range is not allowed here" in ended.err


def test_a_fault_that_is_stable_in_all_draws(nucleation):
    ended = nucleation(*ROCK, "--poisson-ratio", "0.25", "--zeta", "-0.01", *DRAWN)
    assert (ended.code, ended.err) == (3, "")
    assert "40 of the others stable" in ended.out


@pytest.mark.parametrize(
    "words, message",
    [
        ([*ROCK, "--poisson-ratio", ".25"], "zeta or b = a . zeta is needed"),
        ([*WORDS, "--width", "2m"], "width is not allowed beside ranges"),
        ([*WORDS, "--height", "2m (3 to 4)"], "--height.*VALUE .LOW to HIGH"),
    ],
)
def test_what_is_refused(nucleation, words, message):
    ended = nucleation(*words, *DRAWN)
    assert ended.code == 2
    assert re.search(message, ended.err)
