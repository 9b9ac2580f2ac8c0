"""The dataset of the linear theory: all curves of Figures 2, 3 and S1."""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from nucleation.datasets.variables import Variable, annotate, some
from nucleation.fault import Fault
from nucleation.model.friction import Friction
from nucleation.run.run import Run
from nucleation.theory.closed_forms import bimaterial_length_ratio, thin_limit_length
from nucleation.types import Array

from .main_text import main_text, on_rigid_base
from .rows import SHARED

CURVES = {
    "height": SHARED["height"],
    "critical_length": Variable("m", "critical nucleation length", "L_c"),
    "critical_wavenumber": Variable("1/m", "critical wavenumber", "k_c"),
    "critical_frequency": Variable("1/s", "angular frequency at the critical wavenumber", "omega"),
    "thin_limit_length": Variable("m", "critical nucleation length for Hk -> 0", "L_c"),
    **some(SHARED, "zeta_over_a f_beta"),
    "bimaterial_length_ratio": Variable(
        "1", "critical length of a bimaterial interface over L_c^M", "L_c/L_c^M"
    ),
    "slip_rate": Variable("m/s", "slip rate", "v"),
    "steady_friction": Variable("1", "steady-state friction, full law", "f"),
    "steady_friction_logarithmic": Variable("1", "steady-state friction, logarithmic law", "f"),
    "friction_reference": Variable("1", "friction coefficient at V", "f0"),
    **some(SHARED, "a zeta velocity"),
}


def theory_dataset(
    base: Run,
    curves: Mapping[str, Sequence[float]],
) -> xr.Dataset:
    """All curves of the linear theory, :data:`CURVES`, for the fault of a run.

    `curves` has the section of the configuration. The curve of Figure 3, over heights (m), has the
    main text's rounded friction; that of Figure S1, over slip rates (m/s), the full law.
    """
    heights, f_beta, zeta_over_a, slip_rates = (
        np.array(curves[name]) for name in ("heights", "f_beta", "zeta_over_a", "slip_rates")
    )
    parts = (
        length_curve(main_text(base.fault), heights),
        _bimaterial_curves(f_beta, zeta_over_a),
        _friction_curves(base.law, base.fault.velocity, slip_rates),
    )
    return annotate(xr.merge(parts), CURVES)


def length_curve(fault: Fault, height: Array) -> xr.Dataset:
    """L_c, wavenumber and frequency of blocks on a rigid base over their height (m) (Figure 3)."""
    modes = on_rigid_base(fault, height).critical_mode()
    values = {
        "critical_length": modes.length,
        "critical_wavenumber": modes.wavenumber,
        "critical_frequency": modes.angular_frequency,
        "thin_limit_length": thin_limit_length(height, fault),
    }
    on_height = {name: ("height", column) for name, column in values.items()}
    return xr.Dataset(on_height, {"height": height})


def _bimaterial_curves(
    f_beta: Array,
    zeta_over_a: Array,
) -> xr.Dataset:
    """Critical length of bimaterial half-spaces over that without contrast (Figure 2)."""
    ratio = bimaterial_length_ratio(f_beta[None, :], zeta_over_a[:, None])
    return xr.Dataset(
        {"bimaterial_length_ratio": (("zeta_over_a", "f_beta"), ratio)},
        {"zeta_over_a": zeta_over_a, "f_beta": f_beta},
    )


def _friction_curves(
    friction: Friction,
    velocity: float,
    slip_rate: Array,
) -> xr.Dataset:
    """Steady-state friction, full law and logarithmic expansion about `velocity` (Figure S1)."""
    state = friction.slip_distance / slip_rate  # the expansion has no v0 (Eq. S-log)
    expansion = friction.expansion(velocity)
    logarithmic = friction.logarithmic(slip_rate, state, velocity)
    return xr.Dataset(
        {
            "steady_friction": ("slip_rate", friction.steady_coefficient(slip_rate)),
            "steady_friction_logarithmic": ("slip_rate", logarithmic),
            "friction_reference": expansion.f0,
            "a": expansion.a,
            "zeta": expansion.zeta,
            "velocity": velocity,
        },
        {"slip_rate": slip_rate},
    )
