"""Behaviour of a weakening patch (creep, slow slip or event), for models of sequences of events.

The width W of the patch is compared with the smallest width with a growing mode, W_c
(:mod:`nucleation.theory.weakening_patch`). Below W_c the patch creeps. Above W_c slip is unstable
and grows into a limit cycle of slow slip or into an event. The transition between these two is
known from simulations (:mod:`.patch_outcomes`), not from a theory.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..model.material import Material
from ..theory.evaluation import bodies_differ
from ..theory.values import FaultLike, Values
from ..theory.weakening_patch import weakening_patch_values
from . import patch_outcomes
from .process_zone import process_zone

NO_WIDTH = "no W_c: the patch is stable, or its surroundings are not"

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
    outcome = ""
    if width is not None:
        untried = _untried(fault, width)
        outcome = _outcome(ratio, untried, _bounds(fault, outside_zeta, outside_a))
    return {
        "smallest_width": smallest,
        "width_ratio": ratio,
        "outcome": outcome,
        "cell_size": float(process_zone(fault)) / _CELLS,
    }


def _outcome(ratio: float, untried: str, bounds: tuple[float, float] | None) -> str:
    """The behaviour in words, by W/W_c, why it was not simulated, and the simulated bounds."""
    if math.isnan(ratio):
        return NO_WIDTH
    if ratio < 1.0:
        return "it creeps"
    if untried or bounds is None:
        return f"slow slip or events: {untried or 'such friction'} was not tried"
    return patch_outcomes.outcome(ratio, bounds)


def _bounds(
    fault: FaultLike, outside_zeta: Values, outside_a: Values | None
) -> tuple[float, float] | None:
    """Simulated bounds of slow slip and events for the friction of patch and surroundings."""
    a, zeta = fault.single("a"), fault.single("zeta")
    other_zeta = float(np.asarray(outside_zeta))
    other_a = a if outside_a is None else float(np.asarray(outside_a))
    frictions = zeta / a, -other_zeta / zeta
    if math.isclose(other_a, a):
        return patch_outcomes.bounds(patch_outcomes.OTHER_B, *frictions)
    if math.isclose(other_a + other_zeta, a + zeta):
        return patch_outcomes.bounds(patch_outcomes.OTHER_A, *frictions)
    return None


def _untried(fault: FaultLike, width: float) -> str:
    """What is unlike the simulations besides friction's constants, in words; empty if nothing."""
    if fault.plane == "stress":
        return "plane stress"
    if fault.zone_thickness is not None or np.any(bodies_differ(vars(fault))):
        return "a fault between different bodies"
    lowest = min(fault.single("height"), fault.single("second_height"))
    if lowest < patch_outcomes.ROOM * width:
        return f"a body lower than {patch_outcomes.ROOM:g} W"
    if fault.evolution != "aging":
        return f"the {fault.evolution} law"
    if fault.friction_law is not None and fault.friction_law.law != "dieterich_ruina":
        return f"the friction law {fault.friction_law.law}"
    if fault.velocity is None:
        return ""
    modulus, strength = (
        fault.single("shear_modulus"),
        fault.single("a") * fault.single("normal_stress"),
    )
    speed = Material(modulus, 0.0, fault.single("density")).shear_wave_speed
    rate = 2.0 * strength * speed / modulus / fault.single("velocity")
    low, high = patch_outcomes.DYNAMIC
    if low <= rate <= high:
        return ""
    return f"2 a sigma0 c_s/(mu V) = {rate:.2g}, outside {low:.2g} to {high:.2g},"
