"""L_c, L_s and the process zone as answers: they depend on the fault alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..model.hints import warn_of_implausible
from ..model.quantities import declared
from ..theory.creep.lengths import stability_answers
from ..theory.critical import critical_lengths, stability_reason
from ..theory.evaluation import evaluate
from ..theory.spectrum import Systems
from ..theory.status import BEYOND, STABLE, VALUE
from ..theory.values import FaultLike, where
from ..types import Array
from .answer import Answer

_HALVINGS = 60  # of the interval of log k in which the process zone is searched
_SPAN = 1e6  # ratio of the longest one of the search to L_b/2, and of that to the shortest

_CRITICAL = declared("critical length", "(0, inf) m")


def critical_length(fault: FaultLike) -> Answer:
    """L_c, above which wavelength homogeneous sliding is unstable."""

    def points(systems: Systems) -> NDArray:
        critical = critical_lengths(systems)
        found = np.empty((3, critical.size), dtype=object)
        found[:] = critical, [VALUE] * critical.size, [""] * critical.size
        for i in np.flatnonzero(np.isnan(critical)):
            found[1:, i] = STABLE, stability_reason(systems.at(np.array([i])))
        for i in np.flatnonzero(np.isinf(critical)):
            found[:, i] = (
                np.nan,
                BEYOND,
                "if there is one, it is longer than any that can be computed",
            )
        return found

    rows = evaluate(fault, points, rows=3, dtype=object)
    length = rows[:1].astype(float)[0]
    warn_of_implausible("critical_length", length, _CRITICAL)
    return Answer(length, length, length, rows[1], rows[2])


def stability_length(fault: FaultLike) -> Answer:
    """L_s, at which a creeping patch turns unstable; the range is the error of its modes."""
    length, error, status, reason = stability_answers(fault)
    low, high = length / (1.0 + error), length * (1.0 + error)
    return Answer(length, low, high, status, reason)


def process_zone(fault: FaultLike) -> Answer:
    """The process zone behind the front, which a mesh has to resolve.

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

    length = evaluate(fault, zones)[0]
    exists = np.isfinite(length)
    return Answer(
        length,
        length,
        length,
        where(exists, VALUE, STABLE),
        where(exists, "", "needs b > 0: friction grows with slip rate at every frequency"),
    )
