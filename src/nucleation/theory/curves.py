"""The dataset of the linear theory: all curves of Figures 2, 3 and S1."""

import numpy as np
import xarray as xr

from ..datasets.shared import SHARED
from ..datasets.variables import Variable, annotate, some
from ..model.friction.law import Friction
from ..model.linearised import InterfaceState
from ..model.material import Material
from ..types import Array
from .closed_forms import bimaterial_length_ratio, thin_limit_length
from .critical import modes_on_rigid_base
from .settings import Curves

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
    material: Material,
    friction: Friction,
    interface: InterfaceState,
    curves: Curves,
) -> xr.Dataset:
    """All curves of the linear theory.

    Parameters
    ----------
    material : Material
        Of the block.
    friction : Friction
        The full law with the parameters of Table S1.
    interface : InterfaceState
        The main text's rounded friction, used for the curve of Figure 3; the full law is expanded
        at its velocity.
    curves : Curves
        Where to compute.

    Returns
    -------
    Dataset
        The variables :data:`CURVES`.
    """
    parts = (
        length_curve(material, interface, np.array(curves.heights)),
        _bimaterial_curves(np.array(curves.f_beta), np.array(curves.zeta_over_a)),
        _friction_curves(friction, interface.velocity, np.array(curves.slip_rates)),
    )
    return annotate(xr.merge(parts), CURVES)


def length_curve(
    material: Material,
    interface: InterfaceState,
    height: Array,
) -> xr.Dataset:
    """Critical length, wavenumber and frequency against the height (Figure 3).

    Parameters
    ----------
    material : Material
        Of the block.
    interface : InterfaceState
        Friction linearised about steady sliding.
    height : ndarray
        Heights (m) of the block.

    Returns
    -------
    Dataset
        On the dimension ``height``.
    """
    modes = modes_on_rigid_base(height, material, interface)
    values = {
        "critical_length": modes.length,
        "critical_wavenumber": modes.wavenumber,
        "critical_frequency": modes.angular_frequency,
        "thin_limit_length": thin_limit_length(height, material, interface),
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
