"""Functions of :class:`~nucleation.theory.spectrum.Systems` over the arrays of a fault."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..model.material import ANTIPLANE, in_plane_ratio
from ..model.quantities import ParameterError
from ..types import Array
from .pair import LayerPair
from .spectrum import Systems
from .stiffness import Layers
from .values import ZONE, FaultLike, Values, labelled
from .zone import Zone

_USUAL = np.errstate(
    divide="warn",
    over="warn",
    under="ignore",
    invalid="warn",
)
"""NumPy's own settings, whatever the caller's are."""

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


@_USUAL
def evaluate(
    fault: FaultLike,
    function: Callable[..., Any],
    *arrays: Values,
    rows: int = 1,
    dtype: type = float,
) -> Any:
    """Values of a function of Systems (n faults) and n entries of each array, at every point.

    The function returns `rows` arrays of length n; the result has the shape ``(rows,) + broadcast
    shape``, and the first dimension of a DataArray is ``row``.
    """
    parameters = _parameters_of_systems(fault)
    names = list(parameters)

    def core(*inputs: Values) -> NDArray:
        shape = np.broadcast_shapes(*(np.shape(x) for x in inputs))
        flat = [np.broadcast_to(x, shape).ravel() for x in inputs]
        found: NDArray = np.empty((flat[0].size, rows), dtype=dtype)
        rigid = np.isinf(flat[names.index("second_shear_modulus")])
        for kind in (rigid, ~rigid):
            chosen = np.flatnonzero(kind)
            if chosen.size == 0:
                continue
            part = [x[chosen] for x in flat]
            own = dict(zip(names, part, strict=False))
            further = part[len(names) :]
            found[chosen] = np.transpose(function(_systems(fault, own), *further))
        return found.reshape(*shape, rows)

    values = parameters.values()
    if not any(labelled(value) for value in (*values, *arrays)):
        return np.moveaxis(core(*values, *arrays), -1, 0)
    import xarray as xr

    result = xr.apply_ufunc(
        core,
        *values,
        *arrays,
        output_core_dims=[["row"]],
    )
    return result.transpose("row", ...)


def require_broadcast(arrays: dict[str, Any]) -> None:
    """Raise a ParameterError, with all shapes, where unnamed arrays don't broadcast."""
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


def single_system(fault: FaultLike) -> Systems:
    """A single fault as Systems with fields of shape (1,)."""
    found: list[Systems] = []

    def note(systems: Systems) -> list[Array]:
        found.append(systems)
        return [systems.a]

    evaluate(fault, note)
    return found[0]


def _parameters_of_systems(fault: FaultLike) -> dict[str, Values]:
    """The parameters that Systems have, with neutral values where they do not matter."""
    names = (*_OF_SYSTEMS, *ZONE) if fault.has_zone else _OF_SYSTEMS
    found = {name: getattr(fault, name) for name in names}
    for name in names:
        if name.endswith("poisson_ratio"):
            found[name] = in_plane_ratio(found[name], fault.plane)
    for name, neutral in (("friction", 0.0), ("velocity", 1.0)):
        if found[name] is None:
            found[name] = neutral
    return found


def _systems(fault: FaultLike, own: dict[str, Array]) -> Systems:
    """Faults as systems, all or none of them with a rigid second body."""
    modulus = own["shear_modulus"]
    upper = _body(fault, own, "", fault.far_side)
    lower = None
    if np.all(np.isfinite(own["second_shear_modulus"])):
        lower = _body(fault, own, "second_", fault.second_far_side)
    return Systems(
        pair=LayerPair(upper, lower),
        friction=own["friction"],
        a=own["a"],
        zeta=own["zeta"],
        softness=modulus * own["slip_distance"] / own["normal_stress"],
        rate=own["velocity"] / own["slip_distance"],
    )


def _body(
    fault: FaultLike,
    own: dict[str, Array],
    prefix: str,
    far_side: str,
) -> Layers | Zone:
    """The first or the second body, with its zone."""
    antiplane = fault.plane == ANTIPLANE
    body = Layers(
        own[f"{prefix}shear_modulus"],
        own[f"{prefix}poisson_ratio"],
        own[f"{prefix}height"],
        far_side,
        antiplane,
    )
    if not fault.has_zone:
        return body
    modulus, ratio = own["zone_shear_modulus"], own["zone_poisson_ratio"]
    layer = Layers(modulus, ratio, own["zone_thickness"], "free", antiplane)
    return Zone(layer, body)
