"""Steady creep of a patch under its loading: slip rate, slip and normal stress."""

from typing import NamedTuple

import numpy as np

from ...types import Array
from .response import PatchResponse

SLOWEST = 1e-6  # least slip rate over V: friction's logarithm diverges at rest
NEAR = 2  # places next to the front that determine the share of the singularity


class Creep(NamedTuple):
    """A creeping patch, at the angles of its modes.

    Slip rates are relative to `fastest`: V at an edge that is pushed, else the largest one.
    """

    response: PatchResponse  # of the bodies, and L
    slip_rate: Array  # over `fastest`, (N,)
    normal_stress: Array  # compression over sigma0, (N,)
    loaded: float  # imposed at L: displacement of the edge over D, or shear stress over sigma0
    fastest: float = 1.0  # over V


def creep(
    response: PatchResponse,
    friction: float,
    load_rate: float | None = None,
) -> Creep:
    """The creep of a patch under the loading of a response.

    Returns: Slip rate and normal stress at the angles of the modes.

    Slip rate: the strength is constant. So ``(K1 + f S2) v = 0`` with ``v(0) = V``, or ``(K1 + f
    S2) v`` is the rate of the stress. Slip: the patch is loaded to its strength, ``-(K1 + f S2) u =
    f sigma0``, and the edge has the displacement for which the front has no singularity. That slip
    has changed the normal stress by ``S2 u``. A stress that loads a uniform interface evenly
    reaches the strength everywhere at once, and u = 0.
    """
    slip = edge_slip(response, friction, friction)
    rates = response.modes.values @ slip.rates
    fastest = 1.0
    if load_rate is not None:
        scale = float(rates.max())
        rates = rates / scale
        fastest = scale * load_rate
    return Creep(
        response=response,
        slip_rate=np.maximum(rates, SLOWEST),
        normal_stress=1.0 + response.normal @ slip.slip,
        loaded=slip.loaded,
        fastest=fastest,
    )


class EdgeSlip(NamedTuple):
    """Coefficients of slip rate and slip in the modes, and the edge's displacement."""

    rates: Array
    slip: Array
    loaded: float


def edge_slip(
    response: PatchResponse,
    friction: Array | float,
    strength: Array | float,
) -> EdgeSlip:
    """The modes' coefficients of the slip rate over V and of the slip over D.

    Where slip changes the normal stress, the front's singularity is no square root, and the edge is
    not regular. An error of alternating sign at neighbouring places remains, which
    :attr:`~nucleation.theory.creep.response.Modes.smoothing` removes from the result.

    Returns: Coefficients of shape (N + 1,).
    """
    matrix = response.coupled(friction)
    sines: Array = matrix[:, 1:]
    by_edge = matrix[:, 0]
    by_strength = np.broadcast_to(strength, by_edge.shape)
    loads = np.stack([by_edge, by_strength], axis=1)
    rates, held = -np.linalg.solve(sines, loads).T
    rates = np.append(1.0, rates)
    held = np.append(0.0, held)
    near = response.modes.values[:NEAR]
    squares = response.modes.theta[:NEAR] ** 2
    ratio = (near @ held) / (near @ rates)
    loaded = -float(
        np.polyfit(
            squares,
            ratio,
            NEAR - 1,
        )[-1]
    )
    smoothing = response.modes.smoothing
    return EdgeSlip(
        rates=smoothing * rates,
        slip=smoothing * (loaded * rates + held),
        loaded=loaded,
    )
