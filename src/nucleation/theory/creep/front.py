"""The advancing front: what it costs to break contacts, and when the patch has a length.

Ahead of the front the interface has aged at rest. As the front passes, the state falls with slip to
that of steady sliding, and friction from its peak: the area below is the front's fracture energy.
Where the patch moves on slowly its fields depend on time through L alone. At each L, with the speed
dL/dt and the slip rate along the patch,

- the state at a distance xi behind the front is what ``dphi/dt = g(phi w/D)`` makes of the one
  ahead in the time ``xi/(dL/dt)``, and friction f follows at each place;
- the slip is in balance with that strength, ``-(K1 + f S2) u = f sigma0``, and the edge has moved
  as far as it takes for a front without a singularity: U(L), and ``t = U/V``;
- the slip rate is ``(du/dL)/(dU/dL) V`` at fixed x.

The three are repeated until they agree. Nothing is fitted and there is no time step.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...model.friction.law import Friction
from ...types import Array
from ..status import BEYOND
from .lengths import NoPatch, Patches
from .linearised import FrozenPatch, creeping_patch, local_coefficients
from .modes import MORE_MODES, Creep, EdgeSlip, Half, edge_slip, modes, response

ROUNDS = 4  # of the three equations: each takes off more than nine tenths of the error
FINE = 400  # angles at which the state behind the front is followed,
AT_REST = 100  # and times of the interface ahead
STEP = 0.01  # of log L, in derivatives by L
FLOOR = 1e-3  # slip rate over V with which the front sets in, or the law's v0 if that is more:
# friction falls to zero below it, and contacts there are as if at rest
SHORTEST, TRIED = 0.3, 14  # patches that are tried for L_s: from which part of L_c on, how many,
NEAR = np.array([-0.05, 0.0, 0.05])  # and those through which Re Lambda is laid, log(L/L_s)
CLOSE = 2e-3  # relative, within which the parabola's L_s has to have decay and growth,
NARROW = 1e-4  # and the bracket of one that is bisected
OSCILLATING = 0.01  # angular frequency, over V/D, below which a mode counts as not oscillating


class Advance(NamedTuple):
    """A patch at some lengths as its front moves on; all in SI units but the patches."""

    length: Array  # L (m), (n,)
    time: Array  # since the edge began to move (s)
    speed: Array  # dL/dt (m/s)
    patches: list[FrozenPatch]  # linearised; slip in D, time in D/V
    creeps: list[Creep]
    log_states: Array  # log(phi), phi in s, at the angles of the modes, (n, N)


def advance(
    patches: Patches, lengths: ArrayLike, initial_state: float, initial_stress: float = 0.0,
    number: int | None = None,
) -> Advance:  # fmt: skip
    """The patch of one fault at some lengths (m), with its advancing front.

    Parameters
    ----------
    patches : with a friction law and its velocity; pushed at the edge.
    initial_state, initial_stress : phi_0 (s), and the shear stress over sigma0, when the edge
        begins to move.
    number : of modes; more than steady creep needs, by default.

    Raises
    ------
    NoPatch
        If the creep takes all of the compression somewhere, or no edge is pushed.
    """
    if patches.loading != "edge":
        raise NoPatch("a front that advances is known of a patch that is pushed at its edge alone")
    law, velocity, number = patches.law, patches.velocity, number or MORE_MODES
    own = modes(number)
    assert law is not None
    distance, length = law.characteristic_slip_distance, np.atleast_1d(np.asarray(lengths, float))
    around = length * np.exp(STEP * np.array([-1.0, 0.0, 1.0]))[:, None]
    held = [[response(patches.one, one, number) for one in row] for row in around]
    floor = max(FLOOR, law.regularisation_slip_rate / velocity)
    friction = np.full((length.size, number), law.expansion(velocity).f0)
    psi = np.zeros_like(friction)
    rates = np.zeros((length.size, number + 1))
    for turn in range(ROUNDS + 1):
        slips = [_slips(row, friction, initial_stress) for row in held]
        loaded = np.array([[slip.loaded for slip in row] for row in slips])
        by_length = (loaded[2] - loaded[0]) / (2.0 * STEP * length)
        time, speed = loaded[1] * distance / velocity, velocity / (by_length * distance)
        if turn == 0:
            rates = np.array([slip.rates for slip in slips[1]])
        else:
            rates = _rates(own, length, slips, by_length)
        if turn < ROUNDS:
            psi, friction = _behind(
                law, velocity, own, length, time, speed, rates, floor, initial_state
            )
    creeps, frozen = [], []
    for i, slip in enumerate(slips[1]):
        rate = np.maximum(own.values @ rates[i], floor)
        creep = Creep(held[1][i], rate, 1.0 + held[1][i].normal @ slip.slip, slip.loaded)
        if creep.normal_stress.min() <= 0.0:
            raise NoPatch(f"the creep opens the fault at a patch length of {length[i]:.4g} m")
        creeps.append(creep)
        frozen.append(creeping_patch(creep, local_coefficients(law, velocity, rate, psi[i])))
    return Advance(length, time, speed, frozen, creeps, psi)


def _slips(row: list, friction: Array, initial_stress: float) -> list[EdgeSlip]:
    """Slip of patches of given strength, loaded from a uniform stress."""
    return [edge_slip(one, f, f - initial_stress) for one, f in zip(row, friction, strict=True)]


def _rates(own: Half, length: Array, slips: list[list[EdgeSlip]], by_length: Array) -> Array:
    """Modes' coefficients of ``(du/dL)/(dU/dL)`` at fixed x: with theta fixed, less ``x/L u'``."""
    before, at, after = (np.array([slip.slip for slip in row]) for row in slips)
    growing = (after - before) / (2.0 * STEP) @ own.values.T
    moving = (at @ own.gradients.T) * np.cos(own.theta)
    values = (growing - moving) / (length * by_length)[:, None]
    rest = (values - own.values[:, 0]) @ own.inverse.T
    return np.concatenate([np.ones((length.size, 1)), rest], axis=1)


def _behind(
    law: Friction,
    velocity: float,
    own: Half,
    length: Array,
    time: Array,
    speed: Array,
    rates: Array,
    floor: float,
    initial_state: float,
) -> tuple[Array, Array]:
    """log(phi) and friction behind the front, at the modes' angles, (n, N)."""
    theta = np.linspace(0.0, 0.5 * np.pi, FINE + 1)
    v = velocity * np.maximum(rates @ own.at(theta).T, floor)
    speeds = law.slip_speed(v) / law.characteristic_slip_distance
    psi = np.full(length.size, np.log(initial_state))
    # at rest, in steps that grow as the state does
    at_rest = np.full(length.size, float(law.slip_speed(0.0)) / law.characteristic_slip_distance)
    ends = np.append(0.0, np.geomspace(1e-4, 1.0, AT_REST))
    for part in np.diff(ends):
        psi = _stepped(law, psi, part * time, at_rest)
    along = [psi]
    steps = length[:, None] * -np.diff(np.cos(theta)) / speed[:, None]
    for j in range(FINE):
        psi = _stepped(law, psi, steps[:, j], 0.5 * (speeds[:, j] + speeds[:, j + 1]))
        along.append(psi)
    states = np.array([np.interp(own.theta, theta, one) for one in np.transpose(along)])
    rate = velocity * np.maximum(rates @ own.values.T, floor)
    return states, law.coefficient_and_slopes(rate, states)[0]


def _stepped(law: Friction, psi: Array, step: Array, rate: Array) -> Array:
    """log(phi) after a time at a slip speed over D (1/s), extrapolated from one and two steps."""
    evolve = law.evolution_law.implicit_log_state
    half = evolve(evolve(psi, 0.5 * step, rate)[0], 0.5 * step, rate)[0]
    return 2.0 * half - evolve(psi, step, rate)[0]


def oscillating(found: Advance) -> NDArray[np.complex128]:
    """Lambda over V/D of each patch's fastest growing oscillating mode, NaN without one."""
    return np.array([patch.oscillating(OSCILLATING) for patch in found.patches])


def fastest(found: Advance) -> Array:
    """Re Lambda over V/D of each patch's fastest growing mode, oscillating or not."""
    return np.array([patch.eigenvalues[0].real for patch in found.patches])


def first_growing(
    patches: Patches, critical: float, initial_state: float, initial_stress: float = 0.0
) -> float:
    """L_s (m) of a patch with its advancing front; `critical` is L_c (m).

    Growth begins between two of the lengths tried, with a pair of modes that oscillates
    (:mod:`nucleation.theory.creep.lengths`). L_s is where a parabola through the pair's growth
    vanishes. Where the pair oscillates in a narrow window only, that is not where growth begins,
    and L_s is bisected.

    Raises
    ------
    NoPatch
        If no patch of these lengths has a growing mode, or its creep opens the fault.
    """

    def advanced(lengths: ArrayLike) -> Advance:
        return advance(patches, lengths, initial_state, initial_stress)

    tried = np.geomspace(SHORTEST, 1.0, TRIED) * critical
    for lengths in (tried, tried * (1.0 / SHORTEST) ** (1.0 - 1.0 / TRIED)):
        found = advanced(lengths)
        growing = fastest(found) > 0.0
        i = int(np.argmax(growing))
        if growing[i]:
            break
    else:
        raise NoPatch(
            f"no patch up to {lengths[-1] / critical:.2g} L_c = {lengths[-1]:.4g} m has a growing "
            "mode",
            BEYOND,
        )
    if i == 0:
        raise NoPatch(f"the patch grows its mode from {lengths[0] / critical:.2g} L_c on or before")
    low, high = lengths[i - 1 : i + 1]
    pair = oscillating(found)[i - 1 : i + 1].real
    if np.isfinite(pair).all():
        at = float(np.exp(np.interp(0.0, pair, np.log([low, high]))))
        onset = _vanishing(advanced, at)
        before, after = fastest(advanced(onset * np.array([1.0 - CLOSE, 1.0 + CLOSE])))
        if before < 0.0 < after:
            return onset
    while high / low > 1.0 + NARROW:
        middle = float(np.sqrt(low * high))
        if fastest(advanced([middle]))[0] > 0.0:
            high = middle
        else:
            low = middle
    return float(np.sqrt(low * high))


def _vanishing(advanced: Callable[[ArrayLike], Advance], at: float) -> float:
    """Where a parabola through the pair's growth around a length (m) vanishes; `at` if nowhere."""
    growth = oscillating(advanced(at * np.exp(NEAR))).real
    if not np.isfinite(growth).all():
        return at
    roots = np.polynomial.Polynomial.fit(NEAR, growth, 2).roots()
    real = roots[np.abs(roots.imag) < 1e-9].real
    return float(at * np.exp(real[np.abs(real).argmin()])) if real.size else at
