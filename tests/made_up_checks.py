"""Made-up results of the checks of the solver, with the layout of the real ones."""

import numpy as np
import xarray as xr

from replication.verification.orders import ERRORS, PROBLEMS, REFINEMENTS

LEVELS = 2.0 ** -np.arange(4)


def convergence():
    """Errors that fall with the orders of the scheme."""
    order = np.array([2, 2, 3])[None, :, None]
    factor = 1e-3 * np.arange(1, 4)[:, None, None]
    data = {
        name: (("problem", "refinement", "level"), (i + 1) * factor * LEVELS**order)
        for i, name in enumerate(ERRORS)
    }
    spacings = {"element_size": 0.125, "step_size": 5.7e-6, "quasi_static_step_size": 2.3e-2}
    dataset = xr.Dataset(
        {**data, **{name: ("level", size * LEVELS) for name, size in spacings.items()}},
        {"problem": list(PROBLEMS), "refinement": list(REFINEMENTS)},
    )
    lacking = {"problem": "elastodynamics", "refinement": "quasi_static_step"}
    for name in ERRORS:
        dataset[name].loc[lacking] = np.nan
    return dataset


def dispersion():
    """Two heights with branches that fall steeply beyond the last mode."""
    height, modes, curve = (
        np.array([0.01, 0.1]),
        np.linspace(0.5, 2.0, 7),
        np.linspace(0.4, 2.1, 80),
    )

    def rates(k):
        growth = np.stack([1 - k**3, 0.8 - 0.7 * k], axis=-1)
        frequency = np.stack([k, -0.9 * k], axis=-1)
        return np.stack([growth, 0.5 * growth]), np.stack([frequency, 0.8 * frequency])

    at, along = ("height", "mode", "branch"), ("height", "curve", "branch")
    data = {
        "mode_wavenumber": (("height", "mode"), np.stack([20 * modes, 10 * modes])),
        "curve_wavenumber": (("height", "curve"), np.stack([20 * curve, 10 * curve])),
        "critical_wavenumber": ("height", [20.0, 10.0]),
        "memory_time": 1.0,
    }
    for kind, dims, k in (("measured", at, modes), ("curve", along, curve)):
        for part, values in zip(("growth", "frequency"), rates(k), strict=True):
            data[f"{kind}_{part}"] = (dims, values)
    for part in ("growth", "frequency"):
        data[f"theory_{part}"] = data[f"measured_{part}"]
    return xr.Dataset(data, {"height": height})
