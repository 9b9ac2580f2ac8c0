"""Made-up records of runs whose hops, onset and length are known, without any simulation."""

import numpy as np
import xarray as xr

from nucleation.run.run import PAPER_RUN

ONSET = 10.0  # s
PARAMETERS = PAPER_RUN.replaced(height=0.02, block_length=2.0, n_x=200, n_y=4)


def record(period=0.1, parameters=PARAMETERS, onset=ONSET):
    """A front that reaches node i at ``i * period`` (s), and a force that falls by 20 % at once."""
    x = np.linspace(0.0, parameters.block.length, parameters.block.n_x + 1)
    time = np.append(np.arange(0.0, onset, 0.01), onset + np.array([0.0, 1e-3, 2e-3]))
    velocity = parameters.fault.velocity
    slips = time[:, None] >= np.arange(x.size) * period - 1e-9
    rate = np.where(slips, velocity, 1e-6 * velocity)
    rate[-2:] *= 800.0  # v_d is 705 V
    force = -1e4 * np.minimum(1.0 + 0.1 * time / onset, 1.1)
    force[-2:] *= [0.99, 0.8]
    return xr.Dataset(
        {
            "slip_rate": (("time", "x"), rate),
            "driving_force": ("step", force),
            "step_time": ("step", time),
            "maximal_slip_rate": ("step", rate.max(axis=1)),
        },
        coords={"time": time, "x": x},
        attrs={"parameters": parameters.to_json(), "status": "completed: made up"},
    )


def changed(**values):
    """The usual parameters with other values."""
    return PARAMETERS.replaced(**values)


def run(identifier, parameters=PARAMETERS, critical_length=0.5):
    """A run as rules give it."""
    return {
        "id": identifier,
        "parameters": parameters.to_dict(),
        "critical_length": critical_length,
        "theory": {name: getattr(parameters.fault, name) for name in ("friction", "a", "zeta")},
    }
