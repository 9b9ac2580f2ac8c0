"""Pairs that nothing holds: the whole stays where it is, and its momentum is that of the loads."""

import dataclasses

import numpy as np
import pytest
from simulation.test_condensed import MATERIAL, STIFFER

from benchmarks.manufactured.dynamics import GivenDisplacement
from nucleation.fem.body import Body
from nucleation.fem.grid import Grid
from nucleation.run.run import PAPER_RUN
from nucleation.simulation import step
from nucleation.simulation.drive import Drive, Imposed
from nucleation.simulation.event import Outcome
from nucleation.simulation.interface import NewtonFailure
from nucleation.simulation.run import simulate
from nucleation.simulation.step import Dynamics, State
from nucleation.simulation.stepping import BDF, rung_below, rung_value


def pair(periodic, side="free"):
    n_x = 17 if periodic else 16
    grids = (Grid(0.8, height, n_x, 4, periodic=periodic) for height in (0.1, 0.2))
    return Body(*zip(grids, (MATERIAL, STIFFER), strict=True), far_side=side)


PAIRS = {
    "blocks": pair(False),
    "periods": pair(True),
    "periods on rollers": pair(True, "roller"),
    "periods moved along x": pair(True, "velocity"),
}


def at_rest(body, slip, shear=lambda time: 0.0):
    """Dynamics of a given slip (m) under a shear stress (Pa), both of time, and their start."""
    loads = (body.far_load(1e6), *([body.far_load(0.0, 1.0)] if body.grid.periodic else []))

    def at(time):
        return Imposed(time, 0.0, 0.0, factors=(1.0, shear(time))[: len(loads)])

    interface = GivenDisplacement(PAPER_RUN.law, exact_w=slip)
    dynamics = Dynamics(body, interface, Drive(1e-6, at, loads), BDF(body.crossing_time))
    w, factors = slip(0.0), dynamics.factors(dynamics.drive.at(0.0))
    operator = dynamics.operator(0.0)
    displacement, _ = operator.balance(operator.respond(dynamics.load(0.0, factors), w), w)
    nodes = np.zeros((1, body.grid.n_x + 1))
    motion = body.at_rest(displacement, 0.0, factors)
    return dynamics, State((motion,), np.zeros(1), nodes, nodes, w[None])


def creep(body, rate):
    """Slip that grows at a rate (m/s), not the same along x."""
    shape = 1.0 + 0.3 * np.cos(2.0 * np.pi * body.grid.x[1:] / body.grid.length)
    return lambda time: rate * time * shape


def centres(body, motion):
    """The place (m) and the velocity (m/s) of the centre of mass along free directions."""
    return [[free.of(field) for field in motion[:2]] for free in body.translations]


@pytest.mark.parametrize("crossings", [1e2, 1e4, 1e6, 1e8])
@pytest.mark.parametrize("body", PAIRS.values(), ids=PAIRS)
def test_a_free_pair_does_not_drift_however_long_the_steps(body, crossings):
    """Within 300 steps at creep; the round-off of a step was once amplified by each further one."""
    rung = rung_below(crossings * body.crossing_time)
    slip = creep(body, 1e-9 / rung_value(rung))
    dynamics, state = at_rest(body, slip)
    for _ in range(300):
        state, report = dynamics.advance(state, rung)
    (place, velocity) = np.abs(centres(body, state.motions[0])).max(axis=0)
    slid = np.abs(report.interface.w).max()
    assert place < 1e-9 * slid
    assert velocity < 1e-9 * slid / rung_value(rung)


@pytest.mark.parametrize("crossings", [1e3, 1e5, 1e6, 1e7, 1e8])
@pytest.mark.parametrize("periodic", [True, False])
def test_forces_of_creep_are_static_however_long_the_steps(crossings, periodic):
    """A stiffness that is round-off, where inertia alone holds the pair, once made them wrong."""
    n_x = 65 if periodic else 64
    grids = (Grid(1.0, 0.5, n_x, 12, 40.0, periodic) for _ in "ab")
    body = Body(*zip(grids, (MATERIAL, STIFFER), strict=True))
    rung = rung_below(crossings * body.crossing_time)
    dynamics, state = at_rest(body, creep(body, 1e-8 / rung_value(rung)))
    for _ in range(20):
        state, report = dynamics.advance(state, rung)
    found = report.interface
    load = dynamics.load(0.0, dynamics.factors(dynamics.drive.at(0.0)))
    static = dynamics.operator(0.0).respond(load, found.w)
    largest = np.abs(static.normal).max()
    np.testing.assert_allclose(found.tangential[1:], static.tangential, atol=1e-6 * largest)
    np.testing.assert_allclose(found.normal, static.normal, atol=1e-6 * largest)


@pytest.mark.parametrize(("crossings", "bound"), [(0.2, 1e-9), (2e4, 0.05)])
@pytest.mark.parametrize("name", ["periods", "periods on rollers"])
def test_momentum_of_each_layer_is_the_impulse_of_its_load_and_of_friction(name, crossings, bound):
    """In steps that resolve waves, and in long ones, where round-off adds up to 2 %.

    The layers' momenta are equal and opposite.
    """
    body = PAIRS[name]
    rung = rung_below(crossings * body.crossing_time)
    duration = 200.0 * rung_value(rung)

    def shear(time):
        return 1e4 * (1.0 - np.cos(2.0 * np.pi * time / duration))

    dynamics, state = at_rest(body, creep(body, 1e-3), shear)
    moment, impulse, largest = [0.0, 0.0], [0.0, 0.0], 0.0  # kg/s, as the step's formula has it
    for _ in range(120):
        formula = dynamics.scheme.step(rung, state.past_times).body
        state, report = dynamics.advance(state, rung)
        force = shear(state.time) * body.grid.length + report.interface.tangential[1:].sum()
        past = [c * p for c, p in zip(formula.past, impulse, strict=True)]
        impulse = [sum(past) + formula.beta * force, impulse[0]]
        momentum = state.motions[0].momentum
        moment = [momentum, moment[0]]
        largest = max(largest, abs(momentum))
        assert momentum == pytest.approx(impulse[0], abs=bound * largest)
        (velocity,) = [part.modes for part in body.parts(state.motions[0].velocity)[1:]]
        lower = body.layers[1]
        below = lower.material.density * lower.row_sums @ velocity[:, 0] @ body.modes.x_integral
        assert below == pytest.approx(-momentum, abs=1e-12 * largest)


def test_a_momentum_that_no_load_has_given_is_refused():
    """As of a body that was set in motion by an error."""
    body = PAIRS["periods"]
    dynamics, state = at_rest(body, creep(body, 1e-6))
    for free in body.translations[:1]:
        free.taken_from(state.motions[0].velocity, -1.0)
    with pytest.raises(NewtonFailure, match="momentum") as refused:
        dynamics.advance(state, rung_below(body.crossing_time))
    assert refused.value.outcome is Outcome.MOMENTUM


def with_rates(dynamics, monkeypatch, rates):
    """Let the interface find these slip rates (m/s) in its next solution."""
    solve = dynamics.interface.solve

    def found(*arguments, **named):
        return dataclasses.replace(solve(*arguments, **named), slip_rate=rates)

    monkeypatch.setattr(
        GivenDisplacement, "solve", lambda self, *all, **named: found(*all, **named)
    )


@pytest.mark.parametrize(("change", "words"), [(1e6, "where waves allow"), (1e-21, "falls to")])
def test_slip_that_no_wave_allows_is_refused(change, words, monkeypatch):
    """100 m/s between two layers under 1 MPa, and a stop of all nodes within a step."""
    body = PAIRS["periods"]
    dynamics, state = at_rest(body, creep(body, 1e-4))
    rung = rung_below(body.crossing_time)
    state, _ = dynamics.advance(state, rung)
    with_rates(dynamics, monkeypatch, change * state.past_slip_rates[0])
    with pytest.raises(NewtonFailure, match=words) as refused:
        dynamics.advance(state, rung)
    assert refused.value.outcome is Outcome.IMPOSSIBLE


@pytest.mark.parametrize("change", [1e3, 1e-19])
def test_fast_and_slow_slip_is_not_refused(change, monkeypatch):
    body = PAIRS["periods"]
    dynamics, state = at_rest(body, creep(body, 1e-4))
    rung = rung_below(body.crossing_time)
    state, _ = dynamics.advance(state, rung)
    with_rates(dynamics, monkeypatch, change * state.past_slip_rates[0])
    dynamics.advance(state, rung)


def test_an_absurd_run_fails_with_its_reason(monkeypatch):
    """If waves allowed a millionth of what they do, a creeping fault would be absurd."""
    monkeypatch.setattr(step, "IMPOSSIBLE", 1e-6)
    run = PAPER_RUN.replaced(n_x=16, n_y=2, block_length=0.9, end_time=0.1)
    record = simulate(run)
    assert record.attrs["status"] == Outcome.IMPOSSIBLE
    assert not record.attrs["completed"]
