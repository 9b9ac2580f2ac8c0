"""Runs of two deformable blocks: records, and the rigid base as the limit."""

import itertools

import numpy as np
import pytest

from nucleation.run.run import PAPER_RUN, Run
from nucleation.simulation.run import instants, simulate
from nucleation.simulation.start import composed

COARSE = PAPER_RUN.replaced(
    height=0.02, block_length=1.2, n_x=60, n_y=4, grading=2.0, end_time=30.0,
    time_after_event=0.0, longest_step=0.2, tolerance=0.05
)  # fmt: skip
BOTTOMS = ("free", "clamped", "roller")


def pair(bottom="free", **changed):
    second = {"second_body": "deformable", "second_far_side": bottom, "second_n_y": 5}
    return COARSE.replaced(**(second | changed))


def test_bodies_meet_at_the_interface():
    parameters = pair(second_height=0.03, second_density=2400.0, end_time=0.3)
    record = simulate(parameters)
    assert Run.from_json(record.attrs["parameters"]).below.material.density == 2400.0
    dynamics = composed(parameters)
    for instant in itertools.islice(instants(parameters, dynamics=dynamics), 0, 21, 10):
        state = instant.state
        above_x, above_y = dynamics.body.nodal_values(state.displacement)
        below_x, below_y = dynamics.body.nodal_values(state.displacement, 1)
        np.testing.assert_allclose(above_y[0], below_y[0], atol=1e-18)  # no opening
        slip = above_x[0] - below_x[0]
        np.testing.assert_allclose(slip[1:], state.past_w[0], atol=1e-18)


def test_a_stiff_clamped_block_is_the_rigid_base():
    """Force and slip rates are the same, but for the base's own compliance."""
    short = {"end_time": 2.0, "longest_step": 0.4}
    rigid = simulate(COARSE.replaced(**short))
    stiff = simulate(
        pair("clamped", **short, second_shear_modulus=9e12, second_height=0.001, second_n_y=2)
    )
    force = [float(run["driving_force"][-1]) for run in (rigid, stiff)]
    assert force[1] == pytest.approx(force[0], rel=1e-4)
    rates = [run["slip_rate"].values[-1] for run in (rigid, stiff)]
    np.testing.assert_allclose(rates[1], rates[0], rtol=2e-3, atol=1e-9)
