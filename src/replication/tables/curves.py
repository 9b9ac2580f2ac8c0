"""The dataset of the linear theory: all curves of Figures 2, 3 and S1."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from nucleation.datasets.variables import Column, annotate, columns
from nucleation.fault import Fault
from nucleation.model.friction import Friction
from nucleation.run.run import Run
from nucleation.simulation import recorded
from nucleation.theory.closed_forms import (
    bimaterial_contrast,
    bimaterial_length_ratio,
    thin_limit_length,
)

from . import columns as col

if TYPE_CHECKING:
    import xarray as xr

CURVES = columns(
    col.HEIGHT,
    col.CRITICAL_LENGTH,
    col.CRITICAL_WAVENUMBER,
    Column("critical_frequency", "1/s", "angular frequency at the critical wavenumber", "omega"),
    Column("thin_limit_length", "m", "critical nucleation length for Hk -> 0", "L_c"),
    col.ZETA_OVER_A,
    col.F_BETA,
    Column(
        "bimaterial_length_ratio",
        "1",
        "critical length of a bimaterial interface over L_c^M",
        "L_c/L_c^M",
    ),
    recorded.SLIP_RATE,
    Column("steady_friction", "1", "steady-state friction, full law", "f"),
    Column("steady_friction_logarithmic", "1", "steady-state friction, logarithmic law", "f"),
    Column("friction_reference", "1", "friction coefficient at V", "f0"),
    col.A,
    col.ZETA,
    col.VELOCITY,
)


def logarithmic_friction(law: Friction, slip_rate: Any, state: Any, velocity: float) -> Any:
    """The conventional logarithmic law with a law's expansion at V (m/s) (Eq. S-log).

    It has the coefficients for slip rates (m/s) and states (s), which broadcast.
    """
    f0, a, zeta = law.expansion(velocity)
    age = np.asarray(state) * velocity / law.slip_distance
    speed = np.asarray(slip_rate) / velocity
    return f0 + a * np.log(speed) + (zeta + a) * np.log(age)


def main_text(fault: Fault) -> Fault:
    """A fault with f, a and zeta rounded to two digits and constant, as in the main text."""
    rounded = {name: float(f"{fault.single(name):.2g}") for name in ("friction", "a", "zeta")}
    kept = {"slip_distance": fault.slip_distance, "evolution": fault.evolution}
    return fault.replace(**rounded, **kept, friction_law=None)


def on_rigid_base(fault: Fault, height: Any) -> Fault:
    """Blocks of heights (m) with a fault's material and friction, free on top, on a rigid base."""
    return fault.replace(second_shear_modulus=math.inf, far_side="free", height=height)


def f_beta(run: Run) -> float:
    """Friction coefficient times bimaterial contrast; zero on a rigid base."""
    below = run.below
    if below is None:
        return 0.0
    return run.fault.friction * bimaterial_contrast(run.upper.material, below.material)


def theory_dataset(base: Run, curves: Mapping[str, Sequence[float]]) -> xr.Dataset:
    """All curves of the linear theory, :data:`CURVES`, for the fault of a run.

    `curves` has the section of the configuration. The curve of Figure 3, over heights (m), has the
    main text's rounded friction. Figure 2 has bimaterial half-spaces over those without contrast.
    Figure S1 has steady-state friction over slip rates (m/s), by the full law and expanded at V.
    """
    import xarray as xr

    coupling, zeta_over_a, slip_rate, height = (
        np.array(curves[name]) for name in ("f_beta", "zeta_over_a", "slip_rates", "heights")
    )
    law, velocity = base.law, base.fault.velocity
    state = law.slip_distance / slip_rate  # the expansion has no v0 (Eq. S-log)
    logarithmic = logarithmic_friction(law, slip_rate, state, velocity)
    expansion = law.expansion(velocity)
    ratio = bimaterial_length_ratio(coupling[None, :], zeta_over_a[:, None])
    fault = main_text(base.fault)
    modes = on_rigid_base(fault, height).critical_mode()
    found = xr.Dataset().assign(
        critical_length=("height", modes.length),
        critical_wavenumber=("height", modes.wavenumber),
        critical_frequency=("height", modes.angular_frequency),
        thin_limit_length=("height", thin_limit_length(height, fault)),
        bimaterial_length_ratio=(("zeta_over_a", "f_beta"), ratio),
        steady_friction=("slip_rate", law.steady_coefficient(slip_rate)),
        steady_friction_logarithmic=("slip_rate", logarithmic),
        friction_reference=expansion.f0,
        a=expansion.a,
        zeta=expansion.zeta,
        velocity=velocity,
    )
    found = found.assign_coords(height=height, zeta_over_a=zeta_over_a)
    return annotate(found.assign_coords(f_beta=coupling, slip_rate=slip_rate), CURVES)
