"""The runaway length L_run: the shortest patch whose slow slip has no end but an event.

Where friction weakens little, the oscillation that begins at the stability length L_s saturates: a
patch that is longer slips in a limit cycle of slow slip, faster and slower than V in turns. The
cycle ceases to exist at a length L_run, and there the force drops, whatever the noise.

A patch of fixed length in steady creep ``v_c(x)`` with the whole logarithmic law obeys, per sigma0,

    -(K1 + f S2)(v - v_c) = s (a dv/dt / v + b dphi/dt / phi),      dphi/dt = g(phi v/D),

with the compression s over sigma0 and the stiffness of :mod:`.modes`. It is integrated from a small
perturbation of the state; L_run is the shortest L whose slip rate grows beyond all bounds. In a
thin layer it depends on zeta/a alone, and is about ``1.9 (1/pi) sqrt(b/zeta) L_c``: the factor is 1
where the strain energy of a patch just pays for the fracture energy of its front.
"""

import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from ...model.friction.law import Friction
from ...types import Array
from ..arrays import fault_of, named
from ..crossings import largest_crossings
from ..fault import Fault, Values, takes_fault
from ..spectrum import Systems
from ..status import BEYOND
from .lengths import NoPatch, Patches, stability_point
from .modes import MODES

LONGEST = 3.0  # patches up to this multiple of L_c are tried
PRECISION = 4e-3  # relative, of L_run
ERROR = 0.03  # relative, of L_run, by modes, duration and perturbation
PERTURBATION = 0.05  # of log(phi) at the start, in the middle of the patch
DURATION = 1500.0  # over D/V, after which a cycle is one
FAST = 300.0  # slip rate over V beyond which a burst is an event
TOLERANCE = 1e-5, 1e-6  # of the integration, relative and absolute, of the logarithms


def runs_away(patches: Patches, length: float, evolution: str = "aging") -> bool:
    """Whether the slow slip of a patch of a length (m) accelerates without bound.

    `patches` have constant a and b; the evolution is that of the state, aging or slip.

    Raises
    ------
    NoPatch
        If the creep takes all of the compression somewhere.
    """
    creep = patches.creep(length, MODES)
    if creep.normal_stress.min() <= 0.0:
        raise NoPatch(f"the creep opens the fault at a patch length of {length:.4g} m")
    one, own = patches.one, creep.response.modes
    friction, a, zeta = (float(x[0]) for x in (one.friction, one.a, one.zeta))
    stiffness = creep.response.coupled(friction)[:, 1:] @ own.inverse
    stiffness = stiffness / creep.normal_stress[:, None]
    steady = creep.slip_rate
    count = steady.size
    evolve = Friction(evolution=evolution, characteristic_slip_distance=1.0).evolution_law.growth

    def rates(_: float, logs: Array) -> Array:
        v, log_state = np.exp(logs[:count]), logs[count:]
        aging = evolve(v * np.exp(log_state)) * np.exp(-log_state)
        accelerating = (-stiffness @ (v - steady) - (a + zeta) * aging) / a
        return np.concatenate([accelerating, aging])

    def event(_: float, logs: Array) -> float:
        return float(logs[:count].max() - math.log(FAST))

    event.terminal = True  # type: ignore[attr-defined]
    start = np.concatenate([np.log(steady), -np.log(steady)])
    start[count:] += PERTURBATION * np.sin(np.pi * np.cos(own.theta))
    relative, absolute = TOLERANCE
    found = solve_ivp(
        rates, (0.0, DURATION), start, "LSODA", rtol=relative, atol=absolute, events=event
    )
    return bool(found.t_events[0].size)


def runaway_point(patches: Patches, critical: float, evolution: str = "aging") -> float:
    """L_run (m) of one fault whose L_c (m) is `critical`.

    Raises
    ------
    NoPatch
        If no patch is unstable, none up to ``LONGEST L_c`` runs away, or its creep opens the fault.
    """
    low, high = stability_point(patches, critical).length, LONGEST * critical
    if not runs_away(patches, high, evolution):
        raise NoPatch(
            f"no slow slip of a patch up to {LONGEST:g} L_c = {high:.4g} m runs away", BEYOND
        )
    while high > low * (1.0 + PRECISION):
        middle = math.sqrt(low * high)
        if runs_away(patches, middle, evolution):
            high = middle
        else:
            low = middle
    return math.sqrt(low * high)


@takes_fault
def runaway_length(*, evolution: str = "aging", **fault: Values) -> Any:
    """Runaway length L_run: from where on a creeping patch can't slip slowly any more.

    Between the stability length L_s and L_run a patch slips slowly in a limit cycle. Where friction
    weakens little, zeta/a below about 2, the force drops at L_run or later; where it weakens more,
    the patch drops before its oscillation saturates, and the law of the drop holds.

    Parameters
    ----------
    evolution : {"aging", "slip"}
        Evolution of the state.
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`; the patch is pushed at its edge.

    Returns
    -------
    ndarray or DataArray
        L_run (m), broadcast shape, within 3 %; NaN where homogeneous sliding is stable and where no
        patch up to ``3 L_c`` runs away. Takes about a second for each fault.

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown or outside its range.
    """
    own = fault_of(fault)
    return named(runaway_values(own, evolution), "runaway_length", "m", "runaway length", own)


def runaway_values(fault: Fault, evolution: str = "aging") -> Any:
    """L_run (m); plain, in SI units."""

    def lengths(systems: Systems) -> Array:
        critical = 2.0 * np.pi / largest_crossings(systems)
        found = np.full((1, critical.size), np.nan)
        for i in np.flatnonzero(np.isfinite(critical)):
            patches = Patches(systems.at(np.array([i])))
            try:
                found[0, i] = runaway_point(patches, float(critical[i]), evolution)
            except NoPatch:
                continue
        return found

    return fault.evaluate(lengths)[0]
