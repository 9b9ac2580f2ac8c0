"""One or many faults: two elastic bodies and linearised friction, as arrays that broadcast.

The array form of the linear theory's input. Every parameter may be a number, an array, a pint
quantity, an :class:`xarray.DataArray` or a text with a unit such as "0.5um"; they broadcast
together as NumPy's or, by name, as xarray's do. What carries a unit is converted to SI units.
"""

from __future__ import annotations

import dataclasses
import inspect
import math
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..model.friction.law import Friction
from ..model.linearised import InterfaceState
from ..model.material import ANTIPLANE, Material, in_plane_ratio
from ..model.plausible import warn_of_implausible
from ..model.quantities import ParameterError, Quantity, declarations, refusal
from ..model.units import is_quantity, magnitude
from .spectrum import Systems
from .stiffness import FAR_SIDES, Array, Layers, Pair, require_far_side
from .transfer import Body

if TYPE_CHECKING:
    import xarray as xr

Values: TypeAlias = "ArrayLike | xr.DataArray"
F = TypeVar("F", bound=Callable[..., Any])


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
    found = {
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
        "second_far_side": body["far_side"],
        "plane": material["plane"],
    }
    return {name: _above(FLOORS.get(name, 0.0), entry) for name, entry in found.items()}


FLOORS = {
    "shear_modulus": 1e-9, "second_shear_modulus": 1e-9, "normal_stress": 1e-6, "a": 1e-12,
    "slip_distance": 1e-15, "height": 1e-12, "second_height": 1e-12, "velocity": 1e-30,
}  # fmt: skip
"""The least values (SI units) of what is positive: far below any known one, and still computed."""


def _above(floor: float, entry: Quantity) -> Quantity:
    """A declaration whose range begins with a floor, if that is not zero."""
    if floor == 0.0:
        return entry
    closed = "both" if entry.closed in ("high", "both") else "low"
    return dataclasses.replace(entry, low=floor, closed=closed)


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
    far_side : {"traction", "free", "velocity", "clamped", "roller"}
        What is imposed on the first body's side away from the interface: both stresses (Eq. 10;
        two words for it), u_x and sigma_yy, u_x and u_y, or u_y and sigma_xy.
    second_far_side : str, optional
        The same of the second body; that of the first one by default.
    plane : {"strain", "stress", "antiplane"}
        Plane strain, or plane stress of thin plates, in which nu stands for ``nu/(1 + nu)``, or
        antiplane shear (mode III), in which nu and f do not matter.

    Attributes
    ----------
    registry : pint.UnitRegistry or None
        That of a parameter that was a pint quantity; the fields themselves are in SI units.

    Warns
    -----
    ImplausibleWarning
        If a magnitude is one that no known fault has, such as a shear modulus of 30 Pa.

    Raises
    ------
    ParameterError
        If a parameter is outside its range, missing, given twice or of another unit's dimension.
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
    second_far_side: str | None = None
    plane: str = "strain"
    registry: Any = dataclasses.field(default=None, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        missing = [name for name in REQUIRED if getattr(self, name) is None]
        if missing:
            raise ParameterError(f"{', '.join(missing)} is missing: None is not allowed")
        for name in self._given():
            if is_quantity(getattr(self, name)):
                object.__setattr__(self, "registry", getattr(self, name)._REGISTRY)
        if (self.zeta is None) == (self.b is None):
            raise ParameterError("zeta or b = a + zeta is needed, one of them and not both")
        for name in self._given():
            object.__setattr__(self, name, checked(name, getattr(self, name), QUANTITIES[name]))
        self.broadcast()
        if self.second_far_side is None:
            object.__setattr__(self, "second_far_side", self.far_side)
        for name in _WORDS:
            if getattr(self, name) not in QUANTITIES[name].choices:
                raise ParameterError(refusal(name, getattr(self, name), QUANTITIES[name]))
        for name in ("far_side", "second_far_side"):
            require_far_side(name, getattr(self, name), self.plane)
        if self.zeta is None:
            object.__setattr__(self, "zeta", self.b - self.a)
        else:
            object.__setattr__(self, "b", self.a + self.zeta)
        for name in ("shear_modulus", "poisson_ratio", "height"):
            if getattr(self, f"second_{name}") is None:
                object.__setattr__(self, f"second_{name}", getattr(self, name))
        arrays = [getattr(self, name) for name in self._given()]
        if any(map(labelled, arrays)) and any(x.ndim and not labelled(x) for x in arrays):
            raise ParameterError("arrays with and without named dimensions can't be combined")
        coupled = self.plane != ANTIPLANE and np.any(self.bodies_differ)
        if self.friction is None and coupled:
            raise ParameterError(
                "friction is missing: where the bodies differ, slip changes the normal stress, "
                "and the friction coefficient matters"
            )

    def _given(self) -> list[str]:
        names = (field.name for field in dataclasses.fields(self))
        others = (*_WORDS, "registry")
        return [n for n in names if n not in others and getattr(self, n) is not None]

    @property
    def in_plane_ratios(self) -> tuple[Any, Any]:
        """nu of both bodies in plane strain, ``nu/(1 + nu)`` in plane stress, 0 in antiplane."""
        ratios = self.poisson_ratio, self.second_poisson_ratio
        return in_plane_ratio(ratios[0], self.plane), in_plane_ratio(ratios[1], self.plane)

    @property
    def bodies_differ(self) -> Any:
        """Whether the second body is no mirror image of the first one (bool array)."""
        return (
            (self.second_shear_modulus != self.shear_modulus)
            | (self.second_poisson_ratio != self.poisson_ratio)
            | (self.second_height != self.height)
            | (FAR_SIDES[self.far_side] is not FAR_SIDES[self.second_far_side])  # type: ignore[index]
        )

    def broadcast(self, **others: Values) -> None:
        """Raise a ParameterError, naming shapes, where arrays without names don't broadcast."""
        arrays = {name: getattr(self, name) for name in self._given()} | others
        shapes = {n: np.shape(x) for n, x in arrays.items() if np.ndim(x) and not labelled(x)}
        try:
            np.broadcast_shapes(*shapes.values())
        except ValueError:
            told = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
            raise ParameterError(f"the shapes of the parameters don't broadcast: {told}") from None

    def evaluate(
        self, function: Callable[..., Any], *arrays: Values, rows: int = 1, dtype: type = float
    ) -> Any:
        """Values of a function of many faults at every point of the broadcast parameters.

        Shape ``(rows,) + broadcast shape``; the first dimension of a DataArray is called ``row``.

        Parameters
        ----------
        function : takes :class:`~nucleation.theory.critical.Systems` of n faults and n entries of
            each further argument; returns `rows` arrays of length n.
        arrays : further arguments, which broadcast with the parameters.
        rows, dtype : number of values at each point, and their type.
        """
        neutral = {"friction": 0.0, "velocity": 1.0}  # where not given they do not matter
        first, second = self.in_plane_ratios
        own = {"poisson_ratio": first, "second_poisson_ratio": second}
        values = [own[n] if n in own else getattr(self, n) for n in _OF_SYSTEMS]
        values = [neutral[n] if v is None else v for n, v in zip(_OF_SYSTEMS, values, strict=True)]

        def core(*inputs: Array) -> NDArray:
            shape = np.broadcast_shapes(*(np.shape(x) for x in inputs))
            flat = [np.broadcast_to(x, shape).ravel() for x in inputs]
            found = np.empty((flat[0].size, rows), dtype=dtype)  # type: ignore[var-annotated]
            rigid = np.isinf(flat[_OF_SYSTEMS.index("second_shear_modulus")])
            for chosen in (np.flatnonzero(rigid), np.flatnonzero(~rigid)):
                if chosen.size:
                    part = [x[chosen] for x in flat]
                    own, rest = part[: len(_OF_SYSTEMS)], part[len(_OF_SYSTEMS) :]
                    found[chosen] = np.transpose(function(self._systems(*own), *rest))
            return found.reshape(*shape, rows)

        if not any(map(labelled, [*values, *arrays])):
            return np.moveaxis(core(*values, *arrays), -1, 0)
        import xarray as xr

        result = xr.apply_ufunc(core, *values, *arrays, output_core_dims=[["row"]])
        return result.transpose("row", ...)

    def _systems(
        self, modulus: Array, ratio: Array, height: Array, second_modulus: Array,
        second_ratio: Array, second_height: Array, friction: Array, a: Array, zeta: Array,
        slip_distance: Array, velocity: Array, normal_stress: Array,
    ) -> Systems:  # fmt: skip
        """Faults as systems, all or none of them with a rigid second body."""
        antiplane = self.plane == ANTIPLANE
        upper, lower = Layers(modulus, ratio, height, self.far_side, antiplane), None
        if np.all(np.isfinite(second_modulus)):
            second = (second_modulus, second_ratio, second_height, self.second_far_side)
            lower = Layers(*second, antiplane)
        softness = modulus * slip_distance / normal_stress
        return Systems(Pair(upper, lower), friction, a, zeta, softness, velocity / slip_distance)


def takes_fault(function: F) -> F:
    """Decorator: completion shows the parameters of :class:`Fault` in place of ``**fault``."""
    shown = inspect.signature(function)
    own = [p for p in shown.parameters.values() if p.kind is not p.VAR_KEYWORD]
    taken = {p.name for p in own}
    fault = [p for p in inspect.signature(Fault).parameters.values() if p.name not in taken]
    function.__signature__ = shown.replace(parameters=own + fault)  # type: ignore[attr-defined]
    return function


REQUIRED = ("shear_modulus", "poisson_ratio", "normal_stress", "a", "slip_distance")
_WORDS = ("far_side", "second_far_side", "plane")
_OF_SYSTEMS = (
    "shear_modulus", "poisson_ratio", "height", "second_shear_modulus", "second_poisson_ratio",
    "second_height", "friction", "a", "zeta", "slip_distance", "velocity", "normal_stress",
)  # fmt: skip


def labelled(value: Any) -> bool:
    """Whether it is a DataArray; xarray is not loaded for the question."""
    return "xarray" in sys.modules and isinstance(value, sys.modules["xarray"].DataArray)


def where(condition: Any, first: Any, second: Any) -> Any:
    """``xr.where`` if there is a DataArray, else NumPy's."""
    if any(map(labelled, (condition, first, second))):
        return sys.modules["xarray"].where(condition, first, second)
    return np.where(condition, first, second)[()]


def checked(name: str, value: Any, entry: Quantity) -> Array | xr.DataArray:
    """The value in SI units as an array of floats, all in the declared range."""
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
        at = ", ".join(map(str, np.unravel_index(bad[0], array.shape)))
        raise ParameterError(refusal(f"{name}[{at}]" if at else name, float(flat[bad[0]]), entry))
    warn_of_implausible(name, flat, entry)
    return array


def inside(values: Array, entry: Quantity) -> NDArray:
    """Whether each value lies in the declared range."""
    low = values >= entry.low if entry.closed in ("low", "both") else values > entry.low
    high = values <= entry.high if entry.closed in ("high", "both") else values < entry.high
    return low & high
