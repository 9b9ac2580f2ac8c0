"""The values that the parameters of a fault may have: declarations, checks, arrays of any kind."""

from __future__ import annotations

import dataclasses
import math
import sys
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..model.friction.law import Friction
from ..model.linearised import InterfaceState
from ..model.loading import Loading
from ..model.material import Material
from ..model.plausible import warn_of_implausible
from ..model.quantities import ParameterError, Quantity, declarations, declared, refusal
from ..model.units import magnitude
from ..types import Array
from .stiffness import FAR_SIDES

if TYPE_CHECKING:
    import xarray as xr

Values: TypeAlias = "ArrayLike | xr.DataArray"
"""Parameters as they are given."""

Numbers: TypeAlias = "Array | xr.DataArray"
"""Parameters after their check, and what is computed of them."""

Conditions: TypeAlias = "bool | NDArray[np.bool_] | xr.DataArray"
"""Where something holds of such parameters."""

FLOORS = {
    "shear_modulus": 1e-9,
    "second_shear_modulus": 1e-9,
    "normal_stress": 1e-6,
    "a": 1e-12,
    "slip_distance": 1e-15,
    "height": 1e-12,
    "second_height": 1e-12,
    "zone_thickness": 1e-12,
    "zone_shear_modulus": 1e-9,
    "velocity": 1e-30,
}
"""Lower bounds (SI units) of the positive parameters: far below any known value, and computable."""


def _declared() -> dict[str, Quantity]:
    """Unit, range and meaning of each parameter, from its declaration in the model."""
    material = declarations(Material)
    interface = declarations(InterfaceState)
    height = declared("height of the body (inf: half-space)", "(0.0, inf] m", symbol="H")
    far_side = Quantity(
        "condition on the side away from the interface: velocity (u_x and sigma_yy imposed), "
        "traction or free (sigma_xy and sigma_yy imposed), clamped (u_x and u_y imposed) or "
        "roller (u_y and sigma_xy imposed)",
        choices=tuple(FAR_SIDES),
    )
    second_modulus = dataclasses.replace(
        material["shear_modulus"],
        closed="high",
        high=math.inf,
        description="shear modulus of the second body (inf: rigid)",
    )
    zone_thickness = dataclasses.replace(
        height,
        symbol="h",
        description="thickness of a zone of other stiffness on each side of the fault",
    )
    zone_modulus = dataclasses.replace(
        material["shear_modulus"],
        symbol="mu_z",
        description="shear modulus of the zone beside the fault",
    )
    zone_ratio = dataclasses.replace(
        material["poisson_ratio"],
        symbol="nu_z",
        description="Poisson's ratio of the zone beside the fault",
    )
    b = dataclasses.replace(
        interface["a"],
        symbol="b",
        description="coefficient b = a + zeta of the log of the state",
    )
    found = {
        "shear_modulus": material["shear_modulus"],
        "poisson_ratio": material["poisson_ratio"],
        "height": height,
        "normal_stress": interface["normal_stress"],
        "a": interface["a"],
        "zeta": interface["zeta"],
        "friction": interface["friction"],
        "velocity": interface["velocity"],
        "b": b,
        "slip_distance": declarations(Friction)["slip_distance"],
        "second_shear_modulus": second_modulus,
        "second_poisson_ratio": material["poisson_ratio"],
        "second_height": height,
        "far_side": far_side,
        "second_far_side": far_side,
        "zone_thickness": zone_thickness,
        "zone_shear_modulus": zone_modulus,
        "zone_poisson_ratio": zone_ratio,
        "plane": material["plane"],
        "loading": dataclasses.replace(
            declarations(Loading)["kind"],
            description="start of the creeping patch: an edge that is pushed, a free side under a "
            "top that moves, or the interior under a remote load",
        ),
        "evolution": declarations(Friction)["evolution"],
    }
    return {name: _bounded(name, entry) for name, entry in found.items()}


def _bounded(
    name: str,
    entry: Quantity,
) -> Quantity:
    """The declaration with a range that begins at the parameter's floor, if it has one."""
    if name not in FLOORS:
        return entry
    closed = "both" if entry.closed in ("high", "both") else "low"
    return dataclasses.replace(entry, low=FLOORS[name], closed=closed)


QUANTITIES = _declared()
"""Declaration (unit, range, meaning) of every parameter of a fault, by name."""

ZONE = ("zone_thickness", "zone_shear_modulus", "zone_poisson_ratio")
"""Parameters of a zone beside the fault."""

OF_THEORY = ("far_side", *ZONE)
"""Parameters that no simulation has: its loading sets the first far side, and it has no zone."""


def labelled(value: Any) -> bool:
    """Whether it is a DataArray; this does not load xarray."""
    return "xarray" in sys.modules and isinstance(value, sys.modules["xarray"].DataArray)


def where(
    condition: Any,
    first: Any,
    second: Any,
) -> Any:
    """``xr.where`` if there is a DataArray, else NumPy's.

    Parameters
    ----------
    condition : array_like or DataArray
        Where to take the first.
    first, second : array_like or DataArray
        Values, which broadcast with the condition.

    Returns
    -------
    ndarray or DataArray
        Broadcast shape.
    """
    if any(labelled(value) for value in (condition, first, second)):
        return sys.modules["xarray"].where(condition, first, second)
    return np.where(condition, first, second)[()]


def checked(
    name: str,
    value: Any,
    entry: Quantity,
) -> Array | xr.DataArray:
    """The value in SI units as an array of floats, all in the declared range.

    Parameters
    ----------
    name : str
        Name of the parameter, for messages.
    value : array_like, DataArray, pint quantity or str
        Its value, with or without a unit.
    entry : Quantity
        Its declaration.

    Returns
    -------
    ndarray or DataArray
        Same shape.

    Raises
    ------
    ParameterError
        If it is no array of numbers, or one of them is out of range.
    """
    value = magnitude(name, value, entry)
    try:
        array = value if labelled(value) else np.asarray(value)
    except (TypeError, ValueError):  # lists of unlike lengths, datasets
        kind = type(value).__name__
        raise ParameterError(
            f"{name} is not allowed: {entry.description} must be a number, an array of numbers or "
            f"a DataArray, and not this {kind}"
        ) from None
    if array.dtype.kind not in "iuf":
        raise ParameterError(refusal(name, value, entry))
    array = array.astype(float)
    flat = np.asarray(array).ravel()
    bad = np.flatnonzero(~inside(flat, entry))
    if bad.size:
        position = np.unravel_index(bad[0], array.shape)
        at = ", ".join(str(i) for i in position)
        entry_name = f"{name}[{at}]" if at else name
        raise ParameterError(refusal(entry_name, float(flat[bad[0]]), entry))
    warn_of_implausible(name, flat, entry)
    return array


def inside(
    values: Array,
    entry: Quantity,
) -> NDArray:
    """Whether each value is in the declared range.

    Parameters
    ----------
    values : ndarray
        In the declared unit.
    entry : Quantity
        The declaration.

    Returns
    -------
    ndarray
        Of bool, same shape.
    """
    low = values >= entry.low if entry.closed in ("low", "both") else values > entry.low
    high = values <= entry.high if entry.closed in ("high", "both") else values < entry.high
    return low & high
