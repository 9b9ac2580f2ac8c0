"""L_s in the page: of three systems, on grids to interpolate on.

With constant a and b, L_s over L_c depends on few numbers. On a rigid base these are zeta/a,
Poisson's ratio, f, and ``h = (1 - nu) b sigma0 H/(mu D)``, the height over the friction length; for
two identical layers that are free to bend the same without f. Of two half-spaces, alike or not,
``zeta sigma0 L_s/(pi M D)`` depends on zeta/a and f beta alone. The logarithms are tabulated at
Chebyshev nodes of log(zeta/a), nu, f, f beta and ``t = (r - 1)/(r + 1)``, ``r = (h/CENTRE)^POWER``;
the page lays a polynomial through them. Beyond both ends of h the ratio hardly changes any more.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from ..theory.arrays import critical_length
from ..theory.creep.lengths import stability_length
from ..types import Array
from .encode import float32

HEIGHTS = (1e-3, 1e3)  # h
CENTRE, POWER = 2.0, 0.7  # h at which the ratio changes most, and how fast t leaves it
PRECISION = 0.01
"""Relative, of L_s in the page against :func:`~nucleation.theory.creep.lengths.stability_length`;
tested at random faults."""

FAULT: dict[str, Any] = {
    "shear_modulus": 1e9, "normal_stress": 1e6, "b": 0.02, "slip_distance": 1e-6,
}  # fmt: skip
FRICTION_LENGTH = 0.05  # mu D/(b sigma0) of this fault (m)


def rigid_base(place: Array, zeta_over_a: Array, nu: Array, f: Array) -> Array:
    """L_s over L_c of blocks on a rigid base; they broadcast."""
    return _ratio(place, zeta_over_a, nu, friction=f, second_shear_modulus=np.inf)


def identical_layers(place: Array, zeta_over_a: Array, nu: Array) -> Array:
    """L_s over L_c of two identical layers whose far sides are free."""
    return _ratio(place, zeta_over_a, nu)


def _ratio(place: Array, zeta_over_a: Array, nu: Array, **more: Any) -> Array:
    height = CENTRE * ((1.0 + place) / (1.0 - place)) ** (1.0 / POWER)
    own = {"poisson_ratio": nu, "a": FAULT["b"] / (1.0 + zeta_over_a)}
    fault = FAULT | own | {"height": height * FRICTION_LENGTH / (1.0 - nu)} | more
    return np.asarray(stability_length(**fault) / critical_length(**fault))


def half_spaces(zeta_over_a: Array, coupling: Array) -> Array:
    """``zeta sigma0 L_s/(pi M D)`` of two half-spaces with f beta = coupling."""
    a = FAULT["b"] / (1.0 + zeta_over_a)
    soft = np.where(coupling < 0.0, 1e-6, np.inf)  # nu = 0 on a rigid body: beta = 1/2, M = 8/3 mu
    fault = FAULT | {
        "a": a, "poisson_ratio": 0.0, "friction": 2.0 * np.abs(coupling),
        "second_shear_modulus": FAULT["shear_modulus"] * soft,
    }  # fmt: skip
    modulus = 8.0 / 3.0 * FAULT["shear_modulus"] * np.minimum(soft, 1.0)
    scale = np.pi * modulus * FAULT["slip_distance"] / ((FAULT["b"] - a) * FAULT["normal_stress"])
    return np.asarray(stability_length(**fault) / scale)


class Table(NamedTuple):
    """What is tabulated, over which ends of its arguments, at how many nodes of each."""

    values: Callable[..., Array]
    ends: dict[str, tuple[float, float]]
    nodes: tuple[int, ...]


def _place(height: float) -> float:
    ratio = (height / CENTRE) ** POWER
    return (ratio - 1.0) / (ratio + 1.0)


PLACE = (_place(HEIGHTS[0]), _place(HEIGHTS[1]))
WEAKENING, POISSON = (0.4, 50.0), (0.0, 0.49)
TABLES = {
    "rigid_base": Table(
        rigid_base, {"place": PLACE, "zeta_over_a": WEAKENING, "nu": POISSON, "f": (0.0, 1.0)},
        (16, 6, 3, 3),
    ),
    "identical_layers": Table(
        identical_layers, {"place": PLACE, "zeta_over_a": WEAKENING, "nu": POISSON}, (16, 6, 3)
    ),
    "half_spaces": Table(half_spaces, {"zeta_over_a": WEAKENING, "coupling": (-0.5, 0.5)}, (6, 9)),
}  # fmt: skip
"""By the names that the page has for the systems."""


@lru_cache(maxsize=1)
def in_page() -> dict[str, Any]:
    """What the page reads: of every table ends, nodes of each axis, and the logarithms on them."""
    return {
        "heights": HEIGHTS, "centre": CENTRE, "power": POWER, "precision": PRECISION,
        "tables": {name: _tabulated(table) for name, table in TABLES.items()},
    }  # fmt: skip


def _tabulated(table: Table) -> dict[str, Any]:
    nodes = {
        name: _chebyshev(np.log(ends) if name == "zeta_over_a" else np.array(ends), number)
        for (name, ends), number in zip(table.ends.items(), table.nodes, strict=True)
    }
    places = dict(zip(nodes, np.meshgrid(*nodes.values(), indexing="ij"), strict=True))
    places["zeta_over_a"] = np.exp(places["zeta_over_a"])
    return {
        "ends": table.ends, "nodes": {name: x.tolist() for name, x in nodes.items()},
        "logs": float32(np.log(table.values(**places))),
    }  # fmt: skip


def _chebyshev(ends: Array, number: int) -> Array:
    roots = np.cos(np.pi * (np.arange(number) + 0.5) / number)
    return ends.mean() + 0.5 * np.diff(ends) * roots
