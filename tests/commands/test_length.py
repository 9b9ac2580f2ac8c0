"""``nucleation length`` against the library."""

import json
import math
import sys

import asked
import numpy as np
import pytest

from nucleation import commands
from nucleation.answers.lengths import with_range
from nucleation.api import Fault
from nucleation.lengths.formulas import TWO_MATERIALS
from nucleation.lengths.in_use import LENGTHS

WORDS = [
    "length",
    "--shear-modulus",
    "30GPa",
    "--poisson-ratio",
    "0.25",
    "--normal-stress",
    "50MPa",
    "--a",
    "0.010",
    "--b",
    "0.015",
    "--slip-distance",
    "5um",
]
FAULT = asked.ROCK


def value_of(told, key):
    """The value of one length in JSON."""
    entries = (*told["lengths"], *told.get("literature", ()))
    (entry,) = (entry for entry in entries if entry["key"] == key)
    return entry["value"]


@pytest.fixture
def found(nucleation):
    """What JSON has of the fault with more options."""

    def run(*more):
        ended = nucleation(*WORDS, *more, "--json")
        return json.loads(ended.out, parse_constant=lambda name: pytest.fail(f"{name} in JSON"))

    return run


def test_text(nucleation):
    ended = nucleation(*WORDS, "--velocity", "1e-9", "--density", "2700", "--all")
    assert (ended.code, ended.err) == (0, "")
    assert "L_c    2.513 m" in ended.out and "omega  0.0001414 rad/s" in ended.out
    speed = 1e-9 / 5e-6 / math.sqrt(2) / 2.5 / math.sqrt(30e9 / 2700)
    assert f"c/c_s  {speed:.4g}" in ended.out and "inertia does not matter" in ended.out
    for length in LENGTHS:
        assert length.title in ended.out
        assert (length.formula in ended.out) == (length.system != TWO_MATERIALS)
    assert "NOT VALID HERE, needs a/b < 0.3781: a/b = 0.6667" in ended.out
    assert "mu* = mu/(1 - nu), b = a + zeta" in ended.out
    fast = nucleation(*WORDS, "--velocity", "100 m/s", "--density", "2700 kg/m^3")
    assert "INERTIA MATTERS" in fast.out
    stress = nucleation(*WORDS, "--plane", "stress")
    assert "mu* = mu (1 + nu), b = a + zeta" in stress.out
    thin = "plates that are much thinner than these lengths"  # which the library can't compare
    assert thin in stress.out and thin not in ended.out


def test_between_both_lengths_of_rubin_and_ampuero_it_is_said_what_holds(nucleation):
    where = [word if word != "0.010" else "0.00675" for word in WORDS]
    said = " ".join(nucleation(*where, "--all").out.split())
    assert said.count("neither length of Rubin and Ampuero holds") == 2
    assert "neither length" not in nucleation(*WORDS, "--all").out


def test_json_has_the_library_s_numbers(found):
    told = found("--velocity", "1 mm/yr", "--height", "2m")
    mode = asked.critical_mode(**FAULT, velocity=1e-3 / (365.25 * 86400), height=2.0)
    assert value_of(told, "critical_length") == pytest.approx(mode.length)
    assert told["mode"]["critical_wavenumber"] == pytest.approx(mode.wavenumber)
    assert told["mode"]["critical_frequency"] == pytest.approx(mode.angular_frequency)
    assert told["parameters"]["height"] == 2.0
    expected = Fault(**FAULT, height=2.0, velocity=1e-9).lengths()
    assert [entry["key"] for entry in told["lengths"]] == list(expected)
    for entry in told["lengths"]:
        value = float(expected[entry["key"]].value)
        assert entry["value"] == (None if np.isnan(value) else pytest.approx(value))
        assert entry["units"] == "m" and (entry["reason"] == "") == (entry["value"] is not None)


OTHER = {"second_shear_modulus": 60e9, "second_poisson_ratio": 0.3}
SIDES = {"far_side": "free", "second_far_side": "clamped"}


@pytest.mark.parametrize(
    ("options", "own"),
    [
        ("--second-body rigid", {"second_shear_modulus": math.inf}),
        ("--second-shear-modulus 60GPa --second-poisson-ratio 0.3", OTHER),
        ("--second-body deformable --second-height 20cm", {"second_height": 0.2}),
        ("--far-side velocity", {"far_side": "velocity"}),
        ("--far-side free --second-far-side clamped", SIDES),
        ("--plane stress", {"plane": "stress"}),
    ],
)
def test_faults_of_all_kinds(found, options, own):
    told = found("--friction", "0.6", "--height", "30 cm", *options.split())
    expected = asked.critical_length(**FAULT, friction=0.6, height=0.3, **own)
    assert value_of(told, "critical_length") == pytest.approx(expected)
    for name, value in {**own, "height": 0.3}.items():
        assert told["parameters"][name] == ("inf" if value == math.inf else value)


def test_a_held_layer_that_is_stable_does_not_blame_friction(nucleation):
    ended = nucleation(*WORDS, "--height", "1mm", "--far-side", "clamped")
    assert ended.code == 3 and "although friction" in ended.out and "clamped" in ended.out


def test_doubtful_magnitudes_are_warned_of_once(nucleation):
    ended = nucleation(*[word.replace("GPa", "Pa") for word in WORDS])
    assert ended.code == 0 and ended.err.count("are the units right?") == 1


def test_weakening_rate(found):
    told = found("--weakening-rate", "100 GPa/m")
    lengths = {x["key"]: x["value"] for x in told["literature"]}
    assert lengths["uenishi_rice"] == pytest.approx(1.158 * 40e9 / 100e9)


def test_without_velocity_the_frequency_is_relative(nucleation, found):
    """Over V/D it is sqrt(zeta/a) for identical bodies, Eq. (6)."""
    assert "omega  0.7071 V/D" in nucleation(*WORDS).out
    assert found()["mode"]["critical_frequency"] is None
    for more in ([], ["--velocity", "1mm/yr"]):
        ratio = found(*more)["mode"]["critical_frequency_over_rate"]
        assert ratio == pytest.approx(0.5**0.5)


def test_stable_sliding(nucleation):
    words = ["0.02" if w == "0.010" else w for w in WORDS]
    ended = nucleation(*words, "--all")
    assert ended.code == 3 and "sliding is stable at every wavenumber" in ended.out
    assert ended.out.startswith("No patch runs away: ")
    assert "L_b" in ended.out and "0.2667 m" in ended.out  # others are still given
    told = nucleation(*words, "--json")
    assert told.code == 3 and value_of(json.loads(told.out), "critical_length") is None


def test_a_weakening_patch(nucleation, found):
    """W_c, and what a patch of a width does; refused without its surroundings."""
    around = ("--outside-zeta", "-0.005")
    smallest = float(asked.weakening_patch_length(outside_zeta=-0.005, **FAULT))
    creep = ("--velocity", "1e-8m/s")
    told = found(*around, *creep, "--width", "2m")["weakening_patch"]
    assert told["smallest_width"] == pytest.approx(smallest)
    assert told["width_ratio"] == pytest.approx(2.0 / smallest)
    assert told["outcome"].startswith("events, simulated from")
    slow = found(*around, "--width", "2m", "--velocity", "1m/s", "--density", "2700")
    assert "was not tried" in slow["weakening_patch"]["outcome"]
    text = nucleation(*WORDS, *around, "--width", "2m").out
    assert "give the velocity (--velocity)" in " ".join(text.split())
    assert "aging law, 1200 kg/m^3" in text
    text = nucleation(*WORDS, *around, "--width", "1m").out
    told = " ".join(text.split())
    assert "W_c 1.106 m 0.44 L_c" in told and "W 1 m 0.904 W_c it creeps" in told
    assert found()["weakening_patch"] is None
    for alone in (("--width", "1m"), ("--outside-a", "0.01")):
        ended = nucleation(*WORDS, *alone)
        assert "outside_zeta is missing" in ended.err
    ranges = nucleation(*WORDS, *around, "--friction", "0.6 (0.5 to 0.7)")
    assert "outside_zeta is not allowed beside ranges" in ranges.err


def test_the_length_at_the_drop(nucleation):
    """It was 1.07 m in one place and 1.31 m in another; a below f/300 was refused."""
    own = ("--velocity", "1um/s", "--friction", "0.74", "--height", "10cm", "--strength", "1e-5")
    own = (*(word if word != "0.010" else "0.002" for word in WORDS), *own)
    told = json.loads(nucleation(*own, "--json").out)
    fault = Fault(**FAULT | {"a": 0.002}, velocity=1e-6, friction=0.74, height=0.1)
    expected = fault.lengths(strength=1e-5)["drop_length"]
    assert value_of(told, "drop_length") == pytest.approx(expected.value, rel=1e-12)
    text = nucleation(*own).out
    assert ["L", f"{expected.value:.4g}", "m"] in [line.split()[:3] for line in text.splitlines()]
    assert text.startswith(f"The patch runs away at {with_range(expected)} ")
    assert "no L" not in nucleation(*WORDS, "--perturbation", "none").out


def test_a_closed_output_is_no_error(nucleation, monkeypatch):
    """A shell's `>&-` leaves no stream; it was an AttributeError."""
    monkeypatch.setattr(sys, "stdout", None)
    monkeypatch.setattr(sys, "stderr", None)
    assert commands.run(WORDS) == 0


def test_an_option_given_twice_is_refused(nucleation):
    """The last one counted, in silence."""
    ended = nucleation(*WORDS, "--slip-distance", "6um")
    assert ended.code == 2 and "--slip-distance is given twice: 5e-06 and 6e-06" in ended.err
