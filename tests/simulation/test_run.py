"""Whole runs of one body and of two on coarse grids: outcome, records, what must not matter."""

import dataclasses
import itertools

import numpy as np
import pytest

from benchmarks.nodal import nodal_values
from nucleation.extraction.extraction import extract
from nucleation.model.friction import EVOLUTIONS
from nucleation.run.run import PAPER_RUN, Run
from nucleation.simulation.event import Outcome
from nucleation.simulation.interface import Interface, NewtonFailure
from nucleation.simulation.recorded import RECORDED
from nucleation.simulation.run import SimulationFailure, instants, simulate
from nucleation.simulation.start import composed
from nucleation.simulation.step import Dynamics

COARSE = PAPER_RUN.replaced(
    height=0.005,
    block_length=0.9,
    n_x=60,
    n_y=6,
    grading=2.0,
    end_time=30.0,
    time_after_event=0.1,
    tolerance=5e-2,
    longest_step=0.1,
)


@pytest.fixture(scope="module")
def coarse_run():
    return simulate(COARSE)


@pytest.mark.slow
def test_run_ends_after_its_event(coarse_run):
    assert coarse_run.attrs["status"] == Outcome.AFTER_EVENT
    assert coarse_run.attrs["completed"] == 1
    measured = extract(coarse_run)
    after = float(coarse_run["step_time"][-1]) - measured["onset_time_high"]
    assert after == pytest.approx(0.1, abs=0.02)


def test_records_are_whole(coarse_run):
    assert set(coarse_run.variables) <= set(RECORDED)
    assert all(np.isfinite(coarse_run[name]).all() for name in coarse_run.variables)
    assert coarse_run.attrs["steps"] == coarse_run.sizes["step"] - 1
    assert (np.diff(coarse_run["time"]) > 0).all()
    steps = coarse_run["step_size"][1:]
    np.testing.assert_allclose(np.diff(coarse_run["step_time"]), steps, rtol=1e-6, atol=1e-15)
    assert Run.from_json(coarse_run.attrs["parameters"]) == COARSE


def test_interface_obeys_friction_in_every_frame(coarse_run):
    law = COARSE.law
    f = law.coefficient(coarse_run["slip_rate"].values[1:], coarse_run["state"].values[1:])
    ratio = -coarse_run["shear_stress"] / coarse_run["sigma_yy"]
    np.testing.assert_allclose(ratio.values[1:], f, atol=1e-6)
    assert (coarse_run["sigma_yy"] < 0).all()


@pytest.mark.slow
@pytest.mark.parametrize("evolution", EVOLUTIONS)
def test_the_regularised_law_nucleates(evolution):
    """The interface slips under its strength, also where it is stuck far ahead."""
    changes = {"friction_law": "dieterich_ruina", "evolution": evolution, "height": 0.02}
    parameters = COARSE.replaced(**(changes | {"block_length": 1.8, "time_after_event": 0.0}))
    record = simulate(parameters)
    assert record.attrs["completed"] and "event" in record.attrs["status"]
    assert record.attrs["rejected_steps"] < 0.5 * record.attrs["steps"]
    assert 0.4 < extract(record)["length"] / 0.45 < 1.0  # m, of the theory
    rate, state = record["slip_rate"].values[5:, 1:], record["state"].values[5:, 1:]
    ratio = (record["shear_stress"] / record["sigma_yy"]).values[5:, 1:]
    strength = parameters.law.coefficient(rate, state)
    assert (np.abs(np.abs(ratio) - np.abs(strength)) < 1e-3).mean() > 0.99
    assert np.abs(rate).min() < 1e-30 < np.abs(rate).max()


@pytest.mark.slow
def test_quasi_static_run_covers_its_event(coarse_run):
    """Friction strengthens at high rates and bounds the slip rate in place of inertia."""
    quasi_static = simulate(COARSE.replaced(time_after_event=0.0, density=0.0))
    assert quasi_static.attrs["status"] == Outcome.AFTER_EVENT
    one, other = extract(coarse_run), extract(quasi_static)
    assert other["onset_time"] == pytest.approx(one["onset_time"], rel=0.01)
    assert other["length"] == pytest.approx(one["length"], rel=0.02)


def test_step_underflow_is_a_named_failure():
    parameters = COARSE.replaced(shortest_step=0.5)
    with pytest.raises(SimulationFailure, match="fell below the shortest step"):
        list(instants(parameters))
    dataset = simulate(parameters)
    assert dataset.attrs["completed"] == 0
    assert dataset.attrs["status"] == Outcome.STEP_UNDERFLOW


def test_steps_below_the_round_off_of_time_are_a_named_failure():
    """Steps of 1e-7 s after 1e9 s would leave the time as it is."""
    first = next(instants(COARSE))
    late = dataclasses.replace(first.state, past_times=first.state.past_times + 1e9)
    with pytest.raises(SimulationFailure, match="fell below the shortest step"):
        list(itertools.islice(instants(COARSE, (late, first.control)), 3))


def test_tension_is_a_named_failure(monkeypatch):
    """However short the step: as in the slip law's event on fine meshes."""
    solved = Interface.solve

    def solve(self, operator, forces, **others):
        if forces.w[0] < -1e-6:  # the foot of the pushed edge lags behind by 1 um
            raise NewtonFailure("the interface is in tension", Outcome.TENSION)
        return solved(self, operator, forces, **others)

    monkeypatch.setattr(Interface, "solve", solve)
    dataset = simulate(COARSE)
    assert dataset.attrs["status"] == Outcome.TENSION
    assert not dataset.attrs["completed"]
    assert 0.0 < float(dataset["step_time"][-1]) < COARSE.stepping.end_time


def test_nothing_but_numbers_in_a_completed_run(monkeypatch):
    """Should a value ever not be finite, the run has failed and says so."""
    advance = Dynamics.advance

    def spoilt(self, state, rung):
        new, report = advance(self, state, rung)
        return new, dataclasses.replace(report, driving_force=np.nan)

    monkeypatch.setattr(Dynamics, "advance", spoilt)
    dataset = simulate(COARSE.replaced(end_time=1e-5))
    assert dataset.attrs["status"] == Outcome.NOT_FINITE
    assert not dataset.attrs["completed"]


def test_a_perturbed_patch_grows_under_a_law_that_is_steep_at_rest():
    """Nodes whose strength is exceeded must not count as solved: the fault would open in 2.8 s."""
    parameters = PAPER_RUN.replaced(
        friction_law="dieterich_ruina",
        log_state_coefficient=0.0136,
        height=0.03,
        end_time=3.0,
        block_length=3.427,
        n_x=100,
        n_y=4,
        grading=20.0,
        perturbation="normal_load",
        strength=1e-4,
    )
    assert parameters.fault.zeta == pytest.approx(parameters.fault.a)
    record = simulate(parameters)
    assert record.attrs["status"] == Outcome.END_TIME
    assert (np.abs(record["slip_rate"][-1]) > 0.1 * parameters.fault.velocity).sum() >= 4


LOW = COARSE.replaced(height=0.02, block_length=1.2, n_y=4, longest_step=0.4, end_time=2.0)
PAIR = LOW.replaced(second_body="deformable", second_n_y=5)


def test_bodies_meet_at_the_interface():
    parameters = PAIR.replaced(second_height=0.03, second_density=2400.0, end_time=0.3)
    record = simulate(parameters)
    assert Run.from_json(record.attrs["parameters"]).below.material.density == 2400.0
    dynamics = composed(parameters)
    for instant in itertools.islice(instants(parameters, dynamics=dynamics), 0, 21, 10):
        state = instant.state
        above_x, above_y = nodal_values(dynamics.body, state.motions[0].displacement)
        below_x, below_y = nodal_values(dynamics.body, state.motions[0].displacement, 1)
        np.testing.assert_allclose(above_y[0], below_y[0], atol=1e-18)  # no opening
        slip = above_x[0] - below_x[0]
        np.testing.assert_allclose(slip[1:], state.past_w[0], atol=1e-18)


def test_a_stiff_clamped_block_is_the_rigid_base():
    """Force and slip rates are the same, but for the base's own compliance."""
    base = {"second_shear_modulus": 9e12, "second_height": 0.001, "second_n_y": 2}
    stiff = simulate(PAIR.replaced(second_far_side="clamped", **base))
    rigid = simulate(LOW)
    force = [float(run["driving_force"][-1]) for run in (rigid, stiff)]
    assert force[1] == pytest.approx(force[0], rel=1e-4)
    rates = [run["slip_rate"].values[-1] for run in (rigid, stiff)]
    np.testing.assert_allclose(rates[1], rates[0], rtol=2e-3, atol=1e-9)
