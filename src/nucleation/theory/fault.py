"""One or many faults: two elastic bodies and linearised friction, as arrays that broadcast.

The array form of the linear theory's input. Every parameter may be a number, an array or an
:class:`xarray.DataArray`; they broadcast together as NumPy's or, by name, as xarray's do.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ..model.friction.law import Friction
from ..model.linearised import InterfaceState
from ..model.material import Material
from ..model.quantities import ParameterError, Quantity, declarations, refusal
from .transfer import RIGID, Body, RigidBody

Array = NDArray[np.float64]
Values = ArrayLike | xr.DataArray


def _declared() -> dict[str, Quantity]:
    """Unit, range and meaning of each parameter, from where it is declared."""
    material, interface, body = (declarations(cls) for cls in (Material, InterfaceState, Body))
    second = dataclasses.replace(
        material["shear_modulus"], closed="high", high=math.inf,
        description="shear modulus of the second body (inf: rigid)",
    )  # fmt: skip
    b = dataclasses.replace(
        interface["a"], symbol="b", description="coefficient b = a + zeta of the log of the state"
    )
    distance = declarations(Friction)["characteristic_slip_distance"]
    names = ("normal_stress", "a", "zeta", "friction", "velocity")
    return {
        "shear_modulus": material["shear_modulus"],
        "poisson_ratio": material["poisson_ratio"],
        "height": body["height"],
        **{name: interface[name] for name in names},
        "b": b,
        "slip_distance": distance,
        "second_shear_modulus": second,
        "second_poisson_ratio": material["poisson_ratio"],
        "second_height": body["height"],
        "far_side": body["far_side"],
    }


QUANTITIES = _declared()
"""Declaration (unit, range, meaning) of every parameter of :class:`Fault`, by name."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Fault:
    """Two bodies in frictional contact that slide steadily; scalars, arrays or DataArrays.

    Parameters
    ----------
    shear_modulus : array_like
        mu (Pa) of the first body.
    poisson_ratio : array_like
        nu of the first body.
    normal_stress : array_like
        sigma0 (Pa), compressive positive.
    a : array_like
        Direct effect, ``a = v df/dv`` at fixed state; **natural** logarithm (a value per decade
        is to be divided by ``ln 10 = 2.303``).
    zeta : array_like, optional
        Velocity weakening ``zeta = b - a = -df_ss/dlog v``; either this or `b` is given.
    b : array_like, optional
        Coefficient of the logarithm of the state, ``b = a + zeta``.
    slip_distance : array_like
        Characteristic slip distance D (m); ``ell = D`` for the aging and the slip law.
    friction : array_like, optional
        Friction coefficient f of steady sliding; needed where the bodies differ, since slip then
        changes the normal stress.
    velocity : array_like, optional
        Sliding velocity V (m/s); rates and frequencies need it, lengths do not.
    height : array_like
        Height (m) of the first body; inf, the default, makes it a half-space.
    second_shear_modulus : array_like, optional
        mu (Pa) of the second body; that of the first one by default, inf for a rigid body.
    second_poisson_ratio, second_height : array_like, optional
        The same for nu and the height (m).
    far_side : {"traction", "velocity"}
        What is imposed on the bodies' sides away from the interface: both stresses (Eq. 10), or
        u_x and sigma_yy.

    Raises
    ------
    ParameterError
        If a parameter is outside its range, missing or given twice.
    """

    shear_modulus: Values
    poisson_ratio: Values
    normal_stress: Values
    a: Values
    zeta: Values | None = None
    b: Values | None = None
    slip_distance: Values
    friction: Values | None = None
    velocity: Values | None = None
    height: Values = math.inf
    second_shear_modulus: Values | None = None
    second_poisson_ratio: Values | None = None
    second_height: Values | None = None
    far_side: str = "traction"

    def __post_init__(self) -> None:
        if (self.zeta is None) == (self.b is None):
            raise ParameterError("zeta or b = a + zeta is needed, one of them and not both")
        for name in self._given():
            object.__setattr__(self, name, checked(name, getattr(self, name), QUANTITIES[name]))
        if self.far_side not in QUANTITIES["far_side"].choices:
            raise ParameterError(refusal("far_side", self.far_side, QUANTITIES["far_side"]))
        if self.zeta is None:
            object.__setattr__(self, "zeta", self.b - self.a)
        else:
            object.__setattr__(self, "b", self.a + self.zeta)
        for name in ("shear_modulus", "poisson_ratio", "height"):
            if getattr(self, f"second_{name}") is None:
                object.__setattr__(self, f"second_{name}", getattr(self, name))
        arrays = [getattr(self, name) for name in self._given()]
        named = any(isinstance(x, xr.DataArray) for x in arrays)
        if named and any(x.ndim and not isinstance(x, xr.DataArray) for x in arrays):
            raise ParameterError("arrays with and without named dimensions can't be combined")
        if self.friction is None and np.any(self.bodies_differ):
            raise ParameterError(
                "friction is missing: where the bodies differ, slip changes the normal stress, "
                "and the friction coefficient matters"
            )

    def _given(self) -> list[str]:
        names = (field.name for field in dataclasses.fields(self))
        return [n for n in names if n != "far_side" and getattr(self, n) is not None]

    @property
    def bodies_differ(self) -> Any:
        """Whether the second body is no mirror image of the first one (bool array)."""
        return (
            (self.second_shear_modulus != self.shear_modulus)
            | (self.second_poisson_ratio != self.poisson_ratio)
            | (self.second_height != self.height)
        )

    @property
    def second_rigid(self) -> Any:
        """Whether the second body is rigid (bool array)."""
        return np.isinf(self.second_shear_modulus)

    def evaluate(
        self, function: Callable[..., Any], *arrays: Values, rows: int = 1, dtype: type = float
    ) -> Any:
        """Values of a function of one fault at every point of the broadcast parameters.

        Parameters
        ----------
        function : callable
            Takes the upper body, the lower body, the interface, and one-dimensional arrays of
            the points of that fault; returns `rows` arrays of the same length.
        arrays : array_like
            Further arguments, which broadcast with the parameters.
        rows : int
            Number of values at each point.
        dtype : type
            Of the values.

        Returns
        -------
        ndarray or DataArray
            Shape ``(rows,) + broadcast shape``; the first dimension is called ``row``.
        """
        names = (
            "shear_modulus", "poisson_ratio", "height", "friction", "a", "zeta", "slip_distance",
            "velocity", "normal_stress", "second_shear_modulus", "second_poisson_ratio",
            "second_height",
        )  # fmt: skip
        neutral = {"friction": 0.0, "velocity": 1.0}  # where not given they do not matter
        values = [getattr(self, n) for n in names]
        values = [neutral[n] if v is None else v for n, v in zip(names, values, strict=True)]

        def core(*inputs: Array) -> NDArray:
            shape = np.broadcast_shapes(*(np.shape(x) for x in inputs))
            flat = [np.broadcast_to(x, shape).ravel() for x in inputs]
            parameters = np.stack(flat[: len(names)], axis=1)
            points, group = np.unique(parameters, axis=0, return_inverse=True)
            found = np.empty((parameters.shape[0], rows), dtype=dtype)  # type: ignore[var-annotated]
            order = np.argsort(group.ravel(), kind="stable")
            ends = np.cumsum(np.bincount(group.ravel(), minlength=len(points)))
            for point, chosen in zip(points, np.split(order, ends[:-1]), strict=True):
                one = dict(zip(names, map(float, point), strict=True))
                rest = (x[chosen] for x in flat[len(names) :])
                found[chosen] = np.transpose(function(*_one_fault(one, self.far_side), *rest))
            return found.reshape(*shape, rows)

        result = xr.apply_ufunc(core, *values, *arrays, output_core_dims=[["row"]])
        if isinstance(result, xr.DataArray):
            return result.transpose("row", ...)
        return np.moveaxis(result, -1, 0)


def _one_fault(p: dict[str, float], far_side: str) -> tuple[Body, Body | RigidBody, InterfaceState]:
    """Bodies and interface of one point."""
    upper = Body(Material(p["shear_modulus"], p["poisson_ratio"]), p["height"], far_side)
    lower: Body | RigidBody = RIGID
    if math.isfinite(p["second_shear_modulus"]):
        rock = Material(p["second_shear_modulus"], p["second_poisson_ratio"])
        lower = Body(rock, p["second_height"], far_side)
    interface = InterfaceState(
        p["friction"], p["a"], p["zeta"], p["slip_distance"], p["velocity"], p["normal_stress"]
    )
    return upper, lower, interface


def checked(name: str, value: Any, entry: Quantity) -> Array | xr.DataArray:
    """The value as an array of floats, every element of which lies in the declared range."""

    array = value if isinstance(value, xr.DataArray) else np.asarray(value)
    if array.dtype.kind not in "iuf":
        raise ParameterError(refusal(name, value, entry))
    array = array.astype(float)
    flat = np.asarray(array).ravel()
    low = flat >= entry.low if entry.closed in ("low", "both") else flat > entry.low
    high = flat <= entry.high if entry.closed in ("high", "both") else flat < entry.high
    bad = np.flatnonzero(~(low & high))
    if bad.size:
        at = ", ".join(map(str, np.unravel_index(bad[0], array.shape)))
        raise ParameterError(refusal(f"{name}[{at}]" if at else name, float(flat[bad[0]]), entry))
    return array
