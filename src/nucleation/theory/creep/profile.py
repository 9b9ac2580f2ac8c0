"""How a patch creeps: slip rate, stress and friction along it, as its loading makes them.

Lengths along the fault in m, slip in D, slip rates in V, stresses in sigma0, times in D/V.
"""

from typing import NamedTuple

import numpy as np

from ...types import Array
from .modes import Response

SLOWEST = 1e-6  # slip rates below this part of V do not count: friction's logarithm has no end
NEAR = 2  # places next to the front from which the singularity's share is found


class Creep(NamedTuple):
    """A patch that creeps, at the angles of its modes.

    Slip rates count in `fastest`: V at an edge that is pushed, else that of the fastest place.
    """

    response: Response  # of the bodies, and L
    slip_rate: Array  # over `fastest`, (N,)
    normal_stress: Array  # compression over sigma0, (N,)
    loaded: float  # imposed at L: displacement of the edge over D, or shear stress over sigma0
    fastest: float = 1.0  # over V


def creep(response: Response, friction: float, load_rate: float | None = None) -> Creep:
    """The creep of a patch under the loading of a response.

    Parameters
    ----------
    friction : f, the strength over the normal stress.
    load_rate : rise of the shear stress that loads the patch, over ``sigma0 V/D``; by default it is
        an edge that is pushed at V.

    Notes
    -----
    Slip rate: the strength does not change. So ``(K1 + f S2) v = 0`` with ``v(0) = V``, or ``(K1 +
    f S2) v`` is the rate of the stress. Slip: the patch is loaded to its strength, ``-(K1 + f S2) u
    = f sigma0``, and the edge has moved as far as it takes for a front without a singularity. That
    slip has changed the normal stress by ``S2 u``. A stress that loads all of a uniform interface
    has reached the strength everywhere when it does so in the patch, and u = 0.
    """
    slip, fastest = edge_slip(response, friction, friction), 1.0
    rates, scale = response.modes.values @ slip.rates, 1.0
    if load_rate is not None:
        scale = float(rates.max())
        fastest = scale * load_rate
    rates, normal = np.maximum(rates / scale, SLOWEST), 1.0 + response.normal @ slip.slip
    return Creep(response, rates, normal, slip.loaded, fastest)


class EdgeSlip(NamedTuple):
    """Coefficients of slip rate and slip in the modes, and the edge's displacement."""

    rates: Array
    slip: Array
    loaded: float


def edge_slip(response: Response, friction: float, strength: Array | float) -> EdgeSlip:
    """The modes' coefficients, (N + 1,) of the slip rate over V and of the slip over D.

    Where slip changes the normal stress, the front's singularity is no square root, and neither is
    the edge regular: an error of alternating sign at neighbouring places is left, which is taken
    out of the result (:attr:`~.modes.Modes.smoothing`).
    """
    matrix = response.coupled(friction)
    loads = np.stack([matrix[:, 0], np.broadcast_to(strength, matrix.shape[:1])], axis=1)
    rates, held = -np.linalg.solve(matrix[:, 1:], loads).T
    rates, held = np.append(1.0, rates), np.append(0.0, held)
    near = response.modes.values[:NEAR]
    squares = response.modes.theta[:NEAR] ** 2
    ratio = (near @ held) / (near @ rates)
    loaded = -float(np.polyfit(squares, ratio, NEAR - 1)[-1])
    smoothing = response.modes.smoothing
    return EdgeSlip(smoothing * rates, smoothing * (loaded * rates + held), loaded)
