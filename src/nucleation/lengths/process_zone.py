"""The process zone: the length over which friction weakens at the front of fast slip."""

from typing import Any

import numpy as np

from ..theory.evaluation import evaluate
from ..theory.spectrum import Systems
from ..theory.values import FaultLike
from ..types import Array

_HALVINGS = 60  # of the interval of log k in which it is searched
_SPAN = 1e6  # ratio of the longest one of the search to L_b/2, and of that to the shortest


def process_zone(fault: FaultLike) -> Any:
    """The process zone (m) of each fault, NaN where b is not positive.

    The wavelength over 2 pi at which the stiffness of the bodies is ``b sigma0/D``: ``L_b/2``
    between identical half-spaces, ``sqrt(2 H L_b)`` in a thin layer on a rigid body, with
    ``L_b = mu* D/(b sigma0)``. That of half-spaces is customarily ``(9 pi/32) L_b`` (Lapusta and
    Liu, 2009), which is larger.
    """

    def zones(systems: Systems) -> Array:
        b = np.where(systems.b > 0.0, systems.b, np.nan)
        thick = systems.softness / b
        low = 1.0 / (_SPAN * thick)
        high = _SPAN / thick
        for _ in range(_HALVINGS):
            middle = np.sqrt(low * high)
            stiff = systems.load_and_coupling(middle)[0] > b
            low = np.where(stiff, low, middle)
            high = np.where(stiff, middle, high)
        return 1.0 / low[None]

    return evaluate(fault, zones)[0]
