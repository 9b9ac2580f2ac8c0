"""A force that falls at a known time, and a patch that grows by a known law."""

import numpy as np
import xarray as xr

from nucleation.run.run import PAPER_RUN

VELOCITY = 1e-5


def force_record(onset=10.0, fall=0.004, size=0.05, end=12.0):
    """|f_d| rising as a square root, then falling by `size` within `fall` seconds."""
    times = [np.arange(0.0, onset, 0.01), onset + np.linspace(0.0, 2 * fall, 81)]
    time = np.concatenate((*times, np.arange(onset + 3 * fall, end, 0.01)))
    force = 1e4 * np.sqrt(time + 0.1)
    force *= 1 - size * np.clip((time - onset) / fall, 0.0, 1.0)
    return time, force


def synthetic_simulation(onset=10.0, decay=0.05, **drop):
    """A patch that grows as 0.05 sqrt(t), its slip rate decaying exponentially ahead.

    `drop` is how the force falls, see :func:`force_record`.
    """
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
