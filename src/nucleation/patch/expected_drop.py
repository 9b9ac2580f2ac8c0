"""The drop that a user's fault is to be expected to have, by theory alone."""

from typing import NamedTuple

import numpy as np

from ..model.parameters import Parameters
from ..model.perturbation import Perturbation
from ..theory.creep.lengths import NoPatch
from .continued import trend
from .delay import ClosedForm, Drop, growth
from .mode_history import ModeHistory, mode_history

LATEST_GROWTH = 0.85  # of the longest patch followed, up to which L_s leaves something to trend
STRONGEST = 0.02  # eps_eff beyond which bursts that come to rest make the drop late
SLOWEST_GROWTH = 4.0  # growth in a period at the drop, below which they do so too
NEAR_END = 0.6  # part of the block's length up to which its far end is not felt


class NoDrop(ValueError):
    """The law can't say where the fault drops."""


class ExpectedDrop(NamedTuple):
    """What is to be expected of a fault under its declared perturbation; lengths in m."""

    drop: Drop
    closed_form: ClosedForm
    doubt: str  # why the law should not be relied upon here, empty if it should

    @property
    def trusted(self) -> bool:
        """Whether the law holds as far as its own numbers tell."""
        return not self.doubt


def expected_drop(parameters: Parameters, theory_length: float) -> ExpectedDrop:
    """L_s and the length at the drop of a fault under its declared perturbation.

    Mesh and steps do not matter; `theory_length` is L_c (m).

    Raises
    ------
    NoDrop
        Nothing is perturbed, or no patch turns unstable.
    ParameterError
        If it is no uniform fault that is pushed at its edge.
    """
    parameters.require_edge("the law of the drop")
    declared = parameters.perturbation
    if not declared.acts:
        raise NoDrop("nothing is perturbed: without a strength the drop depends on round-off")
    try:
        history = mode_history(parameters, theory_length)
    except NoPatch as error:
        raise NoDrop(str(error)) from None
    found = _expected(history, declared)
    if not found.doubt and found.drop.high > history.length[-1]:
        return found._replace(
            doubt="the drop lies beyond the patches whose mode could be followed, "
            f"{history.length[-1] / theory_length:.2g} L_c"
        )
    return found


def _expected(history: ModeHistory, declared: Perturbation) -> ExpectedDrop:
    found = growth(history, declared)
    drop, closed = found.drop(declared.strength), found.closed_form(history, declared.strength)
    doubt = ""
    if closed.effective >= STRONGEST:
        doubt = (
            f"the perturbation is strong (eps_eff = {closed.effective:.2g}, the law holds below "
            f"{STRONGEST:g}): bursts that come to rest may make the drop later"
        )
    elif closed.stability_length > LATEST_GROWTH * history.length[-1]:
        doubt = (
            "growth begins near the longest patch whose mode could be followed, at "
            f"{closed.stability_length / history.length[-1]:.2g} of its length: how it goes on is "
            "not known"
        )
    elif (grown := _growth_in_period(history, drop.length)) < SLOWEST_GROWTH:
        doubt = (
            f"the mode grows by a factor of {grown:.2g} in a period where it is as large as the "
            f"loading (the law holds from {SLOWEST_GROWTH:g} on): bursts that come to rest may "
            "make the drop later"
        )
    elif drop.high > NEAR_END * history.parameters.geometry.length:
        doubt = (
            f"the patch would be {drop.high / history.parameters.geometry.length:.2g} of the block "
            "long, whose far end it feels"
        )
    elif not np.isfinite([drop.length, drop.low, drop.high]).all():
        doubt = "the drop lies beyond the lengths that the mode's trends are carried on to"
    return ExpectedDrop(drop, closed, doubt)


def _growth_in_period(history: ModeHistory, length: float) -> float:
    """The mode's growth in one of its periods at a patch length (m), by the trends."""
    rate, turn = (
        float(trend(history, part)(np.array([length]))[0])
        for part in (history.rate.real, history.rate.imag)
    )
    return float(np.exp(2.0 * np.pi * rate / turn)) if turn > 0.0 else float("inf")
