"""L_s in the page: tables for three systems, between which the page interpolates.

With constant a and b, L_s over L_c depends on few numbers. On a rigid base these are zeta/a,
Poisson's ratio, f, and ``h = (1 - nu) b sigma0 H/(mu D)``, the height over the friction length. For
two identical layers that are free to bend they are the same except f. For two half-spaces,
``zeta sigma0 L_s/(pi M D)`` depends only on zeta/a and f beta. The logarithms are tabulated at
Chebyshev nodes of log(zeta/a), nu, f, f beta and the place of h (:mod:`.tabulated`); the page
interpolates them by a polynomial. Beyond both ends of h the ratio is nearly constant.
"""

from functools import lru_cache
from typing import Any

import numpy as np

from nucleation.theory.arrays import critical_length
from nucleation.theory.creep.lengths import stability_length
from nucleation.types import Array

from .tabulated import CENTRE, HEIGHTS, PLACES, POWER, Table, height_at, tabulate

PRECISION = 0.01
"""Relative error of L_s in the page, against
:func:`~nucleation.theory.creep.lengths.stability_length`; tested for random faults."""

_SHEAR_MODULUS = 1e9  # Pa
_NORMAL_STRESS = 1e6  # Pa
B = 0.02
_SLIP_DISTANCE = 1e-6  # m
FAULT = {
    "shear_modulus": _SHEAR_MODULUS,
    "normal_stress": _NORMAL_STRESS,
    "b": B,
    "slip_distance": _SLIP_DISTANCE,
}
"""The fault of the tables, in SI units; a and the height vary."""
_FRICTION_LENGTH = 0.05  # mu D/(b sigma0) of this fault (m)


def _rigid_base(place: Array, zeta_over_a: Array, nu: Array, f: Array) -> Array:
    """L_s over L_c of blocks on a rigid base; the arguments broadcast."""
    return _ratio(place, zeta_over_a, nu, friction=f, second_shear_modulus=np.inf)


def _ratio(place: Array, zeta_over_a: Array, nu: Array, **more: Any) -> Array:
    """L_s over L_c; without further parameters of two identical layers with free far sides."""
    fault: dict[str, Any] = {
        **FAULT,
        "poisson_ratio": nu,
        "a": B / (1.0 + zeta_over_a),
        "height": height_at(place) * _FRICTION_LENGTH / (1.0 - nu),
        **more,
    }
    return np.asarray(stability_length(**fault) / critical_length(**fault))


def _half_spaces(zeta_over_a: Array, coupling: Array) -> Array:
    """``zeta sigma0 L_s/(pi M D)`` of two half-spaces with f beta = coupling."""
    a = B / (1.0 + zeta_over_a)
    # nu = 0 on a rigid body: beta = 1/2, M = 8/3 mu
    softness = np.where(coupling < 0.0, 1e-6, np.inf)
    fault: dict[str, Any] = {
        **FAULT,
        "a": a,
        "poisson_ratio": 0.0,
        "friction": 2.0 * np.abs(coupling),
        "second_shear_modulus": _SHEAR_MODULUS * softness,
    }
    modulus = 8.0 / 3.0 * _SHEAR_MODULUS * np.minimum(softness, 1.0)
    scale = np.pi * modulus * _SLIP_DISTANCE / ((B - a) * _NORMAL_STRESS)
    return np.asarray(stability_length(**fault) / scale)


_WEAKENING = (0.4, 50.0)
_POISSON = (0.0, 0.49)
_LAYERS = {"place": PLACES, "zeta_over_a": _WEAKENING, "nu": _POISSON}
TABLES = {
    "rigid_base": Table(_rigid_base, {**_LAYERS, "f": (0.0, 1.0)}, (16, 6, 3, 3)),
    "identical_layers": Table(_ratio, _LAYERS, (16, 6, 3)),
    "half_spaces": Table(
        _half_spaces,
        {"zeta_over_a": _WEAKENING, "coupling": (-0.5, 0.5)},
        (6, 9),
    ),
}
"""By the names of the systems in the page."""


@lru_cache(maxsize=1)
def in_page() -> dict[str, Any]:
    """Values for the page: ranges, nodes of each argument, and the logarithms at the nodes."""
    return {
        "heights": HEIGHTS,
        "centre": CENTRE,
        "power": POWER,
        "precision": PRECISION,
        "tables": {name: tabulate(table) for name, table in TABLES.items()},
    }
