"""Numbers in sentences of docs/theory.md, computed anew."""

import math

import pytest
from asked import critical_length, expected_drop
from docs.prose import says

from nucleation.api import extract, simulate
from nucleation.run.run import PAPER_RUN

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


@pytest.mark.slow
def test_drop_in_antiplane_shear():
    """One realisation on the mesh of the study ``converged``, and the law's median."""
    usual = PAPER_RUN.replaced(height=0.02)
    fault = usual.replaced(plane="antiplane", perturbation="normal_load", strength=1e-4)
    critical = fault.critical_length
    length = 3.0 * critical
    fault = fault.replaced(block_length=length, n_x=400, n_y=16, end_time=40.0)
    simulated = extract(simulate(fault))["length"]
    says(
        "theory.md",
        f"the force drops at {float(simulated) / critical:.2f} $L_c$ (one realisation); [the law "
        f"of the drop](drop.md#the-law-of-the-drop) gives "
        f"{expected_drop(fault).length / critical:.2f}.",
    )
