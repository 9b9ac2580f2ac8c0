"""Behaviour of a weakening patch (creep, slow slip or event), for models of sequences of events.

The width W of the patch is compared with the smallest width that nucleates, W_c
(:mod:`nucleation.theory.weakening_patch`). Below W_c the patch creeps. Above W_c slip is unstable
and grows into a limit cycle of slow slip or into an event. The transition between these two is
known from simulations (docs/creeping_patch.md), not from a theory.
"""

from __future__ import annotations

import math
from typing import Any

from ..theory.values import FaultLike, Values
from ..theory.weakening_patch import weakening_patch_values
from .process_zone import process_zone

NUCLEATES = 1.3
"""Least W/W_c at which all simulated patches nucleated; some slipped slowly up to 1.22."""

_CELLS = 3.0
"""Cells in a process zone that resolve it (Day and others, 2005)."""


def patch_answer(
    fault: FaultLike,
    outside_zeta: Values,
    outside_a: Values | None = None,
    width: float | None = None,
) -> dict[str, Any]:
    """The behaviour of a weakening patch among strengthening surroundings.

    Parameters
    ----------
    fault : Fault
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
        "cell_size": float(process_zone(fault)) / _CELLS,
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
