"""The watch for the drop against a maximum taken anew; fronts and patches of a few elements."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nucleation.extraction import extraction
from nucleation.extraction.definitions import find_onset
from nucleation.extraction.extraction import Record, extract
from nucleation.run.run import PAPER_RUN
from nucleation.simulation import event, start
from nucleation.simulation.event import (
    FAST,
    FEW,
    Outcome,
    front_width,
    has_dropped,
    long_after,
    patch_runs_away,
    runaway_rate,
)
from nucleation.simulation.run import simulate
from nucleation.simulation.start import composed

forces = st.lists(st.floats(0.0, 1e5) | st.sampled_from([0.0, 1.0, 100.0]), min_size=1, max_size=60)
seeds = st.integers(0, 2**32 - 1)


def series(values, seed):
    """Times that grow by unlike steps, some of them by none, and forces."""
    steps = np.random.default_rng(seed).choice([0.0, 1e-6, 0.01, 0.3, 2.0], size=len(values))
    return np.cumsum(steps), np.array(values)


def naive(times, forces, window, drop):
    """Whether each force is so far below the largest one of its window."""
    return [
        bool(force < (1.0 - drop) * forces[: i + 1][times[: i + 1] >= time - window].max())
        for i, (time, force) in enumerate(zip(times, forces, strict=True))
    ]


@given(forces, seeds, st.floats(0.0, 3.0), st.floats(0.0, 0.99))
def test_watch_is_the_naive_maximum(values, seed, window, drop):
    times, values = series(values, seed)
    steps, maxima = zip(times.tolist(), values.tolist(), strict=True), []
    found = [has_dropped(maxima, window, drop, *each) for each in steps]
    assert found == naive(times, values, window, drop)


@given(forces, seeds, st.floats(0.0, 3.0), st.data())
def test_watch_goes_on_from_its_maxima(values, seed, window, data):
    """They are all that a checkpoint needs to keep, and fall with time."""
    times, values = series(values, seed)
    cut = data.draw(st.integers(0, len(times)))
    maxima, other = [], []
    for i, each in enumerate(zip(times.tolist(), values.tolist(), strict=True)):
        if i == cut:
            other = list(maxima)
        dropped = has_dropped(maxima, window, 0.02, *each)
        assert i < cut or has_dropped(other, window, 0.02, *each) == dropped
    kept_times, kept_forces = np.array(maxima).T
    assert (np.diff(kept_times) >= 0.0).all()
    assert (np.diff(kept_forces) < 0.0).all()


THICK = PAPER_RUN.replaced(
    height=2.0, block_length=5.6, n_x=800, n_y=16, grading=20.0, end_time=1e-3, time_after_event=0.0
)
"""A thick block: without slip at the start its free corner would bear more than its strength."""


@pytest.fixture
def strained_corner(monkeypatch):
    """Blocks that start without slip, whatever their corner bears."""
    monkeypatch.setattr(start, "_relaxed", lambda *arguments: arguments[-1])


def strength_used(parameters):
    """Shear at the start over the strength of sliding at V, at all nodes but the driven one."""
    _, report = start.at_rest(composed(parameters), parameters)
    fault, interface = parameters.fault, report.interface
    strength = parameters.law.coefficient(fault.velocity, fault.initial_state)
    return np.abs(interface.tangential[1:]) / (float(strength) * interface.normal[1:])


def test_the_corner_starts_with_what_it_can_carry():
    used = strength_used(THICK)
    assert used.max() == pytest.approx(1.0, rel=1e-9) and used[-1] == used.max()
    assert np.sort(used)[-2] < 1.0
    made = simulate(THICK)
    assert float(made["maximal_slip_rate"].max()) < 2.0 * THICK.fault.velocity


@pytest.mark.parametrize("height", [0.005, 0.1])
def test_the_papers_start_is_without_slip(height):
    """To the last bit, so that none of the paper's runs depends on how a start is relaxed."""
    parameters = PAPER_RUN.replaced(height=height, block_length=30.0 * height)
    state, _ = start.at_rest(composed(parameters), parameters)
    assert not state.past_w.any()


def test_a_free_corner_that_slips_is_no_event(strained_corner):
    """It was one: at 4.5e-6 s, in a patch of two thousandths of L_c."""
    made = simulate(THICK)
    record = Record(made)
    fastest = int(record.fastest.argmax())
    assert record.fastest[fastest] > 1e-3
    assert made["fastest_position"].values[fastest] > 0.9 * THICK.block.length
    force = np.abs(made["driving_force"].values)
    fast = made["maximal_slip_rate"].values > 10.0 * THICK.fault.velocity
    always = np.ones(fast.size, dtype=bool)
    steps = made["step_time"].values
    naive_onset = find_onset(steps, force, THICK.memory_time, 0.02, fast, always, ~always)
    assert naive_onset is not None, "anything that slips fast was enough"
    assert made.attrs["status"].startswith(Outcome.END_TIME) and record.onset is None


@pytest.mark.parametrize(
    ("kind", "time", "position", "expected"),
    [
        ("edge", 1.0, 0.1, True),
        ("edge", 0.04, 0.1, False),  # before D/V
        ("edge", 1.0, 0.9, False),  # at the far end
        ("remote", 0.04, 0.9, True),
    ],
)
def test_whose_burst_it_is(kind, time, position, expected):
    parameters = PAPER_RUN.replaced(loading=kind, stress_rate=1.0 if kind == "remote" else 0.0)
    velocity = parameters.fault.velocity
    slow, burst, fast = 9.0 * velocity, 600.0 * velocity, 800.0 * velocity
    assert not patch_runs_away(parameters, False, time, slow, position)
    assert patch_runs_away(parameters, False, time, fast, position) == expected
    assert not patch_runs_away(parameters, False, time, burst, position), "it may come to rest"
    later = patch_runs_away(parameters, expected, time + 1e-3, burst, 0.9)
    assert later == expected, "until the burst is over"
    assert not patch_runs_away(parameters, later, time + 2e-3, slow, position)


COARSE = PAPER_RUN.replaced(
    height=0.02,
    block_length=1.84,
    n_x=60,
    n_y=6,
    end_time=30.0,
    time_after_event=0.0,
    tolerance=5e-2,
    longest_step=0.2,
)
"""The mesh of docs/extending.md: two elements to the process zone of the aging law."""
X = np.linspace(0.0, 1.84, 61)


@pytest.mark.parametrize("width", [1.0, 3.0, 10.0])
def test_width_of_a_ramp(width):
    """The logarithm of the state falls by 6 over so many elements, and by nothing elsewhere."""
    element = X[1]
    part = np.clip((X - 0.3) / (width * element), 0.0, 1.0)
    state = 0.05 * np.exp(6.0 * part)
    steepest = np.diff(part).max()
    assert front_width(COARSE, X, state) == pytest.approx(1.0 / steepest)
    assert front_width(COARSE, X, np.where(X < 0.8, state, 0.0)) == pytest.approx(1.0 / steepest)


def test_a_patch_is_long_from_the_frame_nearest():
    slipping = X[None] <= np.array([0.0, 4.0, 5.0, 6.0])[:, None] * X[1] + 1e-9
    rates = np.where(slipping, 1e-5, 1e-20)
    times = np.array([0.0, 1.0, 3.0, 4.0])
    assert long_after(COARSE, X, times, rates) == 2.0
    assert long_after(COARSE, X, times[:2], rates[:2]) == np.inf
    assert long_after(COARSE, X, times[2:], rates[2:]) == -np.inf


@pytest.mark.parametrize(("rate", "slips"), [(0.007, False), (0.013, True)])
def test_the_patch_slips_faster_than_a_hundredth_of_the_imposed_velocity(rate, slips):
    rates = np.full((2, X.size), rate * COARSE.fault.velocity)
    assert (long_after(COARSE, X, np.array([0.0, 1.0]), rates) == -np.inf) == slips


@pytest.mark.parametrize(
    ("begin", "fall", "width"),
    [(0.3, 0.9, np.inf), (0.3, 1.1, 1.0), (0.3, 0.0, np.inf), (1.2, 9.0, np.inf)],
    ids=["small", "front", "even", "where no patch is sought"],
)
def test_a_front_changes_the_logarithm_of_the_state_by_one(begin, fall, width):
    state = np.where(begin > X, 0.05, 0.05 * np.exp(fall))
    assert front_width(COARSE, X, state) == pytest.approx(width)


@pytest.mark.slow
def test_a_run_that_its_mesh_cant_resolve_says_so(square):
    """It had an event in a patch of .11 L_c, and was completed without a word."""
    made = simulate(COARSE)
    record = Record(made)
    status = made.attrs["status"]
    assert status.startswith("completed: the event")
    assert "; not resolved: at the onset the front is 1.0 elements wide" in status
    assert "; no event: the drop at t = 0.4" in status
    force = np.abs(made["driving_force"].values)
    always = np.ones(force.size, dtype=bool)
    masks = record._runs_away, always, ~always
    first = find_onset(record.step_time, force, COARSE.memory_time, 0.02, *masks)
    at_first = record.lengths[record.frames_at(record.step_time[[first.start]])[0]]
    assert at_first < (FEW + 1) * X[1] < record.lengths_at_drop[0, 0]


@pytest.mark.parametrize(("velocity", "over"), [(1e-6, 1000.0), (1e-5, 705.0), (1e-2, 10.0)])
def test_the_rate_of_a_runaway_patch(velocity, over):
    """``v_d = 2 a sigma0 c_s/mu`` of the paper's fault is 7.05 mm/s."""
    law = {"a": 0.0068, "zeta": 0.016, "friction": 0.41}
    parameters = PAPER_RUN.replaced(velocity=velocity, **law)
    assert runaway_rate(parameters) == pytest.approx(over * velocity, rel=2e-3)


NOISY = COARSE.replaced(
    perturbation="normal_load", strength=0.03, seed=1, end_time=20.0, time_after_event=0.0
)


@pytest.mark.slow
def test_bursts_under_a_strong_load_are_no_events():
    """At 4.58 s it slips at 10 V under a falling load, comes to rest, and was called an event."""
    record = Record(simulate(NOISY))
    onset = record.step_time[record.onset.start]
    before = record.fastest[record.step_time < onset]
    assert before.max() > FAST * NOISY.fault.velocity
    assert record.fastest.max() > runaway_rate(NOISY)
    after = record.fastest[record.step_time >= onset]
    assert (np.diff(np.flatnonzero(after > FAST * NOISY.fault.velocity)) == 1).all(), "one burst"


@pytest.mark.slow
@pytest.mark.parametrize("rate", [50.0, 2000.0])
def test_onset_and_length_do_not_depend_on_the_rate_of_a_runaway(monkeypatch, rate):
    """Up to a noise of 1e-3 it decides when a run knows its event, not when that began."""
    noisy = NOISY.replaced(strength=1e-3)
    expected = extract(simulate(noisy))
    monkeypatch.setattr(event, "runaway_rate", lambda run: rate * run.fault.velocity)
    monkeypatch.setattr(extraction, "runaway_rate", event.runaway_rate)
    found = extract(simulate(noisy))
    assert found["onset_time"] == pytest.approx(expected["onset_time"], rel=1e-9)
    assert found["length"] == pytest.approx(expected["length"], rel=1e-9)
