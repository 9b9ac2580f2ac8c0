"""What a status adds: fronts that the mesh can't resolve, drops of patches of a few elements."""

import numpy as np
import pytest
import square_evolution

from nucleation.extraction.definitions import find_onset
from nucleation.extraction.extraction import Record
from nucleation.model.friction import Friction
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.event import FEW, front_width, long_after
from nucleation.simulation.run import simulate

COARSE = PAPER_RUN.replaced(
    height=0.02, block_length=1.84, n_x=60, n_y=6, end_time=30.0, time_after_event=0.0,
    tolerance=5e-2, longest_step=0.2
)  # fmt: skip
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


def test_no_front_has_no_width():
    assert front_width(COARSE, X, np.full(X.size, 0.05)) == np.inf
    assert front_width(COARSE, X, np.where(X < 1.2, 0.05, 100.0)) == np.inf, (
        "not where it is sought"
    )


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


@pytest.mark.parametrize(("fall", "width"), [(0.9, np.inf), (1.1, 1.0)])
def test_a_front_changes_the_logarithm_of_the_state_by_one(fall, width):
    state = np.where(X < 0.3, 0.05, 0.05 * np.exp(fall))
    assert front_width(COARSE, X, state) == pytest.approx(width)


@pytest.fixture
def square(monkeypatch):
    """The state evolves by a law that is not the project's."""
    monkeypatch.setattr(Friction, "evolution_law", square_evolution)


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
    first = find_onset(record.step_time, force, COARSE.memory_time, 0.02, record._fast)
    at_first = record.lengths[record.frames_at(record.step_time[[first.start]])[0]]
    assert at_first < (FEW + 1) * X[1] < record.lengths_at_drop[0, 0]
