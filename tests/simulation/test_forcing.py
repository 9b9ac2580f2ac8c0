"""Perturbed runs: each kind acts as declared, and none is none."""

import dataclasses
from dataclasses import replace

import numpy as np
import pytest

from nucleation.model.realisations import Series, profile
from nucleation.model.settings import Perturbation
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.interface import Interface
from nucleation.simulation.run import simulate
from nucleation.simulation.start import at_rest, composed, grid_of, interface_of
from nucleation.simulation.step import Dynamics

QUIET = PAPER_RUN.replaced(
    height=0.005,
    block_length=0.9,
    n_x=60,
    n_y=4,
    grading=2.0,
    end_time=1.0,
    tolerance=5e-2,
    longest_step=0.1,
)


def perturbed(kind, strength=1e-2, base=QUIET, **others):
    declared = Perturbation(kind=kind, strength=strength, seed=7, **others)
    return replace(base, perturbation=declared)


def series_of(parameters):
    return Series(7, parameters.perturbation.correlation_time * parameters.memory_time)


@pytest.fixture(scope="module")
def records():
    return {kind: simulate(perturbed(kind)) for kind in ("drive_velocity", "normal_load")}


def test_strength_zero_is_the_quiet_run():
    quiet = simulate(QUIET)
    assert simulate(perturbed("drive_velocity", strength=0.0)).equals(quiet)
    assert simulate(perturbed("none", strength=0.1)).equals(quiet)


def test_the_drive_moves_as_declared(records):
    record, parameters = records["drive_velocity"], perturbed("drive_velocity")
    drive = composed(parameters).drive
    series = series_of(parameters)
    shaken = [series.value(time) for time in record["step_time"].values]
    velocity = 1e-5 * (1.0 + 1e-2 * np.array(shaken))
    assert velocity.std() == pytest.approx(1e-7, rel=0.8)
    assert [drive.at(t).velocity for t in record["step_time"].values] == pytest.approx(velocity)
    time = record["time"].values
    edge = [drive.at(t) for t in time]
    rates, slips = (record[name].values[:, 0] for name in ("slip_rate", "slip"))
    np.testing.assert_allclose(rates, [at.velocity for at in edge], rtol=1e-14)
    np.testing.assert_allclose(slips, [at.displacement for at in edge], rtol=1e-13)
    stuck = np.abs(record["slip"].values[:, 30])  # slip there is that of the drive less w
    assert stuck.max() < 2e-3 * drive.at(time[-1]).displacement


def test_the_load_acts_as_declared(records):
    record = records["normal_load"]
    carried = -record["sigma_yy"].values @ grid_of(QUIET.upper).nodal_lengths / 0.9
    series = series_of(perturbed("normal_load"))
    shaken = [series.value(time) for time in record["time"].values]
    applied = 1e6 * (1.0 + 1e-2 * np.array(shaken))
    np.testing.assert_allclose(carried, applied, rtol=1e-9)


def test_strength_varies_as_declared():
    drive = composed(perturbed("strength")).drive
    expected = 1.0 + 1e-2 * profile(7, 0.02, np.linspace(0.0, 0.9, 61))
    np.testing.assert_allclose(drive.at(0.3).strength, expected, rtol=1e-12)


@pytest.mark.slow
def test_state_is_forced_as_declared():
    # of a fault at rest in the slip law nothing changes but by the source
    parameters = perturbed("state").replaced(evolution="slip", longest_step=0.02)
    record = simulate(parameters)
    even = simulate(parameters.replaced(perturbation="none", strength=0.0))
    x, time = record["x"].values, record["time"].values
    drive, far = composed(parameters).drive, x > 0.6
    fine = np.linspace(0.0, time[-1], 4001)
    source = np.array([drive.at(t).state_forcing[far] for t in fine])
    expected = np.trapezoid(source, fine, axis=0)
    grown = np.log(record["state"].values[-1, far] / even["state"].values[-1, far])
    np.testing.assert_allclose(grown, expected, rtol=0.02, atol=2e-2 * np.abs(expected).max())


def test_steps_resolve_the_correlation_time():
    declared = {"correlation_time": 0.2}
    short = simulate(perturbed("normal_load", **declared).replaced(end_time=0.2))
    assert short["step_size"].values.max() <= 0.1 * 0.2 * 0.05 * (1 + 1e-12)


def tolerance(**values):
    parameters = PAPER_RUN.replaced(tolerance=1e-2, **values)
    return interface_of(parameters, grid_of(parameters.upper)).tolerance


@pytest.mark.parametrize(("strength", "found"), [(1e-2, 1e-5), (1e-7, 1e-7), (1e-12, 1e-8)])
def test_under_a_perturbation_it_is_a_thousandth_of_the_step_s(strength, found):
    """But no coarser than the perturbation, and no finer than that of an unperturbed run."""
    assert tolerance(perturbation="normal_load", strength=strength) == pytest.approx(found)
    assert tolerance() == 1e-8


SLIDING = PAPER_RUN.replaced(
    height=0.02, block_length=0.4, n_x=16, n_y=4, grading=2.0, normal_stress=2e5, velocity=1e-3
)
LADDER = (*range(-92, -60, 4), *[-60] * 30)
STRENGTH = 1.3


def last_step(parameters, drive=None, interface=None):
    """The report after some steps of the usual composition, but for drive and interface."""
    usual = composed(parameters)
    others = interface or usual.interface, drive or usual.drive
    dynamics = Dynamics(usual.body, *others, usual.scheme)
    state, report = at_rest(dynamics, parameters)
    for rung in LADDER:
        state, report = dynamics.advance(state, rung)
    return state, report


def test_strength_multiplies_friction():
    friction, steady = SLIDING.law, composed(SLIDING).drive
    strength = np.full(17, STRENGTH)
    drive = steady._replace(at=lambda time: steady.at(time)._replace(strength=strength))
    _, found = last_step(SLIDING, drive)
    names = ("base_friction", "rate_coefficient")
    larger = {name: STRENGTH * getattr(friction, name) for name in names}
    stronger = dataclasses.replace(friction, **larger)
    _, expected = last_step(SLIDING, interface=Interface(stronger))
    assert np.count_nonzero(expected.interface.slip_rate > 1e-5) >= 2
    for name in ("slip_rate", "log_state", "tangential", "normal"):
        one, other = getattr(found.interface, name), getattr(expected.interface, name)
        np.testing.assert_allclose(one, other, rtol=1e-7, atol=1e-9 * np.abs(other).max())
