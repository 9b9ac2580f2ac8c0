"""At which stress, slip distance or modulus a nucleation length fits: against Eq. (5) by hand."""

import math

import numpy as np
import pytest
from asked import critical_length, specimen_fit, stability_length, transfer_functions

from nucleation.api import ParameterError
from nucleation.theory.creep.patches import Patches

FRICTION = {"a": 0.0068, "zeta": 0.016, "friction": 0.41}
PMMA = {"poisson_ratio": 0.35, **FRICTION}
KNOWN = {"shear_modulus": 3.1e9, "slip_distance": 5e-7}
OTHERS = {**KNOWN, "normal_stress": 1e6}
BODIES = {
    "half-spaces": {},
    "plates": {"height": 0.1, "plane": "stress"},
    "rigid base": {"height": 0.02, "second_shear_modulus": math.inf},
    "two materials": {"second_shear_modulus": 9e9, "height": 0.05, "second_far_side": "clamped"},
}


def by_hand(unknown, length, bodies):
    """``g = h_plus`` at ``k = 2 pi/length``, solved for the factor in ``mu k D G1/sigma0``."""
    k, zeta, b = 2.0 * math.pi / length, FRICTION["zeta"], FRICTION["a"] + FRICTION["zeta"]
    own = {"shear_modulus": OTHERS["shear_modulus"]}
    shear, normal = transfer_functions(k, **own, poisson_ratio=0.35, **bodies)
    square = (FRICTION["friction"] * normal / shear) ** 2
    p, q = 2.0 * zeta + square * b, 1.0 + square
    marginal = (p + math.sqrt(p**2 - 4.0 * q * zeta**2)) / (2.0 * q)
    softness = marginal / (OTHERS["shear_modulus"] * k * float(shear))  # D over sigma0
    if unknown == "slip_distance":
        return softness * OTHERS["normal_stress"]
    return OTHERS["slip_distance"] / softness


@pytest.mark.parametrize("bodies", BODIES.values(), ids=BODIES)
@pytest.mark.parametrize("unknown", ["normal_stress", "slip_distance"])
def test_the_end_is_that_of_the_equation(unknown, bodies):
    for length in (0.03, 0.2, 3.0):
        given = {name: value for name, value in OTHERS.items() if name != unknown}
        found = specimen_fit(unknown, length, **PMMA, **given, **bodies)
        [(low, high)] = found.intervals
        end, other = (low, high) if unknown == "normal_stress" else (high, low)
        assert end == pytest.approx(by_hand(unknown, length, bodies), rel=1e-8)
        assert other in found.searched


@pytest.mark.parametrize("bodies", BODIES.values(), ids=BODIES)
def test_the_creeping_patch_fits_where_it_says(bodies, monkeypatch):
    """Few of the values of the search need L_s: an answer took up to four seconds."""
    solved, creep = [], Patches.creep
    monkeypatch.setattr(Patches, "creep", lambda *given: solved.append(1) or creep(*given))
    fault = PMMA | bodies | KNOWN
    [(low, _)] = specimen_fit("normal_stress", 0.2, "stability", **fault).intervals
    assert 0 < len(solved) < 1000
    assert stability_length(**fault, normal_stress=low) == pytest.approx(0.2, rel=1e-4)
    whole = specimen_fit("normal_stress", 0.2, **fault)
    assert low < whole.intervals[0][0]  # L_s is shorter than L_c


def test_several_answers():
    """With strengthening friction a contrast is needed: moduli near the second one's are stable."""
    fault = {
        "poisson_ratio": 0.2,
        "a": 0.01,
        "zeta": -1e-4,
        "friction": 0.8,
        "slip_distance": 1e-8,
        "normal_stress": 1e8,
        "second_shear_modulus": 1e10,
    }
    found = specimen_fit("shear_modulus", 1.0, **fault)
    assert len(found.intervals) == 2
    (_, first), (second, _) = found.intervals
    assert first < 1e10 < second
    for end, outwards in ((first, 1.0 - 1e-6), (second, 1.0 + 1e-6)):
        inside, outside = end * outwards, end / outwards
        assert critical_length(**fault, shear_modulus=inside) <= 1.0
        assert not critical_length(**fault, shear_modulus=outside) <= 1.0


def test_no_answer():
    stable = PMMA | {"zeta": -0.01}
    found = specimen_fit("normal_stress", 0.2, **stable, **KNOWN)
    assert found.intervals == () and not found.exists
    short = specimen_fit("normal_stress", 0.2, within=(1e4, 1e6), **PMMA, **KNOWN)
    assert short.intervals == () and short.exists


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"unknown": "a"}, "unknown = 'a' is not allowed: one of normal_stress, slip_distance"),
        ({"criterion": "L_c"}, "criterion = 'L_c' is not allowed: one of critical, stability"),
        ({"length": -1.0}, r"length = -1.0 m is not allowed: length of the specimen along"),
        ({"length": [1.0, 2.0]}, "a specimen is one"),
        ({"a": np.array([0.01, 0.02])}, "a specimen is one"),
        ({"within": (1e6, 1e5)}, r"within = \(1e\+06, 100000\) Pa is no range"),
        ({"within": (-1.0, 1e5)}, r"normal_stress = -1.0 Pa is not allowed"),
        ({"slip_distance": -1.0}, "slip_distance = -1.0 m is not allowed"),
    ],
)
def test_what_is_refused(changed, said):
    usual = {"unknown": "normal_stress", "length": 0.2, **PMMA, **KNOWN}
    with pytest.raises(ParameterError, match=said):
        specimen_fit(**usual | changed)
