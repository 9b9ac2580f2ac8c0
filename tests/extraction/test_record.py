"""A record reads a run once, by one definition of everything; its onset and length are known."""

import made_up_runs
import numpy as np
import pytest
import xarray as xr
from configurations import study
from extraction.test_definitions import force_record
from scipy.linalg import eig
from scipy.optimize import brentq

from nucleation.datasets import DatasetError
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.extraction import Record, extract
from nucleation.extraction.growth import frozen_patch
from nucleation.fem.body import Body
from nucleation.fem.grid import Grid
from nucleation.fem.operator import Operator
from nucleation.model.friction import Friction
from nucleation.model.quantities import ParameterError
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.event import slipping_edge
from nucleation.simulation.run import simulate
from replication.configuration.load import configure

SETTINGS = ExtractionSettings(edge_threshold=0.1)
VELOCITY = PAPER_RUN.fault.velocity


def synthetic_simulation(onset=10.0, decay=0.05, **drop):
    """A patch that grows as 0.05 sqrt(t), its slip rate decaying exponentially ahead."""
    x = np.linspace(0.0, 2.0, 801)
    step_time, force = force_record(onset=onset, **drop)
    time = step_time[::3]
    edge = 0.05 * np.sqrt(time)
    rate = VELOCITY * np.exp(-np.maximum(x - edge[:, None], 0.0) / decay)
    return xr.Dataset(
        {
            "slip_rate": (("time", "x"), rate),
            "step_time": ("step", step_time),
            "driving_force": ("step", -force),
            "maximal_slip_rate": ("step", np.where(step_time < onset, 1.0, 1e5) * VELOCITY),
        },
        coords={"time": time, "x": x},
        attrs={"parameters": PAPER_RUN.to_json()},
    )


def test_lengths_follow_every_frame():
    record = Record(synthetic_simulation(), SETTINGS)
    expected = 0.05 * np.sqrt(record.time) + 0.05 * np.log(10.0)
    np.testing.assert_allclose(record.lengths, expected, atol=1e-3)
    assert record.threshold == pytest.approx(0.1 * VELOCITY)
    usual, high, low = record.lengths_at_drop
    np.testing.assert_array_equal(usual, record.lengths[record.frames_at(record.drop_times)])
    assert (high < usual).all() and (usual < low).all()


def test_lengths_never_fall_and_are_those_of_a_run_that_is_going_on():
    simulation = synthetic_simulation()
    pause = 1.0 - 0.999 * np.exp(-(((simulation["time"] - 10.0) / 0.3) ** 2))
    record = Record(simulation.assign(slip_rate=simulation["slip_rate"] * pause), SETTINGS)
    assert (np.diff(record.lengths) >= 0.0).all() and (np.diff(record.lengths) == 0.0).any()
    rates = record.simulation["slip_rate"].values
    one_by_one = [slipping_edge(record.x, rate, record.threshold) for rate in rates]
    np.testing.assert_array_equal(np.maximum.accumulate(one_by_one), record.lengths)


@pytest.mark.parametrize(("fall", "abrupt"), [(0.8, True), (1.6, False)])
def test_an_abrupt_drop_takes_no_longer_than_the_memory_time(fall, abrupt):
    """A fall by 2.5 % counts if 2 % of it are within D/V, which is 0.05 s."""
    record = Record(synthetic_simulation(fall=fall * 0.05, size=0.025), SETTINGS)
    assert (record.onset is not None) == abrupt


def test_frames_of_creep_end_with_the_start_of_the_drop():
    """Not with its steepest part or its end: the drop takes several frames."""
    record = Record(synthetic_simulation(fall=0.04, size=0.2), SETTINGS)
    start, _, end = record.drop_times
    during = (record.time > start) & (record.time <= end)
    assert during.sum() > 1
    assert record.time[record.creep[-1]] <= start


@pytest.mark.parametrize(("kind", "time"), [("edge", 9.0), ("remote", 10.0)])
def test_a_rupture_begins_before_its_force_falls_only_where_an_edge_is_pushed(kind, time):
    """The interface slips at 1e4 V from 9 s on, and the force falls at 10 s."""
    simulation = synthetic_simulation()
    steps = simulation["step_time"].values
    rates = np.where(steps < 9.0, VELOCITY, 1e4 * VELOCITY)
    force = simulation["driving_force"].values.copy()
    force[(steps > 8.99) & (steps < 9.5)] *= 0.999  # a small fall, then the rupture raises it
    rate = 1.0 if kind == "remote" else 0.0
    parameters = PAPER_RUN.replaced(loading=kind, stress_rate=rate)
    changed = simulation.assign(maximal_slip_rate=("step", rates), driving_force=("step", force))
    changed = changed.assign_attrs(parameters=parameters.to_json())
    assert Record(changed, SETTINGS).drop_times[0] == pytest.approx(time, abs=0.02)


def test_extract_reads_the_length_at_onset():
    measured = extract(synthetic_simulation(), SETTINGS)
    length = 0.05 * np.sqrt(10.0) + 0.05 * np.log(10.0)
    assert measured["onset_time"] == pytest.approx(10.0, abs=0.011)
    assert measured["length"] == pytest.approx(length, abs=1e-3)
    low, high = (0.05 * np.sqrt(10.0) + 0.05 * np.log(1 / share) for share in (0.5, 1e-3))
    assert measured["length_low"] == pytest.approx(low, abs=1e-3)
    assert measured["length_high"] == pytest.approx(high, abs=1e-3)
    assert measured["onset_time_low"] <= measured["onset_time"] <= measured["onset_time_high"]


@pytest.mark.slow
def test_a_larger_drop_is_recorded_without_time_after_the_event():
    """The recorder had a drop of its own: with any larger one there was no length, in silence."""
    run = {"height": 0.005, "n_x": 60, "n_y": 4, "end_time": 30.0, "tolerance": 0.1}
    config = study(run | {"longest_step": 0.3, "time_after_event": 0.0}, length_over_critical=3.0)
    asked = configure(config | {"extraction": {"drop": 0.1}})
    (own,) = asked.runs
    assert own.run.stepping.event_drop == 0.1
    found = extract(simulate(own.run), asked.extraction)
    assert 0.1 < found["length"] < own.critical_length
    usual = simulate(own.run.replaced(event_drop=0.02))
    with pytest.warns(UserWarning, match="before it fell by drop = 0.1: simulate with a larger"):
        assert np.isnan(extract(usual, asked.extraction)["length"])
    assert extract(usual)["length"] > 0.1


GRID = Grid(0.8, 0.02, 32, 5)
OPERATOR = Operator(Body((GRID, PAPER_RUN.upper.material)), 0.0)
RATE = np.where(GRID.x < 0.26, 1e-5 * np.exp(-GRID.x / 0.3), 1e-12)
STATE = 0.07 * (1 + GRID.x)
FORCE = 1e6 * (1 + 0.1 * np.cos(5 * GRID.x)) * GRID.nodal_lengths


@pytest.fixture(params=["aging", "slip"])
def friction(request):
    return Friction(law="product", evolution=request.param)


@pytest.fixture
def patch(friction):
    return frozen_patch(OPERATOR, friction, RATE, STATE, FORCE, 1e-7)


def test_spectrum_equals_that_of_differences(friction, patch):
    """Jacobian of (dw/dt, dpsi/dt), v from nodal force balance by bracketing."""
    nodes, n = patch.nodes, patch.nodes.size
    assert n == 10
    base = -friction.coefficient(RATE, STATE)[nodes] * FORCE[nodes]

    def time_derivative(z):
        w = np.zeros(GRID.n_x)
        w[nodes - 1] = z[:n]
        psi = np.log(STATE[nodes]) + z[n:]
        p, normal = OPERATOR.apply(w)
        p, normal = base + p[nodes - 1], FORCE[nodes] + normal[nodes]
        v = np.array(
            [
                brentq(
                    lambda v, i=i: p[i] + friction.coefficient(v, np.exp(psi[i])) * normal[i],
                    1e-14,
                    1.0,
                    xtol=1e-22,
                    rtol=1e-14,
                )
                for i in range(n)
            ]
        )
        return np.append(v, friction.state_rate(v, np.exp(psi)) * np.exp(-psi))

    steps = np.append(np.full(n, 1e-12), np.full(n, 1e-6))
    columns = [
        (time_derivative(unit) - time_derivative(-unit)) / (2 * step)
        for unit, step in zip(np.diag(steps), steps, strict=True)
    ]
    reference = np.linalg.eigvals(np.array(columns).T)
    reference = reference[np.argsort(-reference.real)]
    first, found = reference[:4], patch.eigenvalues[:4]
    scale = np.abs(first).max()
    np.testing.assert_allclose(found.real, first.real, atol=1e-4 * scale)
    np.testing.assert_allclose(np.abs(found.imag), np.abs(first.imag), atol=1e-3 * scale)


def test_modes_and_amplitudes_are_eigenvectors_of_the_whole_matrix(patch):
    """Right and left eigenvectors of the matrix, of twice the size, by LAPACK."""
    values, left, right = eig(patch.matrix, left=True)
    for i in np.argsort(-values.real)[:6]:
        w, log_state = patch.mode(values[i])
        own = np.concatenate([w, log_state])
        assert np.abs(w).max() == pytest.approx(1.0)
        known = right[:, i] / right[np.abs(right[: w.size, i]).argmax(), i]
        np.testing.assert_allclose(own, known, rtol=0, atol=1e-6 * np.abs(known).max())
        weights = patch.amplitude(values[i])
        known = left[:, i].conj() / (left[:, i].conj() @ own)
        np.testing.assert_allclose(weights, known, rtol=0, atol=1e-6 * np.abs(known).max())


@pytest.mark.parametrize("name", ["slip_rate", "driving_force", "maximal_slip_rate", "step_time"])
def test_a_record_with_a_number_that_is_none_is_refused(name):
    """A slip rate that was NaN from some frame on gave L = 0.0637 m in place of 0.1543 m."""
    damaged = made_up_runs.record().copy(deep=True)
    damaged[name][-50:] = np.nan
    with pytest.raises(DatasetError, match=f"{name} is not finite from entry"):
        extract(damaged)


def test_parameters_nested_too_deeply_are_refused():
    """It was a RecursionError."""
    nested = made_up_runs.record().assign_attrs(parameters="[" * 100_000 + "]" * 100_000)
    with pytest.raises(ParameterError, match="nested too deeply"):
        extract(nested)
