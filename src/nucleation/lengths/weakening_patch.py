"""Behaviour of a weakening patch (creep, slow slip or event), for models of sequences of events.

The width W of the patch is compared with the smallest width that nucleates, W_c
(:mod:`nucleation.theory.weakening_patch`). Below W_c the patch creeps. Above W_c slip is unstable
and grows into a limit cycle of slow slip or into an event. The transition between these two is
known from simulations (docs/creeping_patch.md), not from a theory.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..theory.fault import FaultParameters, Values
from ..theory.spectrum import Systems
from ..theory.weakening_patch import weakening_patch_values
from ..types import Array
from .length import number

NUCLEATES = 1.3
"""Least W/W_c at which all simulated patches nucleated; some slipped slowly up to 1.22."""

_CELLS = 3.0
"""Cells in a process zone that resolve it (Day and others, 2005)."""

_HALVINGS = 60  # of the interval of log k in which the process zone is searched
_SPAN = 1e6  # ratio of the longest process zone of the search to L_b/2, and of that to the shortest


def patch_answer(
    fault: FaultParameters,
    outside_zeta: Values,
    outside_a: Values | None = None,
    width: float | None = None,
) -> dict[str, Any]:
    """The behaviour of a weakening patch among strengthening surroundings.

    Parameters
    ----------
    fault : FaultParameters
        One fault, with the friction of the patch.
    outside_zeta, outside_a : float
        zeta and a of the surroundings; a is that of the patch by default.
    width : float, optional
        Width W (m) of the patch.

    Returns
    -------
    dict
        ``smallest_width``, W_c (m), NaN if no patch nucleates; ``width_ratio``, W/W_c, NaN without
        a width; ``outcome``, the behaviour in words, empty without a width; ``cell_size``, the
        largest cell (m) that resolves the process zone, NaN if there is none.

    Raises
    ------
    ParameterError
        If a parameter is outside its range.
    """
    smallest = float(weakening_patch_values(fault, outside_zeta, outside_a))
    ratio = math.nan if width is None else width / smallest
    return {
        "smallest_width": smallest,
        "width_ratio": ratio,
        "outcome": "" if width is None else outcome(ratio),
        "cell_size": process_zone(fault) / _CELLS,
    }


def outcome(width_ratio: float) -> str:
    """The behaviour of a patch in words, from its width over W_c."""
    if math.isnan(width_ratio):
        return "no W_c: the patch is stable, or its surroundings are not"
    if width_ratio < 1.0:
        return "it creeps"
    if width_ratio < NUCLEATES:
        return "it slips slowly or nucleates"
    return "it nucleates"


def process_zone(fault: FaultParameters) -> float:
    """Length (m) over which friction weakens at the front of fast slip, of one fault.

    The wavelength over 2 pi at which the stiffness of the bodies is ``b sigma0/D``: ``L_b/2``
    between identical half-spaces, ``sqrt(2 H L_b)`` in a thin layer on a rigid body, with
    ``L_b = mu* D/(b sigma0)``. That of half-spaces is customarily ``(9 pi/32) L_b`` (Lapusta and
    Liu, 2009), which is larger. NaN where b is not positive.
    """

    def zones(systems: Systems) -> Array:
        thick = systems.softness / systems.b
        low = 1.0 / (_SPAN * thick)
        high = _SPAN / thick
        for _ in range(_HALVINGS):
            middle = np.sqrt(low * high)
            stiff = systems.load_and_coupling(middle)[0] > systems.b
            low = np.where(stiff, low, middle)
            high = np.where(stiff, middle, high)
        return 1.0 / low[None]

    if float(number(fault, "b")) <= 0.0:
        return math.nan
    return float(fault.evaluate(zones)[0])
