"""A second body in configurations: what it is, its own theory, what is refused and warned of."""

import pytest
from configurations import messages, study

from nucleation.fault import Fault
from nucleation.run.complete import stiffness_of
from nucleation.run.run import PAPER_RUN
from replication.configuration.load import configure

RUN = "studies.s.runs[0]"
RIGID = "is not allowed with second_body = rigid"
PAIR = {"height": 0.02, "second_body": "deformable"}

REFUSED = {
    "density of a rigid body": (
        study({"height": 0.1, "second_density": 2000.0}),
        f"{RUN}: second_density = 2000.0 {RIGID}",
    ),
    "under a study that fixes the rigid base": (
        study({"height": 0.1, "second_height": [0.1, 0.2]}, defaults={"second_body": "rigid"}),
        f"{RUN}: second_height = 0.1 {RIGID}",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_nonsense_is_refused(case):
    config, expected = REFUSED[case]
    assert expected in messages(config)


def test_what_is_left_out_is_as_of_the_first_body():
    below = configure(study({**PAIR, "second_shear_modulus": 6e9})).runs[0].run.below
    parameters = PAPER_RUN.replaced(height=0.02)
    assert below.height == 0.02 and below.far_side == "free"
    assert (below.n_y, below.grading) == (parameters.block.n_y, parameters.block.grading)
    assert (below.material.shear_modulus, below.material.density) == (6e9, 1200.0)
    assert PAPER_RUN.below is None


@pytest.mark.parametrize("bottom", ["free", "clamped", "roller"])
def test_each_run_has_the_theory_of_its_own_far_sides(bottom):
    entry = {**PAIR, "second_far_side": bottom, "second_shear_modulus": 6e9, "second_height": 0.03}
    (run,) = configure(study(entry)).runs
    friction = run.run.law.expansion(1e-5)
    expected = Fault(
        shear_modulus=3.1e9, poisson_ratio=1 / 3, height=0.02, second_shear_modulus=6e9,
        second_height=0.03, second_far_side=bottom, friction=friction.f0, a=friction.a,
        zeta=friction.zeta, slip_distance=5e-7, normal_stress=1e6,
    ).critical_length()  # fmt: skip
    assert run.critical_length == pytest.approx(float(expected), rel=1e-9)
    assert run.run.block.length == pytest.approx(6 * run.critical_length, rel=1e-3)


def test_estimates_go_with_the_softer_body():
    """In the limits of the theory, by hand: thick bodies share, thin ones bend on one another."""
    thick = PAPER_RUN.replaced(height=50.0, second_body="deformable")
    soft = thick.replaced(second_shear_modulus=3.1e7)
    own = 3.1e9 / (1.0 - 1.0 / 3.0)
    assert stiffness_of(thick.fault)[0] == pytest.approx(own / 2.0, rel=1e-6)
    assert soft.process_zone() < 0.03 * thick.process_zone()
    thin = PAPER_RUN.replaced(height=0.01, second_body="deformable")
    assert stiffness_of(thin.fault)[1] == pytest.approx(own * 2 * 0.01 / 8.0, rel=1e-4)
    assert stiffness_of(thin.replaced(second_far_side="clamped").fault)[1] == pytest.approx(
        own * 2 * 0.01, rel=1e-4
    )
    assert soft.growth_time(0.1) > 20 * thick.growth_time(0.1)
