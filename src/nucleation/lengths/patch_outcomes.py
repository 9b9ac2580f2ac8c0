"""Outcomes of simulated weakening patches: creep, slow slip, or an event.

``patch_outcomes.csv`` has the simulated frictions, and the widths over W_c at which slow slip ends
and events begin. `make reference` makes it from the study ``weakening_patches``. Between simulated
frictions slow slip ends at the least width of the neighbours, and events begin at the greatest.
"""

import csv
import functools
import importlib.resources
from collections.abc import Iterable
from typing import NamedTuple

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
        Simulated(
            row["varies"],
            float(row["zeta_over_a"]),
            float(row["strengthening"]),
            float(row["slow_slip_up_to"]),
            float(row["events_from"]),
        )
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


def outcome(width_ratio: float, found: tuple[float, float]) -> str:
    """The behaviour of a patch with a growing mode, by its width over W_c and the bounds."""
    slow, event = found
    if width_ratio <= slow:
        return "slow slip; no event was simulated"
    if width_ratio >= event:
        return f"events, simulated from {event:.3g} W_c on"
    if slow > 1.0:
        return f"slow slip or events: either between {slow:.3g} and {event:.3g} W_c"
    return f"slow slip or events: either below {event:.3g} W_c"
