"""The advancing front: its fracture energy, and the time at which the patch has a length.

Ahead of the front the interface has aged at rest. As the front passes, the state decreases with
slip to that of steady sliding, and friction from its peak: the area below is the front's fracture
energy. Where the patch advances slowly its fields depend on time through L alone. At each L, with
the speed dL/dt and the slip rate along the patch,

- the state at a distance xi behind the front follows from the one ahead by ``dphi/dt = g(phi w/D)``
  during the time ``xi/(dL/dt)``, and friction f follows at each place;
- the slip is in balance with that strength, ``-(K1 + f S2) u = f sigma0``, and the edge has the
  displacement for which the front has no singularity: U(L), and ``t = U/V``;
- the slip rate is ``(du/dL)/(dU/dL) V`` at fixed x.

The three are repeated until they agree. Nothing is fitted and there is no time step. L_s is the
length of the shortest patch that has a growing mode.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from ...model.friction import Friction
from ...types import Array, ComplexArray
from ..status import BEYOND, NoLength
from .linearised import Creep, creeping_patch, edge_slip, local_coefficients
from .patches import Patches
from .response import MORE_MODES, joined, mirror_modes

ROUNDS = 4  # of the three equations: each removes more than nine tenths of the error
FINE = 400  # angles at which the state behind the front is followed
AT_REST = 100  # times of the interface ahead
FIRST_REST = 1e-4  # the first of them, over the last
STEP = 0.01  # of log L, in derivatives by L
FLOOR = 1e-3
"""Slip rate over V at which the front begins, or the law's v0 if that is larger: friction
vanishes below it, and contacts there are as if at rest."""

OSCILLATING = 0.01  # angular frequency over V/D below which a mode counts as not oscillating

SHORTEST = 0.3  # where the search for L_s starts, over L_c
TRIED = 14  # number of patches that are tried
NEAR = np.array([-0.05, 0.0, 0.05])  # log(L/L_s) of the patches to which a parabola is fitted
CLOSE = 2e-3  # relative, within which the parabola's L_s must have decay and growth
PARTS = (8, 8, 16)  # of brackets: the relative width becomes 1e-4
REAL = 1e-9  # imaginary part below which a parabola's root is real


class Advance:
    """The patch of one fault at some lengths (m) as its front advances; initial state in s.

    It has the time since the edge began to move (s), `patches` that are linearised, with slip in D
    and time in D/V, their creeps, and the logarithms of the state (s) at the angles of the modes.
    """

    def __init__(
        self,
        patches: Patches,
        lengths: ArrayLike,
        initial_state: float,
        initial_stress: float = 0.0,
    ) -> None:
        if patches.loading != "edge":
            raise NoLength(
                "only a patch that is pushed at its edge has a theory of the advancing front"
            )
        assert patches.law is not None
        self.source = patches
        self.law = patches.law
        self.velocity = patches.velocity
        self.distance = self.law.slip_distance
        self.initial_state = initial_state
        self.initial_stress = initial_stress
        self.modes = mirror_modes(MORE_MODES)
        self.floor = max(FLOOR, self.law.regularisation_slip_rate / self.velocity)
        self.length = length = np.atleast_1d(np.asarray(lengths, dtype=float))
        bodies = [
            [patches.response(one, MORE_MODES) for one in length * np.exp(step)]
            for step in (-STEP, 0.0, STEP)
        ]
        self.bodies = bodies[1]
        self.responses = list(map(joined, bodies))
        steady_friction = self.law.expansion(self.velocity).f0
        self.friction = np.full((length.size, MORE_MODES), steady_friction)
        self.log_states = np.zeros_like(self.friction)
        self.rates = self.update_slip()
        for _ in range(ROUNDS):
            self.update_state()
            self.update_slip()
            self.update_rates()
        self.creeps = [self.creep(i) for i in range(length.size)]
        self.frictions = [
            local_coefficients(self.law, self.velocity, creep.slip_rate, log_state)
            for creep, log_state in zip(self.creeps, self.log_states, strict=True)
        ]
        self.patches = list(map(creeping_patch, self.creeps, self.frictions))

    def update_slip(self) -> Array:
        """Slip in balance with the strength, and time; each at three neighbouring lengths.

        Returns the modes' coefficients of the slip rate over V at a constant strength.
        """
        strength = self.friction - self.initial_stress
        found = [edge_slip(near, self.friction, strength) for near in self.responses]
        rates, self.slips, (before, self.loaded, after) = zip(*found, strict=True)
        self.by_length = (after - before) / (2.0 * STEP * self.length)
        self.time = self.loaded * self.distance / self.velocity
        return rates[1]

    def update_rates(self) -> None:
        """Modes' coefficients of ``(du/dL)/(dU/dL)`` at fixed x.

        The derivative is taken at fixed theta, which moves with the front, and corrected by ``x/L
        u'``.
        """
        own = self.modes
        before, at, after = self.slips
        growing = (after - before) / (2.0 * STEP) @ own.values.T
        moving = (at @ own.gradients.T) * np.cos(own.theta)
        values = (growing - moving) / (self.length * self.by_length)[:, None]
        sines = (values - own.values[:, 0]) @ own.inverse.T
        edge = np.ones((self.length.size, 1))
        self.rates = np.concatenate([edge, sines], axis=1)

    def update_state(self) -> None:
        """log(phi) and friction behind the front, at the modes' angles, (n, N)."""
        law, own = self.law, self.modes
        theta = np.linspace(0.0, 0.5 * np.pi, FINE + 1)
        speeds = law.slip_speed(self._slip_rate(own.at(theta))).T / self.distance
        distances = -np.diff(np.cos(theta))[:, None] * self.length
        speed = self.velocity / (self.by_length * self.distance)
        middle = 0.5 * (speeds[:-1] + speeds[1:])
        along = _followed(law, self._state_ahead(), distances / speed, middle)
        rows = [np.interp(own.theta, theta, of_length) for of_length in np.transpose(along)]
        self.log_states = np.array(rows)
        slip_rate = self._slip_rate(own.values)
        self.friction, *_ = law.coefficient_and_slopes(slip_rate, self.log_states)

    def _slip_rate(self, modes: Array) -> Array:
        """Slip rate (m/s) at the angles of some values of the modes, (n, angle)."""
        return self.velocity * np.maximum(self.rates @ modes.T, self.floor)

    def _state_ahead(self) -> Array:
        """log(phi) of the interface that has aged at rest until the front reaches it, (n,)."""
        speed_at_rest = self.law.slip_speed(0.0) / self.distance
        log_state = np.full(self.length.size, np.log(self.initial_state))
        ends = np.append(0.0, np.geomspace(FIRST_REST, 1.0, AT_REST))
        steps = np.diff(ends)[:, None] * self.time  # which grow as the state does
        return _followed(self.law, log_state, steps, np.full(steps.shape, speed_at_rest))[-1]

    def creep(self, i: int) -> Creep:
        """The creep at one of the lengths."""
        bodies = self.bodies[i]
        creep = Creep(
            response=bodies,
            slip_rate=np.maximum(self.modes.values @ self.rates[i], self.floor),
            normal_stress=1.0 + bodies.normal @ self.slips[1][i],
            loaded=self.loaded[i],
        )
        self.source.require_contact(creep)
        return creep


def _followed(law: Friction, log_state: Array, steps: Array, rates: Array) -> list[Array]:
    """log(phi) (n,) at the ends of times (s) at slip speeds over D (1/s), both (time, n).

    In each it is extrapolated from one and two steps.
    """
    evolve = law.evolution_law.implicit_log_state
    along = [log_state]
    halves = 0.5 * steps
    both = np.stack([halves, steps], axis=1), np.stack([rates, rates], axis=1)
    for halved, rate, steps_of_both, rate_of_both in zip(halves, rates, *both, strict=True):
        (half, one), _ = evolve(np.array([along[-1]] * 2), steps_of_both, rate_of_both)
        two_halves, _ = evolve(half, halved, rate)
        along.append(2.0 * two_halves - one)
    return along


def oscillating(found: Advance) -> ComplexArray:
    """Lambda over V/D of each patch's fastest growing oscillating mode, NaN without one."""
    return np.array([patch.oscillating(OSCILLATING) for patch in found.patches])


def fastest(found: Advance) -> Array:
    """Re Lambda over V/D of each patch's fastest growing mode, oscillating or not."""
    return np.array([patch.eigenvalues[0].real for patch in found.patches])


def first_growing(
    patches: Patches, critical: float, initial_state: float, initial_stress: float = 0.0
) -> float:
    """L_s of a patch with its advancing front.

    Growth begins between two of the lengths tried, with a pair of modes that oscillates
    (:mod:`.lengths`). L_s is the root of a parabola through the pair's growth. Where the pair
    oscillates in a narrow window only, growth does not begin at that root, and more lengths are
    tried. Lengths are in m, the initial state in s.
    """

    def advanced(lengths: ArrayLike) -> Advance:
        return Advance(patches, lengths, initial_state, initial_stress)

    low, high, pair = _bracket(advanced, critical)
    if np.isfinite(pair).all():
        log_at = np.interp(0.0, pair, np.log([low, high]))
        onset = _vanishing(advanced, float(np.exp(log_at)))
        around = onset * np.array([1.0 - CLOSE, 1.0 + CLOSE])
        before, after = fastest(advanced(around))
        if before < 0.0 < after:
            return onset
    for parts in PARTS:  # ten bisections; the state takes as long for many lengths as for one
        tried = np.geomspace(low, high, parts + 1)
        growing = fastest(advanced(tried[1:-1])) > 0.0
        i = int(np.argmax(np.append(growing, True)))
        low, high = tried[i : i + 2]
    return float(np.sqrt(low * high))


def _bracket(
    advanced: Callable[[ArrayLike], Advance], critical: float
) -> tuple[float, float, Array]:
    """Neighbouring lengths (m) without and with growth, and the oscillating modes' growth there."""
    tried = np.geomspace(SHORTEST, 1.0, TRIED) * critical
    longer = tried * (1.0 / SHORTEST) ** (1.0 - 1.0 / TRIED)
    for lengths in (tried, longer):
        found = advanced(lengths)
        growing = fastest(found) > 0.0
        if growing.any():
            break
    else:
        longest = lengths[-1] / critical
        raise NoLength(f"no patch up to {longest:.2g} L_c has a growing mode", BEYOND)
    i = int(np.argmax(growing))
    if i == 0:
        first = lengths[0] / critical
        raise NoLength(f"a mode of the patch grows at {first:.2g} L_c already, or before")
    low, high = lengths[i - 1 : i + 1]
    return low, high, oscillating(found)[i - 1 : i + 1].real


def _vanishing(advanced: Callable[[ArrayLike], Advance], at: float) -> float:
    """Root of a parabola through the pair's growth around a length (m); `at` without a root."""
    growth = oscillating(advanced(at * np.exp(NEAR))).real
    if not np.isfinite(growth).all():
        return at
    roots = np.polynomial.Polynomial.fit(NEAR, growth, 2).roots()
    real = roots[np.abs(roots.imag) < REAL].real
    if real.size == 0:
        return at
    nearest = real[np.abs(real).argmin()]
    return float(at * np.exp(nearest))
