"""``nucleation specimen`` against the library."""

import json

import asked
import pytest

WORDS = [
    "specimen",
    "--length",
    "20cm",
    "--height",
    "10cm",
    "--shear-modulus",
    "3.1GPa",
    "--poisson-ratio",
    "0.35",
    "--a",
    "0.0068",
    "--zeta",
    "0.016",
    "--slip-distance",
    "0.5um",
    "--plane",
    "stress",
]
FAULT = {
    "height": 0.1,
    "shear_modulus": 3.1e9,
    "poisson_ratio": 0.35,
    "a": 0.0068,
    "zeta": 0.016,
    "slip_distance": 5e-7,
    "plane": "stress",
}


@pytest.mark.slow
@pytest.mark.parametrize("criterion", ["critical", "stability"])
def test_json_has_the_library_s_numbers(nucleation, criterion):
    ended = nucleation(*WORDS, "--criterion", criterion, "--normal-stress", "1MPa", "--json")
    found, fit = json.loads(ended.out), asked.specimen_fit("normal_stress", 0.2, criterion, **FAULT)
    assert (ended.code, ended.err) == (0, "")
    assert found["intervals"] == [list(interval) for interval in fit.intervals]
    given = found["given"]
    for name, forward in asked.CRITERIA.items():
        now = float(forward(**FAULT, normal_stress=1e6))
        assert given[name]["value"] == pytest.approx(now) and given[name]["status"] == "value"
    assert given["value"] == 1e6 and given["verdict"]
    assert found["unknown"] == "normal_stress" and found["plane"] == "stress"


def test_other_unknowns(nucleation):
    more = nucleation(*WORDS, "--normal-stress", "2MPa").out
    assert "At normal_stress = 2 MPa it can nucleate: L_s is" in more
    ended = nucleation(*WORDS, "--normal-stress", "1MPa", "--find", "slip_distance")
    assert "slip_distance < 257.6 nm" in ended.out
    soft = [x for x in WORDS if x not in ("--shear-modulus", "3.1GPa")]
    ended = nucleation(*soft, "--normal-stress", "1MPa", "--find", "shear_modulus")
    assert "shear_modulus = to find, poisson_ratio = 0.35" in ended.out


def test_several_intervals_and_none(nucleation):
    contrast = [
        "specimen",
        "--length",
        "20",
        "--poisson-ratio",
        "0.2",
        "--a",
        "0.01",
        "--friction",
        "0.8",
        "--slip-distance",
        "0.01um",
        "--normal-stress",
        "100MPa",
        "--second-shear-modulus",
        "10GPa",
        "--find",
        "shear_modulus",
        "--shear-modulus",
        "10GPa",
    ]
    ended = nucleation(*contrast, "--zeta=-1e-4")
    assert ended.code == 0 and "it does not nucleate: sliding is stable" in ended.out
    assert "shear_modulus < 1.952 GPa\n  shear_modulus > 51.24 GPa" in ended.out
    ended = nucleation(*contrast, "--zeta=-9e-3")
    assert ended.code == 3 and "never: there is none at all values; sliding is stable" in ended.out


def test_a_specimen_that_is_too_short_at_every_value(nucleation):
    """It is told how short the length is at best, and at which value."""
    short = [*WORDS[:2], "1nm", *WORDS[3:]]
    ended = nucleation(*short, "--json")
    found = json.loads(ended.out)
    assert (ended.code, found["status"], found["intervals"]) == (0, "beyond", [])
    best = float(asked.critical_length(**FAULT, normal_stress=1e10))
    assert found["reason"] == f"L_c is {best:.4g} m at least, at normal_stress = 1e+10 Pa"
    text = nucleation(*short).out
    assert f"never: it is longer at all values; {found['reason']}" in text


PLATES = [
    "--height",
    "10cm",
    "--plane",
    "stress",
    "--shear-modulus",
    "3.1GPa",
    "--poisson-ratio",
    "0.33",
    "--a",
    "0.0068",
    "--zeta",
    "0.0156",
    "--slip-distance",
    "0.5um",
    "--normal-stress",
    "1MPa",
    "--friction",
    ".41",
    "--velocity",
    "10um/s",
]


@pytest.mark.parametrize(
    ("length", "criterion", "verdict"),
    [
        ("25", "critical", "it nucleates: L_s is 0.1675 m, 0.67 of the specimen, and L at the"),
        ("20", "critical", "it can nucleate: L_s is 0.1675 m, 0.838 of the specimen"),
        ("15", "critical", "whether it nucleates is not known: L_s is 0.1675 m, 1.12 of the"),
        ("15", "stability", "whether it nucleates is not known: L_s is 0.1675 m, 1.12 of the"),
        ("12", "critical", "blocks of one simulated fault had events from 0.7 L_s on"),
    ],
)
def test_a_simulated_event_is_not_denied(nucleation, length, criterion, verdict):
    """Blocks of these lengths had events of .13 to .36 m/s; L_c, .32 m, denied all of them."""
    ended = nucleation("specimen", "--length", f"{length}cm", *PLATES, "--criterion", criterion)
    assert ended.code == 0 and "does not nucleate" not in ended.out
    assert verdict in " ".join(ended.out.split())
