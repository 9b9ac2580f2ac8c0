"""The runaway length L_run: the shortest patch with slow slip that ends in an event.

Where friction weakens little, the oscillation that begins at the stability length L_s saturates: a
longer patch slips in a limit cycle of slow slip, alternately faster and slower than V. The cycle
ceases to exist at a length L_run, and there the force drops at any weak noise. A disturbance that
changes the logarithm of the state by 0.1 or more makes shorter patches run away.

A patch of fixed length in steady creep ``v_c(x)`` with the whole logarithmic law obeys, per sigma0,

    -(K1 + f S2)(v - v_c) = s (a dv/dt / v + b dphi/dt / phi),      dphi/dt = g(phi v/D),

with the compression s over sigma0 and the stiffness of :mod:`.response`. It is integrated from a
small perturbation of the state; L_run is the shortest L at which the slip rate grows without bound.
In a thin layer it depends on zeta/a alone, and is about ``1.9 (1/pi) sqrt(b/zeta) L_c``. The factor
is 1 where the strain energy released by a patch equals the fracture energy of its front. A friction
law has its own a and b at each slip rate and state, if the patches are given with it.
"""

import contextlib
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from ...model.friction.law import Friction
from ...types import Array
from ..bisection import bisected
from ..crossings import largest_crossings
from ..evaluation import evaluate
from ..spectrum import Systems
from ..status import BEYOND, NoLength
from ..values import FaultLike
from .lengths import stability_point
from .patches import Patches
from .response import MODES

LONGEST = 3.0  # patches up to this multiple of L_c are tried
PRECISION = 4e-3  # relative, of L_run
ERROR = 0.03  # relative, of L_run, by modes, duration and perturbation
PERTURBATION = 0.05  # of log(phi) at the start, in the middle of the patch; as good as none
DURATION = 1500.0  # over D/V, after which slow slip counts as a limit cycle
FAST = 300.0  # slip rate over V beyond which a burst is an event
RELATIVE_TOLERANCE = 1e-5  # of the integration, of the logarithms
ABSOLUTE_TOLERANCE = 1e-6


class _Slopes(NamedTuple):
    """Friction's slopes at each place: df/dlog(v), df/dlog(phi), and dlog(phi)/dt over V/D."""

    by_rate: Array | float
    by_state: Array | float
    aging: Array


def _constant(
    a: float,
    zeta: float,
    evolution: str,
) -> Callable[[Array, Array], _Slopes]:
    """The slopes for constant a and b, by v/V and log(phi V/D)."""
    law = Friction(evolution=evolution, slip_distance=1.0)
    evolve = law.evolution_law.growth

    def slopes(v: Array, log_state: Array) -> _Slopes:
        aging = evolve(v * np.exp(log_state)) * np.exp(-log_state)
        return _Slopes(a, a + zeta, aging)

    return slopes


def _of_law(
    law: Friction,
    velocity: float,
) -> Callable[[Array, Array], _Slopes]:
    """The slopes of a friction law at V (m/s), by v/V and log(phi V/D)."""
    memory = law.slip_distance / velocity
    evolve = law.evolution_law.growth

    def slopes(v: Array, log_state: Array) -> _Slopes:
        rate = velocity * v
        _, by_rate, by_state = law.coefficient_and_slopes(rate, log_state + math.log(memory))
        state = np.exp(log_state)
        aging = evolve(state * law.slip_speed(rate) / velocity) / state
        return _Slopes(rate * by_rate, by_state, aging)

    return slopes


def runs_away(
    patches: Patches,
    length: float,
) -> bool:
    """Whether the slow slip of a patch accelerates without bound.

    Parameters
    ----------
    patches : Patches
        Of one fault, with constant a and b or with its friction law.
    length : float
        Patch length (m).

    Returns
    -------
    bool
        Whether the slip rate exceeds ``FAST V``.

    Raises
    ------
    NoLength
        If the creep removes all of the compression somewhere.
    """
    creep = patches.creep(length, MODES)
    response, steady = creep.response, creep.slip_rate
    friction, a, zeta = patches.constants
    stiffness = response.coupled(friction)[:, 1:] @ response.modes.inverse
    stiffness = stiffness / creep.normal_stress[:, None]
    count = steady.size
    log_state = -np.log(steady)
    slopes_at = _constant(a, zeta, patches.evolution)
    if patches.law is not None:
        slopes_at = _of_law(patches.law, patches.velocity)
        log_state = -np.log(patches.law.slip_speed(patches.velocity * steady) / patches.velocity)

    def rates(
        _: float,
        logs: Array,
    ) -> Array:
        """Rates of log(v) and log(phi)."""
        v = np.exp(logs[:count])
        slopes = slopes_at(v, logs[count:])
        strengthening = slopes.by_state * slopes.aging
        accelerating = (-stiffness @ (v - steady) - strengthening) / slopes.by_rate
        return np.concatenate([accelerating, slopes.aging])

    def event(
        _: float,
        logs: Array,
    ) -> float:
        return float(logs[:count].max() - math.log(FAST))

    event.terminal = True  # type: ignore[attr-defined]
    start = np.concatenate([np.log(steady), log_state])
    place = np.cos(response.modes.theta)
    start[count:] += PERTURBATION * np.sin(np.pi * place)
    found = solve_ivp(
        rates,
        (0.0, DURATION),
        start,
        "LSODA",
        rtol=RELATIVE_TOLERANCE,
        atol=ABSOLUTE_TOLERANCE,
        events=event,
    )
    return bool(found.t_events[0].size)


def runaway_point(
    patches: Patches,
    critical: float,
) -> float:
    """L_run of one fault.

    Parameters
    ----------
    patches : Patches
        Of the fault, with constant a and b or with its friction law.
    critical : float
        L_c (m) of the fault.

    Returns
    -------
    float
        L_run (m).

    Raises
    ------
    NoLength
        If no patch is unstable, none up to ``LONGEST L_c`` runs away, or its creep opens the fault.
    """
    low = stability_point(patches, critical).length
    high = LONGEST * critical
    if not runs_away(patches, high):
        raise NoLength(
            f"no slow slip of a patch up to {LONGEST:g} L_c = {high:.4g} m runs away", BEYOND
        )
    return bisected(lambda length: runs_away(patches, length), low, high, PRECISION)


def runaway_lengths(fault: FaultLike) -> Any:
    """L_run (m) of each fault, with constant a and b; NaN where there is none."""

    def lengths(systems: Systems) -> Array:
        critical = 2.0 * np.pi / largest_crossings(systems)
        found = np.full((1, critical.size), np.nan)
        for i, length in enumerate(critical):
            patches = Patches(systems.at(np.array([i])), evolution=fault.evolution)
            with contextlib.suppress(NoLength):
                found[0, i] = runaway_point(patches, float(length))
        return found

    return evaluate(fault, lengths)[0]
