"""L_s in the page: its ratio to L_c for a block on a rigid base, on a grid to interpolate on.

Without a law's own scales L_s over L_c depends on four numbers: zeta/a, Poisson's ratio, f, and
``h = (1 - nu) b sigma0 H/(mu D)``, the height over the friction length. Its logarithm is tabulated
at Chebyshev nodes of log(zeta/a), nu, f and ``t = (r - 1)/(r + 1)``, ``r = (h/CENTRE)^POWER``; the
page lays a polynomial through them. Beyond both ends of h the ratio hardly changes any more.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..theory.arrays import critical_length
from ..theory.creep.lengths import stability_length
from .encode import float32

Array = NDArray[np.float64]

ENDS = {"zeta_over_a": (0.4, 50.0), "nu": (0.0, 0.49), "f": (0.0, 1.0)}
HEIGHTS = (1e-3, 1e3)  # h
CENTRE, POWER = 2.0, 0.7  # h at which the ratio changes most, and how fast t leaves it
NODES = (6, 3, 3, 16)
PRECISION = 0.01
"""Relative, of L_s in the page against :func:`~nucleation.theory.creep.lengths.stability_length`;
tested at random faults."""


@lru_cache(maxsize=1)
def in_page() -> dict[str, Any]:
    """What the page reads: ends, nodes of each axis, and the logarithms on them."""
    ends = np.array([np.log(ENDS["zeta_over_a"]), ENDS["nu"], ENDS["f"], _place(np.array(HEIGHTS))])
    nodes = [_chebyshev(low, high, n) for (low, high), n in zip(ends, NODES, strict=True)]
    weakening, nu, f, place = np.meshgrid(*nodes, indexing="ij")
    height = CENTRE * ((1.0 + place) / (1.0 - place)) ** (1.0 / POWER)
    logs = np.log(length_ratio(np.exp(weakening), nu, f, height))
    return {
        "ends": ENDS, "heights": HEIGHTS, "centre": CENTRE, "power": POWER,
        "precision": PRECISION, "nodes": [x.tolist() for x in nodes], "logs": float32(logs),
    }  # fmt: skip


def length_ratio(zeta_over_a: Array, nu: Array, f: Array, height: Array) -> Array:
    """L_s over L_c of blocks on a rigid base; height over the friction length. They broadcast."""
    fault: dict[str, Any] = {
        "shear_modulus": 1e9, "poisson_ratio": nu, "normal_stress": 1e6, "friction": f,
        "a": 0.02 / (1.0 + zeta_over_a), "b": 0.02, "slip_distance": 1e-6,
        "height": height * 0.05 / (1.0 - nu), "second_shear_modulus": np.inf,
    }  # fmt: skip
    return np.asarray(stability_length(**fault) / critical_length(**fault))


def _place(height: Array) -> Array:
    ratio = (height / CENTRE) ** POWER
    return (ratio - 1.0) / (ratio + 1.0)


def _chebyshev(low: float, high: float, number: int) -> Array:
    roots = np.cos(np.pi * (np.arange(number) + 0.5) / number)
    return 0.5 * (low + high) + 0.5 * (high - low) * roots
