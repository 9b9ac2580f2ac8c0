"""One or many faults: two elastic bodies and linearised friction, as arrays that broadcast.

The array form of the linear theory's input. Every parameter may be a number, an array, a pint
quantity, an :class:`xarray.DataArray` or a text with a unit such as "0.5um"; they broadcast
together as NumPy's or, by name, as xarray's do. Values with a unit are converted to SI units.
"""

from __future__ import annotations

import dataclasses
import inspect
import math
from collections.abc import Callable
from typing import Any, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..model.friction.law import Friction
from ..model.material import ANTIPLANE, in_plane_ratio
from ..model.quantities import ParameterError, refusal
from ..model.synonyms import hint
from ..model.units import is_quantity
from ..types import Array
from .pair import LayerPair
from .spectrum import Systems
from .stiffness import FAR_SIDES, Layers, require_far_side
from .values import QUANTITIES, ZONE, Values, checked, labelled
from .zone import Zone

F = TypeVar("F", bound=Callable[..., Any])

_MISSING: Any = None
"""The default of parameters without one, so that an error can name all that are missing."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class FaultParameters:
    """Two bodies in frictional contact that slide steadily; scalars, arrays or DataArrays.

    Parameters
    ----------
    shear_modulus : array_like
        mu (Pa) of the first body.
    poisson_ratio : array_like
        nu of the first body; not needed in antiplane shear.
    normal_stress : array_like
        sigma0 (Pa), compressive positive.
    a : array_like
        Direct effect, ``a = v df/dv`` at fixed state, by the **natural** logarithm: divide a value
        per decade by ``ln 10 = 2.303``.
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
        Boundary condition on the first body's side away from the interface: both stresses (Eq. 10,
        two aliases), u_x and sigma_yy, u_x and u_y, or u_y and sigma_xy are imposed.
    second_far_side : str, optional
        The same of the second body; that of the first one by default.
    zone_thickness : array_like, optional
        Thickness h (m) of a zone of other stiffness, gouge or damaged rock, between the fault and
        each body that is not rigid; heights do not include it. By default there is no zone.
    zone_shear_modulus, zone_poisson_ratio : array_like, optional
        mu (Pa) and nu of the zone; the first body's nu by default.
    plane : {"strain", "stress", "antiplane"}
        Plane strain, or plane stress of thin plates, with ``nu/(1 + nu)`` in place of nu, or
        antiplane shear (mode III), in which nu and f do not matter.
    loading : {"edge", "remote"}
        Where the creeping patch begins: at an edge that is pushed, or in the interior under a load
        from afar. The bodies' `far_side` sets the boundary condition there.
    evolution : str
        Evolution of the state, that of `friction_law` by default, else ``aging``.
    friction_law : Friction, optional
        The full law, which gives the local a(v), b(v) along a creeping patch; needs `velocity`.
        Those of f, a, zeta and D that are not given are the law's, expanded about V; a law has the
        values that are given. By default a and b are constant.

    Attributes
    ----------
    registry : pint.UnitRegistry or None
        Registry of a parameter that was a pint quantity; the fields themselves are in SI units.

    Warns
    -----
    ImplausibleWarning
        If no known fault has such a magnitude, as with a shear modulus of 30 Pa.

    Raises
    ------
    ParameterError
        If a parameter is outside its range, missing, given twice or of another unit's dimension.

    Examples
    --------
    >>> fault = FaultParameters(
    ...     shear_modulus=30e9, poisson_ratio=0.25, normal_stress=50e6,
    ...     a=0.010, b=0.015, slip_distance="5um",
    ... )
    >>> round(float(fault.zeta), 4), float(fault.slip_distance)
    (0.005, 5e-06)
    """

    shear_modulus: Values = _MISSING
    poisson_ratio: Values = _MISSING
    normal_stress: Values = _MISSING
    a: Values = _MISSING
    zeta: Values | None = None
    b: Values | None = None
    slip_distance: Values = _MISSING
    friction: Values | None = None
    velocity: Values | None = None
    height: Values = math.inf
    second_shear_modulus: Values | None = None
    second_poisson_ratio: Values | None = None
    second_height: Values | None = None
    far_side: str = "traction"
    second_far_side: str | None = None
    zone_thickness: Values | None = None
    zone_shear_modulus: Values | None = None
    zone_poisson_ratio: Values | None = None
    plane: str = "strain"
    loading: str = "edge"
    evolution: str | None = None
    friction_law: Friction | None = None
    registry: Any = dataclasses.field(default=None, init=False, repr=False, compare=False)

    def __new__(cls, **given: Any) -> Self:
        for name in given:
            if name not in QUANTITIES and name != "friction_law":
                suggestion = hint(name, QUANTITIES) or f"known: {', '.join(QUANTITIES)}"
                raise ParameterError(
                    f"the fault got an unexpected keyword argument {name!r}; {suggestion}"
                )
        return super().__new__(cls)

    def __post_init__(self) -> None:
        if self.friction_law is not None:
            self._expand(self.friction_law)
        missing = [name for name in required(self.plane) if getattr(self, name) is None]
        if missing:
            raise ParameterError(f"{', '.join(missing)} is missing: every fault needs it")
        if (self.zeta is None) == (self.b is None):
            raise ParameterError("zeta or b = a + zeta is needed, one of them and not both")
        self._require_whole_zone()
        self._read_numbers()
        self._read_words()
        self._complete()
        self._check_kinds()
        coupled = self.plane != ANTIPLANE and np.any(self.bodies_differ)
        if self.friction is None and coupled:
            raise ParameterError(
                "friction is missing: where the bodies differ, slip changes the normal stress, "
                "and the friction coefficient matters"
            )

    def _expand(self, law: Friction) -> None:
        """Take constants that are not given from the law, expanded about V."""
        if self.velocity is None:
            raise ParameterError("velocity is missing: a friction law is expanded about it")
        if self.evolution is None:
            self._set("evolution", law.evolution)
        if self.a is not None and self.friction is not None and self.slip_distance is not None:
            return
        speed = checked("velocity", self.velocity, QUANTITIES["velocity"])
        if speed.ndim:
            raise ParameterError(
                "a, zeta, friction and slip_distance are missing: a friction law is expanded about "
                "one velocity, not an array of them"
            )
        f, a, zeta = law.expansion(float(speed))
        if self.zeta is None and self.b is None:
            self._set("zeta", zeta)
        for name, value in (("friction", f), ("a", a), ("slip_distance", law.slip_distance)):
            if getattr(self, name) is None:
                self._set(name, value)

    def _require_whole_zone(self) -> None:
        """Refuse a zone without its thickness or its shear modulus."""
        given = [name for name in ZONE if getattr(self, name) is not None]
        for name in ("zone_thickness", "zone_shear_modulus"):
            if given and name not in given:
                raise ParameterError(
                    f"{name} is missing: a zone has a thickness (m) and a shear modulus (Pa), and "
                    f"{given[0]} is given"
                )

    def _read_numbers(self) -> None:
        """Convert all numbers to arrays in SI units."""
        for name in self._given():
            value = getattr(self, name)
            if is_quantity(value):
                self._set("registry", value._REGISTRY)
            self._set(name, checked(name, value, QUANTITIES[name]))
        self.broadcast()

    def _read_words(self) -> None:
        """Check the far sides and the plane."""
        if self.second_far_side is None:
            self._set("second_far_side", self.far_side)
        if self.evolution is None:
            self._set("evolution", "aging")
        for name in _WORDS:
            value = getattr(self, name)
            if value not in QUANTITIES[name].choices:
                raise ParameterError(refusal(name, value, QUANTITIES[name]))
        for name in ("far_side", "second_far_side"):
            require_far_side(name, getattr(self, name), self.plane)

    def _complete(self) -> None:
        """Set the parameters that follow from others."""
        own = vars(self)
        if self.zeta is None:
            self._set("zeta", own["b"] - own["a"])
        else:
            self._set("b", own["a"] + own["zeta"])
        if self.poisson_ratio is None:
            self._set("poisson_ratio", np.array(0.0))  # of antiplane shear, without effect
        if self.has_zone and self.zone_poisson_ratio is None:
            self._set("zone_poisson_ratio", self.poisson_ratio)
        for name in ("shear_modulus", "poisson_ratio", "height"):
            if getattr(self, f"second_{name}") is None:
                self._set(f"second_{name}", getattr(self, name))

    def _check_kinds(self) -> None:
        """Refuse arrays without named dimensions beside DataArrays."""
        arrays = [getattr(self, name) for name in self._given()]
        with_names = any(labelled(array) for array in arrays)
        without_names = any(array.ndim and not labelled(array) for array in arrays)
        if with_names and without_names:
            raise ParameterError("arrays with and without named dimensions can't be combined")

    def _set(
        self,
        name: str,
        value: Any,
    ) -> None:
        object.__setattr__(self, name, value)  # the dataclass is frozen

    def _given(self) -> list[str]:
        """Names of the numbers that are not None."""
        names = [field.name for field in dataclasses.fields(self)]
        numbers = [name for name in names if name not in (*_WORDS, *_OBJECTS)]
        return [name for name in numbers if getattr(self, name) is not None]

    @property
    def has_zone(self) -> bool:
        """Whether there is a zone of other stiffness beside the fault."""
        return self.zone_thickness is not None

    @property
    def in_plane_ratios(self) -> tuple[Any, Any]:
        """nu of both bodies in plane strain, ``nu/(1 + nu)`` in plane stress, 0 in antiplane."""
        first = in_plane_ratio(self.poisson_ratio, self.plane)
        second = in_plane_ratio(self.second_poisson_ratio, self.plane)
        return first, second

    @property
    def bodies_differ(self) -> Any:
        """Whether the second body is no mirror image of the first one (bool array)."""
        other_far_side = FAR_SIDES[self.far_side] is not FAR_SIDES[str(self.second_far_side)]
        return (
            (self.second_shear_modulus != self.shear_modulus)
            | (self.second_poisson_ratio != self.poisson_ratio)
            | (self.second_height != self.height)
            | other_far_side
        )

    def keys(self) -> list[str]:
        """Names of the parameters with a value; with ``[name]`` they make ``**fault`` possible."""
        names = [field.name for field in dataclasses.fields(self)]
        found = []
        for name in names:
            value = getattr(self, name)
            left_out = ("b", "registry")  # zeta has b's value
            if value is not None and name not in left_out and not self._is_the_firsts(name):
                found.append(name)
        return found

    def _is_the_firsts(self, name: str) -> bool:
        """Whether a parameter of the second body was left out, so that it is the first body's."""
        _, second, first = name.partition("second_")
        return bool(second) and getattr(self, name) is getattr(self, first)

    def __getitem__(self, name: str) -> Any:
        value = getattr(self, name)
        if self.registry is None or name in (*_WORDS, *_OBJECTS):
            return value
        return self.registry.Quantity(value, QUANTITIES[name].unit)

    def broadcast(self, **others: Values) -> None:
        """Raise a ParameterError, with all shapes, where unnamed arrays don't broadcast."""
        arrays = {name: getattr(self, name) for name in self._given()} | others
        shapes = {
            name: np.shape(array)
            for name, array in arrays.items()
            if np.ndim(array) and not labelled(array)
        }
        try:
            np.broadcast_shapes(*shapes.values())
        except ValueError:
            listed = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
            message = f"the shapes of the parameters don't broadcast: {listed}"
            raise ParameterError(message) from None

    def evaluate(
        self,
        function: Callable[..., Any],
        *arrays: Values,
        rows: int = 1,
        dtype: type = float,
    ) -> Any:
        """Values of a function of many faults at every point of the broadcast parameters.

        Parameters
        ----------
        function : callable
            Takes :class:`~nucleation.theory.spectrum.Systems` of n faults and n entries of each
            further argument; returns `rows` arrays of length n.
        *arrays : array_like or DataArray
            Further arguments, which broadcast with the parameters.
        rows : int
            Number of values at each point.
        dtype : type
            Type of the values.

        Returns
        -------
        ndarray or DataArray
            Shape ``(rows,) + broadcast shape``; the first dimension of a DataArray is ``row``.
        """

        parameters = self._parameters_of_systems()

        def core(*inputs: Values) -> NDArray:
            shape = np.broadcast_shapes(*(np.shape(x) for x in inputs))
            flat = [np.broadcast_to(x, shape).ravel() for x in inputs]
            found: NDArray = np.empty((flat[0].size, rows), dtype=dtype)
            rigid = np.isinf(flat[list(parameters).index("second_shear_modulus")])
            for kind in (rigid, ~rigid):
                chosen = np.flatnonzero(kind)
                if chosen.size == 0:
                    continue
                part = [x[chosen] for x in flat]
                own = dict(zip(parameters, part, strict=False))
                further = part[len(parameters) :]
                found[chosen] = np.transpose(function(self._systems(own), *further))
            return found.reshape(*shape, rows)

        values = parameters.values()
        if not any(labelled(value) for value in (*values, *arrays)):
            return np.moveaxis(core(*values, *arrays), -1, 0)
        import xarray as xr

        result = xr.apply_ufunc(core, *values, *arrays, output_core_dims=[["row"]])
        return result.transpose("row", ...)

    def _parameters_of_systems(self) -> dict[str, Values]:
        """The parameters :data:`_OF_SYSTEMS`, with neutral values where they do not matter."""
        names = (*_OF_SYSTEMS, *ZONE) if self.has_zone else _OF_SYSTEMS
        found = {name: getattr(self, name) for name in names}
        for name in names:
            if name.endswith("poisson_ratio"):
                found[name] = in_plane_ratio(found[name], self.plane)
        for name, neutral in (("friction", 0.0), ("velocity", 1.0)):
            if found[name] is None:
                found[name] = neutral
        return found

    def _systems(self, own: dict[str, Array]) -> Systems:
        """Faults as systems, all or none of them with a rigid second body."""
        modulus = own["shear_modulus"]
        upper = self._body(own, "", self.far_side)
        lower = None
        if np.all(np.isfinite(own["second_shear_modulus"])):
            lower = self._body(own, "second_", str(self.second_far_side))
        return Systems(
            pair=LayerPair(upper, lower),
            friction=own["friction"],
            a=own["a"],
            zeta=own["zeta"],
            softness=modulus * own["slip_distance"] / own["normal_stress"],
            rate=own["velocity"] / own["slip_distance"],
        )

    def _body(
        self,
        own: dict[str, Array],
        prefix: str,
        far_side: str,
    ) -> Layers | Zone:
        """The first or the second body, with its zone."""
        antiplane = self.plane == ANTIPLANE
        body = Layers(
            own[f"{prefix}shear_modulus"],
            own[f"{prefix}poisson_ratio"],
            own[f"{prefix}height"],
            far_side,
            antiplane,
        )
        if not self.has_zone:
            return body
        modulus, ratio = own["zone_shear_modulus"], own["zone_poisson_ratio"]
        layer = Layers(modulus, ratio, own["zone_thickness"], "free", antiplane)
        return Zone(layer, body)


def takes_fault(function: F) -> F:
    """Decorator: completion shows the parameters of a fault in place of ``**fault``."""
    shown = inspect.signature(function)
    own = [p for p in shown.parameters.values() if p.kind is not p.VAR_KEYWORD]
    taken = {p.name for p in own}
    of_fault = inspect.signature(FaultParameters.__init__).parameters.values()
    added = [p for p in of_fault if p.name not in taken and p.name != "self"]
    function.__signature__ = shown.replace(parameters=own + added)  # type: ignore[attr-defined]
    return function


def required(plane: str) -> list[str]:
    """Names of the parameters without a default; Poisson's ratio has none but in antiplane."""
    names = ["shear_modulus", "poisson_ratio", "normal_stress", "a", "slip_distance"]
    if plane == ANTIPLANE:
        names.remove("poisson_ratio")
    return names


_WORDS = ("far_side", "second_far_side", "plane", "loading", "evolution")
_OBJECTS = ("friction_law", "registry")
_OF_SYSTEMS = (
    "shear_modulus",
    "poisson_ratio",
    "height",
    "second_shear_modulus",
    "second_poisson_ratio",
    "second_height",
    "friction",
    "a",
    "zeta",
    "slip_distance",
    "velocity",
    "normal_stress",
)
