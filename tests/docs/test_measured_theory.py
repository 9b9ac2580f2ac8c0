"""Numbers in sentences of docs/theory.md, computed anew."""

import math

import pytest
from asked import critical_length
from docs.prose import says

PMMA = {
    "shear_modulus": 3.1e9,
    "normal_stress": 1e6,
    "a": 0.0068,
    "zeta": 0.016,
    "slip_distance": 5e-7,
}


def test_plates_have_shorter_lengths_than_thick_bodies():
    plates = {**PMMA, "poisson_ratio": 0.35, "height": 0.1, "friction": 0.41}
    ratio = critical_length(**plates, plane="stress") / critical_length(**plates)
    says("theory.md", f"$L_c$ is {100.0 * (1.0 - float(ratio)):.0f} % shorter than in plane strain")


@pytest.mark.parametrize(("height", "percent"), [(0.005, 2), (0.1, 35)])
def test_thin_limit_of_blocks_that_are_not_thin(height, percent):
    block = {**PMMA, "poisson_ratio": 1 / 3, "friction": 0.41, "second_shear_modulus": math.inf}
    thin = 2.0 * math.pi * math.sqrt(2.0 * height * 3.1e9 * 5e-7 / (0.016 * (2 / 3) * 1e6))
    above = thin / float(critical_length(**block, height=height)) - 1.0
    assert round(100.0 * above) == percent
    says("theory.md", f"{percent} %")
