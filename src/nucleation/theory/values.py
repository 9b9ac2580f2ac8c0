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
from ..model.material import Material
from ..model.plausible import warn_of_implausible
from ..model.quantities import ParameterError, Quantity, declarations, refusal
from ..model.units import magnitude
from ..types import Array
from .transfer import Body

if TYPE_CHECKING:
    import xarray as xr

Values: TypeAlias = "ArrayLike | xr.DataArray"

FLOORS = {
    "shear_modulus": 1e-9,
    "second_shear_modulus": 1e-9,
    "normal_stress": 1e-6,
    "a": 1e-12,
    "slip_distance": 1e-15,
    "height": 1e-12,
    "second_height": 1e-12,
    "velocity": 1e-30,
}
"""Lower bounds (SI units) of the positive parameters: far below any known value, and computable."""


def _declared() -> dict[str, Quantity]:
    """Unit, range and meaning of each parameter, from its declaration in the model."""
    material = declarations(Material)
    interface = declarations(InterfaceState)
    body = declarations(Body)
    second_modulus = dataclasses.replace(
        material["shear_modulus"],
        closed="high",
        high=math.inf,
        description="shear modulus of the second body (inf: rigid)",
    )
    b = dataclasses.replace(
        interface["a"],
        symbol="b",
        description="coefficient b = a + zeta of the log of the state",
    )
    found = {
        "shear_modulus": material["shear_modulus"],
        "poisson_ratio": material["poisson_ratio"],
        "height": body["height"],
        "normal_stress": interface["normal_stress"],
        "a": interface["a"],
        "zeta": interface["zeta"],
        "friction": interface["friction"],
        "velocity": interface["velocity"],
        "b": b,
        "slip_distance": declarations(Friction)["slip_distance"],
        "second_shear_modulus": second_modulus,
        "second_poisson_ratio": material["poisson_ratio"],
        "second_height": body["height"],
        "far_side": body["far_side"],
        "second_far_side": body["far_side"],
        "plane": material["plane"],
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
