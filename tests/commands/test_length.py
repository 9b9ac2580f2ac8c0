"""``nucleation length`` against the library."""

import json
import math

import numpy as np
import pytest

from nucleation import api
from nucleation.theory import arrays
from nucleation.theory.literature_table import LENGTHS, TWO_MATERIALS

WORDS = [
    "length", "--shear-modulus", "30GPa", "--poisson", "0.25", "--normal-stress", "50MPa",
    "--a", "0.010", "--b", "0.015", "--slip-distance", "5um",
]  # fmt: skip
FAULT = {
    "shear_modulus": 30e9, "poisson_ratio": 0.25, "normal_stress": 50e6, "a": 0.010, "b": 0.015,
    "slip_distance": 5e-6,
}  # fmt: skip


def from_json(ended):
    return json.loads(ended.out, parse_constant=lambda name: pytest.fail(f"{name} in JSON"))


def test_text(nucleation):
    ended = nucleation(*WORDS, "--velocity", "1e-9", "--density", "2700")
    assert (ended.code, ended.err) == (0, "")
    assert "L_c    2.513 m" in ended.out and "omega  0.0001414 rad/s" in ended.out
    speed = 1e-9 / 5e-6 / math.sqrt(2) / 2.5 / math.sqrt(30e9 / 2700)
    assert f"c/c_s  {speed:.4g}" in ended.out and "inertia does not matter" in ended.out
    for length in LENGTHS:
        assert length.title in ended.out
        assert (length.formula in ended.out) == (length.system != TWO_MATERIALS)
    assert "NOT VALID HERE, needs a/b < 0.3781: a/b = 0.6667" in ended.out
    assert max(map(len, ended.out.splitlines())) <= 100


def test_json_has_the_library_s_numbers(nucleation):
    found = from_json(nucleation(*WORDS, "--velocity", "1 mm/yr", "--height", "2m", "--json"))
    velocity = 1e-3 / (365.25 * 86400)
    mode = arrays.critical_mode(**FAULT, velocity=velocity, height=2.0)
    assert found["theory"]["critical_length"] == pytest.approx(mode.length)
    assert found["theory"]["critical_wavenumber"] == pytest.approx(mode.wavenumber)
    assert found["theory"]["critical_frequency"] == pytest.approx(mode.angular_frequency)
    assert found["parameters"]["height"] == 2.0
    expected = api.lengths_in_use(**FAULT, height=2.0)
    assert [entry["key"] for entry in found["lengths"]] == list(expected)
    for entry in found["lengths"]:
        value = float(expected[entry["key"]])
        assert entry["length"] == (None if np.isnan(value) else pytest.approx(value))
        assert entry["units"] == "m" and entry["source"] and entry["validity"]


def test_values_without_units_are_si(nucleation):
    plain = "length --shear-modulus 30e9 --poisson 0.25 --normal-stress 5e7 --a 0.01 --b 0.015"
    ended = nucleation(*plain.split(), "--slip-distance", "5e-6")
    assert ended.code == 0 and ended.out == nucleation(*WORDS).out


def test_zeta_or_b(nucleation):
    words = [*WORDS[: WORDS.index("--b")], "--zeta", "0.005", *WORDS[WORDS.index("--b") + 2 :]]
    assert nucleation(*words).out == nucleation(*WORDS).out


def test_values_per_decade(nucleation):
    """A value for log10 is ln(10) times that for the natural logarithm."""
    decade = [str(float(w) * math.log(10)) if w in ("0.010", "0.015") else w for w in WORDS]
    natural = from_json(nucleation(*WORDS, "--json"))
    found = from_json(nucleation(*decade, "--per-decade", "--json"))
    for name in ("a", "b", "zeta"):
        assert found["parameters"][name] == pytest.approx(natural["parameters"][name])
    assert found["theory"]["critical_length"] == pytest.approx(2.5132741)


@pytest.mark.parametrize(
    ("body", "second"),
    [
        ("rigid", {"second_shear_modulus": math.inf}),
        ("60GPa,0.3", {"second_shear_modulus": 60e9, "second_poisson_ratio": 0.3}),
        (
            "60GPa,0.3,20cm",
            {"second_shear_modulus": 60e9, "second_poisson_ratio": 0.3, "second_height": 0.2},
        ),
    ],
)
def test_second_body(nucleation, body, second):
    words = [*WORDS, "--friction", "0.6", "--height", "30 cm", "--second-body", body]
    found = from_json(nucleation(*words, "--json"))
    expected = arrays.critical_length(**FAULT, friction=0.6, height=0.3, **second)
    assert found["theory"]["critical_length"] == pytest.approx(expected)
    assert found["parameters"]["height"] == 0.3
    if body == "rigid":
        assert found["parameters"]["second_shear_modulus"] == "inf"


def test_far_side(nucleation):
    words = [*WORDS, "--height", "30cm", "--far-side", "velocity", "--json"]
    expected = arrays.critical_length(**FAULT, height=0.3, far_side="velocity")
    assert from_json(nucleation(*words))["theory"]["critical_length"] == pytest.approx(expected)


def test_far_side_of_each_body(nucleation):
    sides = ["--far-side", "free", "--second-far-side", "clamped", "--friction", "0.6"]
    expected = arrays.critical_length(
        **FAULT, height=0.3, friction=0.6, far_side="traction", second_far_side="clamped"
    )
    found = from_json(nucleation(*WORDS, "--height", "30cm", *sides, "--json"))
    assert found["theory"]["critical_length"] == pytest.approx(expected)
    assert found["parameters"]["second_far_side"] == "clamped"


def test_a_held_layer_that_is_stable_does_not_blame_friction(nucleation):
    ended = nucleation(*WORDS, "--height", "1mm", "--far-side", "clamped")
    assert ended.code == 3 and "although friction" in ended.out and "clamped" in ended.out


def test_doubtful_magnitudes_are_warned_of_once(nucleation):
    ended = nucleation(*[word.replace("GPa", "Pa") for word in WORDS])
    assert ended.code == 0 and ended.err.count("are the units right?") == 1


def test_weakening_rate(nucleation):
    words = [*WORDS, "--weakening-rate", "100 GPa/m", "--json"]
    lengths = {x["key"]: x["length"] for x in from_json(nucleation(*words))["lengths"]}
    assert lengths["uenishi_rice"] == pytest.approx(1.158 * 40e9 / 100e9)


def test_without_velocity_the_frequency_is_relative(nucleation):
    assert "omega  0.7071 V/D" in nucleation(*WORDS).out
    assert from_json(nucleation(*WORDS, "--json"))["theory"]["critical_frequency"] is None


def test_stable_sliding(nucleation):
    words = ["0.02" if w == "0.010" else w for w in WORDS]
    ended = nucleation(*words)
    assert ended.code == 3 and "sliding is stable at every wavenumber" in ended.out
    assert "L_b" in ended.out and "0.2667 m" in ended.out  # others are still given
    found = nucleation(*words, "--json")
    assert found.code == 3 and from_json(found)["theory"]["critical_length"] is None


def test_inertia_is_noticed(nucleation):
    ended = nucleation(*WORDS, "--velocity", "100 m/s", "--density", "2700 kg/m^3")
    assert "INERTIA MATTERS" in ended.out


def test_json_has_the_frequency_without_a_velocity(nucleation):
    """Over V/D it is sqrt(zeta/a) for identical bodies, Eq. (6)."""
    words = ["--shear-modulus", "30GPa", "--poisson", "1/4", "--normal-stress", "50MPa", "--a",
             "0.010", "--b", "0.015", "--slip-distance", "5um", "--json"]  # fmt: skip
    for more in ([], ["--velocity", "1mm/yr"]):
        theory = json.loads(nucleation("length", *words, *more).out)["theory"]
        assert theory["critical_frequency_over_rate"] == pytest.approx(0.5**0.5)


def test_plane_stress(nucleation):
    said = nucleation(*WORDS, "--plane", "stress").out
    assert "in plane stress, with mu* = mu (1 + nu), b = a + zeta" in said
    assert "in plane strain, with mu* = mu/(1 - nu), b = a + zeta" in nucleation(*WORDS).out
    found = from_json(nucleation(*WORDS, "--plane", "stress", "--json"))
    expected = math.pi * 30e9 * 1.25 * 5e-6 / (0.005 * 50e6)  # Eq. (6) with mu* = mu (1 + nu)
    assert found["parameters"]["plane"] == "stress"
    assert found["theory"]["critical_length"] == pytest.approx(expected)
    assert found["lengths"][1]["length"] == pytest.approx(expected)
