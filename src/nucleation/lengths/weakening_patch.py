"""Behaviour of a weakening patch (creep, slow slip or event), for models of sequences of events.

The width W of the patch is compared with the smallest width with a growing mode, W_c
(:mod:`nucleation.theory.weakening_patch`). Below W_c the patch creeps. Above W_c slip is unstable
and grows into a limit cycle of slow slip or into an event. The transition between these two is
known from simulations, not from a theory.

``patch_outcomes.csv`` has the simulated frictions, and the widths over W_c at which slow slip ends
and events begin. `make reference` makes it from the study ``weakening_patches``. Between simulated
frictions slow slip ends at the least width of the neighbours, and events begin at the greatest.
"""

from __future__ import annotations

import csv
import functools
import importlib.resources
import math
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from ..model.material import Material
from ..theory.evaluation import bodies_differ
from ..theory.values import FaultLike, Values
from ..theory.weakening_patch import weakening_patch_values

TABLE = "patch_outcomes.csv"

OTHER_B = "zeta"
OTHER_A = "a"
"""How the surroundings of a simulated patch differ: zeta by another b, or a at the same b."""

DYNAMIC = (705.0, 1.41e8)
"""``2 a sigma0 c_s/(mu V)`` of the simulations, the slip rate from which it is an event, over V."""

DENSITY = 1200.0
"""Mass density (kg/m^3) of the simulated bodies."""

SETTING = (
    f"aging law, {DENSITY:g} kg/m^3, events above 2 a sigma0 c_s/mu = {DYNAMIC[0]:.3g} to "
    f"{DYNAMIC[1]:.3g} V"
)
"""The simulations in words."""

ROOM = 2.6
"""Least height of the simulated bodies over the width of the patch."""

_ROUNDING = 1e-6  # relative, of zeta/a and r

NO_WIDTH = "no W_c: the patch is stable, or its surroundings are not"

BY_VELOCITY = "slow slip or events: it depends on the slip rate V; give the velocity (--velocity)"


class Simulated(NamedTuple):
    """Simulations with one friction: zeta/a of the patch, and r = -zeta_out/zeta."""

    varies: str
    zeta_over_a: float
    strengthening: float
    slow_slip_up_to: float  # W/W_c below which no event was simulated, at any V
    events_from: float  # W/W_c above which all simulations had events, at any V


@functools.cache
def simulated() -> tuple[Simulated, ...]:
    """All rows of the table."""
    table = importlib.resources.files(__package__) / TABLE
    with table.open(encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    return tuple(
        Simulated(row["varies"], *(float(row[name]) for name in Simulated._fields[1:]))
        for row in rows
    )


def bounds(varies: str, zeta_over_a: float, strengthening: float) -> tuple[float, float] | None:
    """Widths over W_c at which slow slip ends and events begin; None beyond the simulations."""
    corners: list[Simulated] = []
    rows = [row for row in simulated() if row.varies == varies]
    for ratio in _neighbours({row.zeta_over_a for row in rows}, zeta_over_a):
        own = {row.strengthening: row for row in rows if row.zeta_over_a == ratio}
        around = _neighbours(own, strengthening)
        if not around:
            return None
        corners += [own[r] for r in around]
    if not corners:
        return None
    slow = min(row.slow_slip_up_to for row in corners)
    return slow, max(row.events_from for row in corners)


def _neighbours(values: Iterable[float], wanted: float) -> set[float]:
    """The nearest values below and above; none if one is missing."""
    ordered = sorted(values)
    below = [value for value in ordered if value <= wanted * (1.0 + _ROUNDING)]
    above = [value for value in ordered if value >= wanted * (1.0 - _ROUNDING)]
    if not below or not above:
        return set()
    return {below[-1], above[0]}


def patch_answer(
    fault: FaultLike,
    outside_zeta: Values,
    outside_a: Values | None = None,
    width: float | None = None,
) -> dict[str, Any]:
    """The behaviour of a weakening patch of a width (m) among strengthening surroundings.

    W_c (m) and W/W_c, NaN if no patch nucleates or without a width; and the behaviour in words.
    """
    smallest = float(weakening_patch_values(fault, outside_zeta, outside_a))
    ratio = math.nan if width is None else width / smallest
    outcome = ""
    if width is not None:
        untried = _untried(fault, width)
        bounds = _bounds(fault, outside_zeta, outside_a)
        outcome = _outcome(ratio, untried, bounds, fault.velocity is not None)
    return {"smallest_width": smallest, "width_ratio": ratio, "outcome": outcome}


def _outcome(
    ratio: float, untried: str, bounds: tuple[float, float] | None, velocity_known: bool
) -> str:
    """The behaviour in words, by W/W_c, why it was not simulated, and the simulated bounds."""
    if math.isnan(ratio):
        return NO_WIDTH
    if ratio < 1.0:
        return "it creeps"
    if untried or bounds is None:
        return f"slow slip or events: {untried or 'such friction'} was not tried"
    if not velocity_known:
        return BY_VELOCITY
    slow, event = bounds
    if ratio <= slow:
        return "slow slip; no event was simulated"
    if ratio >= event:
        return f"events, simulated from {event:.3g} W_c on"
    if slow > 1.0:
        return f"slow slip or events: either between {slow:.3g} and {event:.3g} W_c"
    return f"slow slip or events: either below {event:.3g} W_c"


def _bounds(
    fault: FaultLike, outside_zeta: Values, outside_a: Values | None
) -> tuple[float, float] | None:
    """Simulated bounds of slow slip and events for the friction of patch and surroundings."""
    a, zeta = fault.single("a"), fault.single("zeta")
    other_zeta = float(np.asarray(outside_zeta))
    other_a = a if outside_a is None else float(np.asarray(outside_a))
    frictions = zeta / a, -other_zeta / zeta
    if math.isclose(other_a, a):
        return bounds(OTHER_B, *frictions)
    if math.isclose(other_a + other_zeta, a + zeta):
        return bounds(OTHER_A, *frictions)
    return None


def _untried(fault: FaultLike, width: float) -> str:
    """What is unlike the simulations besides friction's constants, in words; empty if nothing."""
    if fault.plane == "stress":
        return "plane stress"
    if fault.zone_thickness is not None or np.any(bodies_differ(vars(fault))):
        return "a fault between different bodies"
    lowest = min(fault.single("height"), fault.single("second_height"))
    if lowest < ROOM * width:
        return f"a body lower than {ROOM:g} W"
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
    low, high = DYNAMIC
    if low <= rate <= high:
        return ""
    return f"2 a sigma0 c_s/(mu V) = {rate:.2g}, outside {low:.2g} to {high:.2g},"
