"""A body that follows its interface, against the one whose waves are followed."""

import dataclasses

import numpy as np
import pytest

from benchmarks.manufactured.dynamics import GivenDisplacement
from nucleation.extraction.extraction import extract
from nucleation.fem.body import Body
from nucleation.fem.grid import Field, Grid, Motion
from nucleation.fem.operator import Operator
from nucleation.model.material import Material
from nucleation.run.run import PAPER_RUN
from nucleation.simulation import stepping
from nucleation.simulation.drive import Drive, Imposed
from nucleation.simulation.run import simulate
from nucleation.simulation.step import Dynamics, State
from nucleation.simulation.stepping import (
    BDF,
    RUNGS_PER_OCTAVE,
    WITHOUT_WAVES,
    rung_below,
    rung_value,
)

MATERIAL = Material(shear_modulus=3.1e9, poisson_ratio=0.29, density=1200.0)
STIFFER = Material(shear_modulus=9e9, poisson_ratio=0.21, density=2700.0)
BODIES = {
    "block": Body((Grid(0.8, 0.1, 16, 5, grading=3.0), MATERIAL)),
    "period": Body((Grid(0.8, 0.1, 17, 5, grading=3.0, periodic=True), MATERIAL)),
    "pair": Body((Grid(0.8, 0.1, 16, 5), MATERIAL), (Grid(0.8, 0.2, 16, 4), STIFFER), "clamped"),
    "pair on rollers": Body(
        (Grid(0.8, 0.1, 16, 5), MATERIAL), (Grid(0.8, 0.2, 16, 4), STIFFER), "roller"
    ),
    "antiplane": Body((Grid(0.8, 0.1, 16, 5), dataclasses.replace(MATERIAL, plane="antiplane"))),
}


def driven(body, step):
    """Dynamics whose slip, loads and frame swing within six steps (s)."""
    x = body.grid.x[1:]
    shape = 1e-6 * np.cos(3.0 * x) * np.exp(-x)

    def swing(time):
        return 1.0 - np.cos(time / step)

    def at(time):
        factors = 1.0 + 0.1 * swing(time), 1e4 * swing(time)
        acceleration = 1e-7 * swing(time) / step**2
        return Imposed(time, 0.0, 0.0, acceleration=acceleration, factors=factors[: len(loads)])

    loads = [body.far_load(1e6)]
    if body.grid.periodic:
        loads.append(body.far_load(0.0, 1.0))
    interface = GivenDisplacement(PAPER_RUN.law, exact_w=lambda time: shape * swing(time))
    return Dynamics(body, interface, Drive(1.0, at, tuple(loads)), BDF(body.crossing_time))


def after(body, rung, condenses):
    """Forces (N/m) and works (J/m) after some steps of a rung."""
    dynamics = driven(body, 1.5 * rung_value(rung))
    dynamics.condenses = condenses
    start = np.zeros(body.modes.n_x)
    operator, imposed = Operator(body, 0.0), dynamics.drive.at(0.0)
    displacement, _ = operator.balance(
        operator.respond(dynamics.load(0.0, dynamics.factors(imposed)), start), start
    )
    motion = body.at_rest(displacement, 0.0, dynamics.factors(imposed))
    nodes = np.zeros(body.grid.n_x + 1)
    state = State((motion,), np.zeros(1), nodes[None], nodes[None], start[None])
    for _ in range(12):
        state, report = dynamics.advance(state, rung)
    assert state.motions[0].is_condensed == condenses
    solved = report.interface
    forces = solved.tangential, solved.normal, [report.driving_force]
    return [*map(np.array, forces), dynamics.works(state.motions[0])]


@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_what_is_missing_is_of_fourth_order(body):
    """In crossings of the body by waves, within some steps that are twice as long.

    Forces on the interface and the edge are; the static field, on which loads do work, is of
    second order.
    """
    first = rung_below(WITHOUT_WAVES * body.crossing_time / 1.5) + 1
    errors = []
    for rung in (first, first + RUNGS_PER_OCTAVE):
        found, expected = (after(body, rung, condenses) for condenses in (True, False))
        pairs = zip(found, expected, strict=True)
        errors.append([np.abs(one - other).max() / np.abs(other).max() for one, other in pairs])
    *of_forces, of_works = np.log2(np.divide(*errors))
    np.testing.assert_allclose(of_forces, 4.0, atol=0.2)
    assert of_works == pytest.approx(2.0, abs=0.01)
    assert max(errors[0][:-1]) < 1e-5


@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_the_field_that_follows_has_the_slip_and_the_work(body):
    """The slip that it follows, and by reciprocity the work of each load."""
    dynamics, rng = driven(body, 1.0), np.random.default_rng(5)
    w, rate = (Field(1e-6 * rng.normal(size=body.modes.n_x), np.empty(0)) for _ in "ab")
    factors = rng.normal(size=len(dynamics.loads))
    motion = Motion(w, rate, 0.0, factors, -factors)
    field = dynamics.condensed_body.expanded(motion)
    again = dynamics.condensed_body.condensed(field)
    np.testing.assert_allclose(again.displacement.modes, w.modes, rtol=0.0, atol=1e-17)
    np.testing.assert_allclose(again.velocity.modes, rate.modes, rtol=0.0, atol=1e-17)
    np.testing.assert_allclose(dynamics.works(motion), dynamics.works(field), rtol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["normal_load", "drive_velocity"])
def test_no_length_depends_on_when_the_body_is_condensed(kind, monkeypatch):
    run = PAPER_RUN.replaced(
        height=0.02,
        block_length=1.2,
        n_x=60,
        n_y=6,
        grading=2.0,
        end_time=30.0,
        longest_step=0.1,
        perturbation=kind,
        strength=1e-4,
        seed=1,
    )
    found = []
    for crossings in (WITHOUT_WAVES, np.inf):
        monkeypatch.setattr(stepping, "WITHOUT_WAVES", crossings)
        found.append(extract(simulate(run)))
    for one in found[:-1]:
        assert one["length"] == pytest.approx(found[-1]["length"], rel=1e-8)
        assert one["onset_time"] == pytest.approx(found[-1]["onset_time"], rel=1e-8)
