"""Does a weakening patch creep, slip slowly or nucleate, and by which cells it is resolved."""

import math

import pytest
from asked import weakening_patch_length

from nucleation.api import Fault
from nucleation.lengths.weakening_patch import NUCLEATES, outcome, patch_answer, process_zone

ROCK = {
    "shear_modulus": 30e9, "poisson_ratio": 0.25, "normal_stress": 50e6, "a": 0.01, "b": 0.015,
    "slip_distance": 5e-6,
}  # fmt: skip
STATE_LENGTH = 40e9 * 5e-6 / (0.015 * 50e6)


@pytest.mark.parametrize(
    ("changed", "zone"),
    [
        ({}, 0.5 * STATE_LENGTH),
        ({"second_shear_modulus": math.inf, "friction": 0.6, "height": 1e-4},
         math.sqrt(2e-4 * STATE_LENGTH)),
        ({"plane": "antiplane"}, 0.375 * STATE_LENGTH),
    ],
)  # fmt: skip
def test_process_zone(changed, zone):
    """By hand: the stiffness of half-spaces is ``mu* k/2``, of a thin layer ``2 mu* H k^2``."""
    assert process_zone(Fault(**ROCK | changed)) == pytest.approx(zone, rel=2e-3)


def test_cells_of_bp1():
    """The benchmark has cells of 25 m or 50 m, and L_b = 342 m: its modulus mu acts as mu/2."""
    bp1 = Fault(
        shear_modulus=32.04e9, poisson_ratio=0.25, normal_stress=50e6, a=0.010, b=0.015,
        slip_distance=8e-3, plane="antiplane",
    )  # fmt: skip
    by_hand = 0.5 * 32.04e9 * 8e-3 / (0.015 * 50e6) / 3.0
    assert patch_answer(bp1, -0.005)["cell_size"] == pytest.approx(by_hand)
    assert 50.0 < by_hand < 60.0


def test_outcome_by_the_width():
    smallest = float(weakening_patch_length(outside_zeta=-0.005, **ROCK))
    found = [
        patch_answer(Fault(**ROCK), -0.005, width=ratio * smallest)
        for ratio in (0.99, 1.01, 0.99 * NUCLEATES, 1.01 * NUCLEATES)
    ]
    words = ["creeps", *["slips slowly or nucleates"] * 2, "nucleates"]
    assert [answer["outcome"] for answer in found] == [f"it {own}" for own in words]
    assert found[0]["width_ratio"] == pytest.approx(0.99)


def test_no_width_nucleates():
    strengthening = patch_answer(Fault(**ROCK | {"b": 0.008}), -0.005, width=1.0)
    unstable = patch_answer(Fault(**ROCK), 0.001, width=1.0)
    for answer in (strengthening, unstable):
        assert math.isnan(answer["smallest_width"])
        assert answer["outcome"] == outcome(math.nan)
        assert answer["outcome"].startswith("no W_c")
    assert patch_answer(Fault(**ROCK), -0.005)["outcome"] == ""
