"""Small made-up datasets with the layout of the real ones, for drawing only."""

import json

import numpy as np
import pytest
import xarray as xr
from scipy.special import expit

from nucleation.model.friction import Friction
from nucleation.run.run import PAPER_RUN
from replication.tables.curves import logarithmic_friction

ONSET = 13.0  # s
PEAK = 2e-3  # s after the onset
VELOCITY = 1e-5  # m/s


def critical_length(height):
    """A plausible ``L_c(H)``: the thin limit at first, 0.9 m for a half-space."""
    return 1.0 / np.sqrt(1.0 / (11.5 * height) + 1.0 / 0.9**2)


@pytest.fixture(scope="session")
def theory() -> xr.Dataset:
    """Everything the theory's figures need."""
    height = np.linspace(0.0005, 0.105, 60)
    f_beta = np.linspace(0.0, 0.5, 41)
    ratio = xr.DataArray([0.1, 0.5, 1.0, 2.35, 10.0], dims="zeta_over_a")
    fb = xr.DataArray(f_beta, dims="f_beta")
    root = (fb * (1 + ratio) + np.sqrt((fb * (1 + ratio)) ** 2 + 4 * ratio)) / 2
    rate = np.geomspace(1e-9, 1.0, 200)
    friction = Friction(law="product")
    logarithmic = logarithmic_friction(friction, rate, friction.steady_state(rate), VELOCITY)
    return xr.Dataset(
        {
            "bimaterial_length_ratio": (1 - fb / root).transpose("zeta_over_a", "f_beta"),
            "critical_length": ("height", critical_length(height)),
            "thin_limit_length": ("height", np.sqrt(11.5 * height)),
            "steady_friction": ("slip_rate", friction.steady_coefficient(rate)),
            "steady_friction_logarithmic": ("slip_rate", logarithmic),
            "velocity": VELOCITY,
        },
        coords={"zeta_over_a": ratio.values, "f_beta": f_beta, "height": height, "slip_rate": rate},
    )


@pytest.fixture(scope="session")
def lengths() -> xr.Dataset:
    """Lengths of twelve runs of the paper, of one that failed, and of a finer study."""
    heights = [0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.075, 0.1, 0.01, 0.05, 0.1, 0.06, 0.01, 0.1]
    law = np.array(["aging"] * 14)
    law[8:10] = "slip"
    initial_state = np.ones(14)
    initial_state[10] = 1e3
    study = ["paper"] * 12 + ["converged"] * 2
    height = np.array(heights)
    factor = np.array([0.70] * 8 + [0.66, 0.67, 0.73, np.nan] + [0.83] * 2)
    length = factor * critical_length(height)
    columns = {
        "id": [f"{s}-{k}" for k, s in enumerate(study)],
        "study": study,
        "role": study,
        "evolution": law,
        "initial_state": initial_state,
        "height": height,
        "ensemble": [f"{i}" for i in range(14)],
        "strength": [0.0] * 12 + [1e-5] * 2,
        "onset_time": np.full(14, ONSET),
        "critical_length": critical_length(height),
        "length": length,
        "length_low": 0.95 * length,
        "length_high": 1.08 * length,
    }
    return xr.Dataset({name: ("run", np.asarray(values)) for name, values in columns.items()})


def make_simulation(height: float, length: float) -> xr.Dataset:
    """A creep patch that grows as the root of time, then an event that crosses the block."""
    x = np.linspace(0.0, 6.0 * critical_length(height), 161)
    creep = np.linspace(0.0, ONSET, 110)
    event = ONSET + np.linspace(2e-5, 4e-3, 150)
    time = np.concatenate([creep, event, np.linspace(ONSET + 0.01, 16.0, 50)])
    t = time[:, None]
    since = np.clip(t - ONSET, 0.0, None)
    burst = np.exp(-(((since - PEAK) / (0.35 * PEAK)) ** 2)) * (since > 0.0)
    crossed = np.clip((since - 0.5 * PEAK) / PEAK, 0.0, 1.0)
    front = length * np.sqrt(np.clip(t / ONSET, 1e-6, 1.0)) + 0.8 * x[-1] * crossed
    inside = expit((front - x) / (0.012 * length))
    rate = 1e-13 + inside * (VELOCITY + 0.08 * burst * np.exp((x - front) / (0.3 * length)))
    tau = inside * 0.40 + 0.16 * np.exp(-(((x - front) / (0.05 * length)) ** 2)) - 0.1 * burst
    slip = np.concatenate([0.0 * x[None], np.cumsum(rate[1:] * np.diff(time)[:, None], axis=0)])
    step_time = np.concatenate([time, 0.5 * (time[1:] + time[:-1])])
    step_time.sort()
    drop = np.clip((step_time - ONSET - 0.5 * PEAK) / PEAK, 0.0, 1.0)
    force = -0.5e6 * height - 4e5 * length * (np.sqrt(step_time / ONSET) - 0.6 * drop)
    parameters = PAPER_RUN.replaced(height=height, block_length=float(x[-1]))
    return xr.Dataset(
        {
            "slip_rate": (("time", "x"), rate),
            "slip": (("time", "x"), slip),
            "shear_stress": (("time", "x"), 1e6 * tau),
            "driving_force": ("step", force),
            "maximal_slip_rate": ("step", np.interp(step_time, time, rate.max(axis=1))),
            "step_time": ("step", step_time),
        },
        coords={"time": time, "x": x},
        attrs={"parameters": json.dumps(parameters.to_dict())},
    )


@pytest.fixture(scope="session")
def thin_row(lengths):
    return lengths.isel(run=0)


@pytest.fixture(scope="session")
def thick_row(lengths):
    return lengths.isel(run=7)


@pytest.fixture(scope="session")
def thin(thin_row):
    """A record for Fig. S2."""
    return make_simulation(0.005, float(thin_row["length"]))


@pytest.fixture(scope="session")
def thick(thick_row):
    """A record for the inset of Fig. 3."""
    return make_simulation(0.1, float(thick_row["length"]))
