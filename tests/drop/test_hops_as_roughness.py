"""Hops over nodes are as a strength that is uneven with the period of the nodes: docs/drop.md."""

import numpy as np
import pytest
from scipy.signal import savgol_filter

from nucleation.extraction.extraction import Record, extract
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.recording import Recorder
from nucleation.simulation.run import instants
from nucleation.simulation.start import composed
from nucleation.simulation.step import Dynamics

pytestmark = pytest.mark.slow

THEORY = 0.4509  # m
COARSE = 200  # elements, on each of which a fine mesh has three
UNEVEN = 0.58  # relative strength of the period, that makes the patch swing as the hops do
MESH = {"n_x": COARSE, "n_y": 6, "grading": 20.0}
FAULT = PAPER_RUN.replaced(
    height=0.02, block_length=1.35, end_time=30.0, time_after_event=0.0, **MESH
)


def recorded(parameters, uneven=0.0):
    """A run up to its drop on a fault whose strength has the period of the coarse mesh."""
    usual = composed(parameters)
    wave = np.cos(2.0 * np.pi * COARSE * usual.grid.x / parameters.block.length)
    steady, factor = usual.drive, 1.0 + uneven * wave
    drive = steady._replace(at=lambda time: steady.at(time)._replace(strength=factor))
    dynamics = Dynamics(usual.body, usual.interface, drive, usual.scheme)
    recorder = Recorder(parameters, dynamics)
    for instant in instants(parameters, dynamics=dynamics):
        recorder.record(instant.state, instant.report)
        if recorder.covers_event:
            break
    return recorder.dataset()


def swing(simulation):
    """Amplitude over V of the slip rate's oscillation inside the patch, before it is unstable."""
    record = Record(simulation)
    time, length = record.time[record.creep], record.lengths[record.creep]
    inside = int(np.argmin(np.abs(record.x - 0.1)))
    rate = simulation["slip_rate"].values[record.creep, inside] / record.velocity
    even = np.arange(time[0], time[-1], 0.01)
    sampled = np.interp(even, time, rate)
    off_trend = sampled - savgol_filter(sampled, 101, 3)  # over 1 s
    stable = (np.interp(even, time, length) / THEORY > 0.46) & (even < time[-1])
    stable &= np.interp(even, time, length) / THEORY < 0.52
    return float(np.sqrt(2.0 * np.mean(off_trend[stable] ** 2)))


def test_a_fine_mesh_with_the_coarse_one_s_period_drops_where_that_drops():
    fine = FAULT.replaced(n_x=3 * COARSE)
    hopping, uneven, even = recorded(FAULT), recorded(fine, UNEVEN), recorded(fine)
    assert swing(uneven) == pytest.approx(swing(hopping), rel=0.5)
    assert swing(even) < 0.05 * swing(hopping)
    drops = [extract(run) for run in (hopping, uneven, even)]
    assert drops[1]["onset_time"] == pytest.approx(drops[0]["onset_time"], rel=0.03)
    assert drops[1]["length"] == pytest.approx(drops[0]["length"], rel=0.04)
    assert drops[2]["onset_time"] > 1.1 * drops[0]["onset_time"]
