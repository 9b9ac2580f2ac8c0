"""The expected drop of a user's fault, by theory alone."""

import dataclasses
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..model.linearised import interface_state
from ..model.parameters import Geometry, Parameters
from ..theory.creep.lengths import stability_length_of
from ..theory.creep.patches import Patches
from ..theory.creep.runaway import ERROR, runaway_point
from ..theory.critical import run_length
from ..theory.status import UNKNOWN, VALUE, NoLength
from .continued import trend
from .delay import ClosedForm, Drop, growth
from .mode_history import ModeHistory, mode_history

LATEST_GROWTH = 0.85  # over the longest patch followed, up to which L_s leaves lengths for a trend
STRONGEST = 0.02  # eps_eff beyond which bursts that come to rest make the drop late
SLOWEST_GROWTH = 4.0  # growth in a period at the drop, below which they do so too
WEAK = 2.0  # zeta/a below which a patch may slip slowly up to L_run
LATER = 0.10
"""Relative delay of the drop behind L_run where the front is fast. Simulated drops in thin blocks
are from 1 % below to 10 % above L_run; below, the error of L_run itself counts."""

SLIP_BURSTS = 0.3  # zeta/a below which, by the slip law, bursts hardly lower the force
CONSTANT = 0.05  # relative change of L_s by friction's scales up to which a and b count as constant
NEAR_END = 0.6  # patch length over the block's up to which a thin block's far end has no effect
THICK = 0.5  # height over the patch's length above which a block is thick
THICK_REACH = 0.2  # (L + H) over the block's length up to which a thick block's far end has none


class ExpectedDrop(NamedTuple):
    """The expected drop of a fault under its declared perturbation; lengths in m."""

    stability_length: float  # L_s
    drop: Drop
    closed_form: ClosedForm
    doubt: str  # why the answer is uncertain, empty if it is not
    runaway_length: float = math.nan  # L_run where friction weakens little, else NaN
    runaway_status: str = VALUE  # "value", "stable", "beyond" or "unknown"
    runaway_reason: str = ""  # why there is no L_run, empty where there is

    @property
    def length(self) -> float:
        """The length (m) at the drop: the law's median, or L_run if slow slip lasts up to it."""
        return float(np.fmax(self.drop.length, self.runaway_length))

    @property
    def low(self) -> float:
        """The least expected length (m) at the drop."""
        return float(np.fmax(self.drop.low, self.runaway_length * (1.0 - ERROR)))

    @property
    def high(self) -> float:
        """The largest expected length (m) at the drop."""
        return float(np.fmax(self.drop.high, self.runaway_length * (1.0 + LATER)))

    @property
    def slips_slowly(self) -> bool:
        """Whether the patch slips in a limit cycle before the drop, which comes at L_run."""
        return bool(self.runaway_length > self.drop.length)

    @property
    def trusted(self) -> bool:
        """Whether the answer has no doubt."""
        return not self.doubt


def expected_drop(parameters: Parameters) -> ExpectedDrop:
    """L_s and the length at the drop of a fault under its declared perturbation.

    Parameters
    ----------
    parameters : Parameters
        Of the fault; mesh and steps have no effect.

    Returns
    -------
    ExpectedDrop
        The lengths, and why they are uncertain if they are.

    Raises
    ------
    NoLength
        If nothing is perturbed, or no patch turns unstable.
    ParameterError
        If it is no uniform fault that is pushed at its edge.

    Examples
    --------
    >>> from nucleation.api import Geometry, Parameters, Perturbation
    >>> parameters = Parameters(
    ...     geometry=Geometry(height=0.005, length=0.9),
    ...     perturbation=Perturbation(kind="normal_load", strength=1e-4),
    ... )
    >>> found = expected_drop(parameters)
    >>> round(found.stability_length, 3), round(found.length, 2)
    (0.134, 0.16)
    """
    parameters.require_edge("the law of the drop")
    declared = parameters.perturbation
    if not declared.acts:
        raise NoLength("nothing is perturbed: without a strength the drop depends on round-off")
    critical = run_length(parameters, interface_state(parameters))
    history = mode_history(parameters, critical)
    found = growth(history, declared)
    stable = stability_length_of(parameters, critical)
    runaway, status, reason = _runaway_length(parameters, critical, stable)
    known = ExpectedDrop(
        stability_length=stable,
        drop=found.drop(declared.strength),
        closed_form=found.closed_form(history, declared.strength),
        doubt="",
        runaway_length=runaway,
        runaway_status=status,
        runaway_reason=reason,
    )
    return known._replace(doubt="; ".join(_doubts(history, known, critical)))


def _runaway_length(
    parameters: Parameters,
    critical: float,
    stable: float,
) -> tuple[float, str, str]:
    """L_run (m) with status and reason; NaN where weakening is strong or no patch runs away.

    The integration with the friction law takes longer: it is for laws with other L_s (`stable`, m)
    than constant a and b.
    """
    interface = interface_state(parameters)
    if interface.zeta >= WEAK * interface.a:
        ratio = interface.zeta / interface.a
        return math.nan, UNKNOWN, f"it is computed for zeta/a < {WEAK:g}: zeta/a = {ratio:.3g}"
    patches = Patches.of(parameters)
    constant = stability_length_of(parameters, critical, constant=True)
    if abs(stable / constant - 1.0) < CONSTANT:
        patches = dataclasses.replace(patches, law=None)
    try:
        length = runaway_point(patches, critical)
    except NoLength as none:
        return math.nan, none.status, str(none)
    return length, VALUE, ""


def _doubts(
    history: ModeHistory,
    known: ExpectedDrop,
    critical: float,
) -> Iterator[str]:
    """Why the answer is uncertain, a text for each reason."""
    if known.slips_slowly:
        yield from _doubts_of_runaway(history)
    else:
        yield from _doubts_of_law(history, known.drop, known.closed_form, critical)
    yield from _doubts_of_block(history, known)


def _doubts_of_runaway(history: ModeHistory) -> Iterator[str]:
    """Why L_run is uncertain: few bodies were compared, and a burst may hardly lower the force."""
    own = history.parameters
    below = own.below
    interface = interface_state(own)
    ratio = interface.zeta / interface.a
    if own.friction.evolution == "slip" and ratio < SLIP_BURSTS:
        yield (
            f"by the slip law and zeta/a = {ratio:.3g}, below {SLIP_BURSTS:g}, bursts hardly lower "
            "the force: in simulations it did not drop up to 1.3 times this length"
        )
    if below is not None and (below.material, below.geometry) != (own.material, own.geometry):
        yield (
            "L_run was compared with simulations on a rigid base and between equal bodies, but not "
            "between different ones"
        )


def _doubts_of_law(
    history: ModeHistory,
    drop: Drop,
    closed: ClosedForm,
    critical: float,
) -> Iterator[str]:
    """Why the law of the drop is uncertain."""
    longest = history.length[-1]
    if closed.effective >= STRONGEST:
        yield (
            f"the perturbation is strong (eps_eff = {closed.effective:.2g}, the law holds below "
            f"{STRONGEST:g}): bursts that come to rest may make the drop later"
        )
    if closed.front_length > LATEST_GROWTH * longest:
        yield (
            "growth begins near the longest patch with a mode that could be followed, at "
            f"{closed.front_length / longest:.2g} of its length: its further growth is not known"
        )
    if not np.isfinite([drop.length, drop.low, drop.high]).all():
        yield "the drop is beyond the lengths to which the mode's trends are continued"
        return
    grown = _growth_in_period(history, drop.length)
    if grown < SLOWEST_GROWTH:
        yield (
            f"the mode grows by a factor of {grown:.2g} in a period where it is as large as the "
            f"loading (the law holds from {SLOWEST_GROWTH:g} on): bursts that come to rest may "
            "make the drop later"
        )
    if drop.high > longest:
        yield (
            "the drop is beyond the patches with a mode that could be followed, "
            f"{longest / critical:.2g} L_c"
        )


def _doubts_of_block(
    history: ModeHistory,
    known: ExpectedDrop,
) -> Iterator[str]:
    """Whether the patch feels the far end of its block when it drops."""
    geometry = history.parameters.geometry
    highest = np.fmax(known.drop.high, known.runaway_length)
    if highest > NEAR_END * geometry.length:
        yield (
            f"the patch would be {highest / geometry.length:.2g} of the block long, and would feel "
            "the block's far end"
        )
    elif feels_far_end(known.length, geometry):
        reach = (known.length + geometry.height) / geometry.length
        yield (
            f"the block is thick: its height and the patch together are {reach:.2g} of its length "
            f"(the law was compared up to {THICK_REACH:g}), so that the patch feels the far end; "
            "simulated drops came 3 to 10 % later"
        )


def feels_far_end(
    length: float,
    geometry: Geometry,
) -> bool:
    """Whether a patch in a thick block feels the far end.

    Parameters
    ----------
    length : float
        Patch length (m).
    geometry : Geometry
        Of the block.

    Returns
    -------
    bool
        False for thin blocks.

    Notes
    -----
    A thin block's end has no effect at a distance of some heights. In a thick one its effect
    decreases with the distance over ``L + H``: simulated drops in blocks of H = 1.2 m that are 8, 6
    and 4 L_c long came 2.9, 5.8 and 9.8 % later than by the law, at 0.26, 0.34 and 0.51.
    """
    is_thick = geometry.height > THICK * length
    return is_thick and length + geometry.height > THICK_REACH * geometry.length


def _growth_in_period(
    history: ModeHistory,
    length: float,
) -> float:
    """The mode's growth in one of its periods at a patch length (m), by the trends."""
    at = np.array([length])
    rate = float(trend(history, history.rate.real)(at)[0])
    frequency = float(trend(history, history.rate.imag)(at)[0])
    if not frequency > 0.0:
        return math.inf
    return float(np.exp(2.0 * np.pi * rate / frequency))
