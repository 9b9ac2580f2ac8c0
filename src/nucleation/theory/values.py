"""The values that the parameters of a fault may have: declarations, checks, arrays of any kind."""

from __future__ import annotations

import dataclasses
import math
import sys
from typing import TYPE_CHECKING, Any, Protocol, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..model.friction import Friction
from ..model.hints import warn_of_implausible
from ..model.material import Material
from ..model.quantities import ParameterError, Quantity, declarations, declared, refusal
from ..model.units import magnitude
from ..types import Array
from .stiffness import FAR_SIDES

if TYPE_CHECKING:
    import xarray as xr

Values: TypeAlias = "ArrayLike | xr.DataArray"
"""Parameters as they are given."""


class FaultLike(Protocol):
    """One or many faults as the theory sees them: what it needs of :class:`nucleation.fault.Fault`.

    Numbers are floats or arrays in SI units; those that may be left out may be None.
    """

    @property
    def shear_modulus(self) -> Any: ...
    @property
    def poisson_ratio(self) -> Any: ...
    @property
    def normal_stress(self) -> Any: ...
    @property
    def a(self) -> Any: ...
    @property
    def b(self) -> Any: ...
    @property
    def zeta(self) -> Any: ...
    @property
    def slip_distance(self) -> Any: ...
    @property
    def friction(self) -> Any: ...
    @property
    def velocity(self) -> Any: ...
    @property
    def height(self) -> Any: ...
    @property
    def second_shear_modulus(self) -> Any: ...
    @property
    def second_poisson_ratio(self) -> Any: ...
    @property
    def second_height(self) -> Any: ...
    @property
    def far_side(self) -> str: ...
    @property
    def second_far_side(self) -> str | None: ...
    @property
    def zone_thickness(self) -> Any: ...
    @property
    def zone_shear_modulus(self) -> Any: ...
    @property
    def zone_poisson_ratio(self) -> Any: ...
    @property
    def plane(self) -> str: ...
    @property
    def loading(self) -> str: ...
    @property
    def evolution(self) -> str | None: ...
    @property
    def friction_law(self) -> Friction | None: ...
    @property
    def density(self) -> Any: ...
    @property
    def second_density(self) -> Any: ...
    @property
    def initial_state(self) -> Any: ...
    @property
    def registry(self) -> Any: ...

    def keys(self) -> list[str]: ...

    def __getitem__(self, name: str) -> Any: ...

    def single(self, name: str) -> float: ...

    def replace(self, **changes: Any) -> Self: ...

    def critical_length(self) -> Any: ...

    def stability_length(self) -> Any: ...


Numbers: TypeAlias = "Array | xr.DataArray"
"""Parameters after their check, and what is computed of them."""

Conditions: TypeAlias = "bool | NDArray[np.bool_] | xr.DataArray"
"""Where something holds of such parameters."""


ALIASES = {"traction": "free"}
"""Other words for a far side; a fault has that of :data:`.stiffness.FAR_SIDES`."""


def _declared() -> dict[str, Quantity]:
    """Unit, range and meaning of each parameter, from its declaration in the model.

    Positive parameters begin at a value far below any known one, so that all is computable.
    """
    material = declarations(Material)
    friction = declarations(Friction)
    replace = dataclasses.replace
    modulus = replace(material["shear_modulus"], low=1e-9, closed="[)")
    ratio = material["poisson_ratio"]
    height = declared("height of the body (inf: half-space)", "[1e-12, inf] m", symbol="H")
    far_side = Quantity(
        "condition on the side away from the interface: velocity (u_x and sigma_yy imposed), "
        "free or traction (sigma_xy and sigma_yy imposed), clamped (u_x and u_y imposed) or "
        "roller (u_y and sigma_xy imposed)",
        choices=(*FAR_SIDES, *ALIASES),
    )
    return {
        "shear_modulus": modulus,
        "poisson_ratio": ratio,
        "height": height,
        "normal_stress": declared("compressive normal stress", "[1e-6, 1e13) Pa", symbol="sigma0"),
        "a": declared("direct-effect coefficient a", "[1e-12, 10.0)", symbol="a"),
        "zeta": declared(
            "velocity weakening zeta (negative: strengthening)", "(-10.0, 10.0)", symbol="zeta"
        ),
        "friction": declared("friction coefficient of steady sliding", "[0.0, 10.0)", symbol="f"),
        "velocity": declared("sliding velocity", "[1e-30, 1e3) m/s", symbol="V"),
        "b": declared(
            "coefficient b = a + zeta of the log of the state", "(0.0, 10.0)", symbol="b"
        ),
        "slip_distance": friction["slip_distance"],
        "second_shear_modulus": replace(
            modulus,
            closed="[]",
            high=math.inf,
            description="shear modulus of the second body (inf: rigid)",
        ),
        "second_poisson_ratio": ratio,
        "second_height": height,
        "far_side": far_side,
        "second_far_side": far_side,
        "zone_thickness": replace(
            height,
            symbol="h",
            description="thickness of a zone of other stiffness on each side of the fault",
        ),
        "zone_shear_modulus": replace(
            modulus, symbol="mu_z", description="shear modulus of the zone beside the fault"
        ),
        "zone_poisson_ratio": replace(
            ratio, symbol="nu_z", description="Poisson's ratio of the zone beside the fault"
        ),
        "plane": material["plane"],
        "loading": Quantity(
            choices=("edge", "remote"),
            description="start of the creeping patch: an edge that is pushed, or the interior "
            "under a remote load",
        ),
        "evolution": friction["evolution"],
        "density": material["density"],
        "second_density": replace(
            material["density"], description="mass density of the second body"
        ),
        "initial_state": declared(
            "initial state variable (age) of the interface", "(0.0, 1e12) s", symbol="phi0"
        ),
    }


QUANTITIES = _declared()
"""Declaration (unit, range, meaning) of every parameter of a fault, by name."""

WORDS = ("far_side", "second_far_side", "plane", "loading", "evolution")
"""Parameters that are words."""

ZONE = ("zone_thickness", "zone_shear_modulus", "zone_poisson_ratio")
"""Parameters of a zone beside the fault."""


def labelled(value: Any) -> bool:
    """Whether it is a DataArray; this does not load xarray."""
    return "xarray" in sys.modules and isinstance(value, sys.modules["xarray"].DataArray)


def where(condition: Any, first: Any, second: Any) -> Any:
    """``xr.where`` if there is a DataArray, else NumPy's; of broadcast shape."""
    if any(labelled(value) for value in (condition, first, second)):
        return sys.modules["xarray"].where(condition, first, second)
    return np.where(condition, first, second)[()]


def checked(name: str, value: Any, entry: Quantity) -> Array | xr.DataArray:
    """The value, with or without a unit, as an array of floats (SI units) in the declared range.

    Raises ParameterError if it is no array of numbers, or one of them is out of range.
    """
    if not (isinstance(value, float) and entry.inside(value)):  # as few values of many runs
        value = _array(name, value, entry)
    warn_of_implausible(name, value, entry)
    return value if labelled(value) else np.asarray(value)


def _array(name: str, value: Any, entry: Quantity) -> Array | xr.DataArray:
    """The array of :func:`checked`; its magnitudes may be implausible."""
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
    bad = np.flatnonzero(~entry.inside(flat))
    if bad.size:
        position = np.unravel_index(bad[0], array.shape)
        at = ", ".join(str(i) for i in position)
        entry_name = f"{name}[{at}]" if at else name
        raise ParameterError(refusal(entry_name, float(flat[bad[0]]), entry))
    return array


def numbers_of(fault: FaultLike) -> dict[str, Any]:
    """The numbers and arrays among the parameters of a fault, without those that are None."""
    found = {name: getattr(fault, name) for name in QUANTITIES if name not in WORDS}
    return {name: value for name, value in found.items() if value is not None}


def named(values: Any, name: str, units: str, long_name: str, fault: FaultLike) -> Any:
    """A result (SI units) in the form of the fault's parameters: DataArray, quantity or array."""
    if labelled(values):
        return values.rename(name).assign_attrs(units=units, long_name=long_name)
    return values if fault.registry is None else fault.registry.Quantity(values, units)
