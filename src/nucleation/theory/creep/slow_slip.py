"""Slow slip of weakly disturbed patches of fixed length: how long until it runs away.

A patch that creeps with ``v_c(x)`` obeys, with the whole logarithmic law and per sigma0,

    -(K1 + f S2)(v - v_c) = s (a dv/dt / v + b dphi/dt / phi),      dphi/dt = g(phi v/D),

with the compression s over sigma0 and the stiffness of :mod:`.response`. Slow slip beyond L_s is
irregular: patches that differ by 1e-3 in length or disturbance run away at quite different times.
So many patches are integrated at once, each with its own steps.

Modes resolve the cohesive zone. Its wavenumber k_b is where the stiffness equals b, and the N modes
reach the wavenumber 2 N/L. They are then little stiff, and an explicit method is the fastest.
"""

import math

import numpy as np

from ...model.friction import module
from ...types import Array
from ..status import UNKNOWN, NoLength
from .patches import Patches

FINENESS = 0.5  # modes over k_b L, beside
MODES_OF_ENDS = 8
MOST_MODES = 120
FAST = 300.0  # slip rate over V beyond which a burst is an event
TOLERANCE = 3e-3  # absolute, of the logarithms in a step
FIRST_STEP = 1e-2  # over D/V
MOST_STEPS = 40_000
ORDER = 5  # of the method, Dormand and Prince's


def cohesive_wavenumber(patches: Patches, critical: float) -> float:
    """k_b (1/m), at which the stiffness equals b: about one over the length of a fast front."""
    one = patches.one
    k = 2.0 * np.pi / critical * np.geomspace(0.1, 1e4, 500)
    load = one.load_and_coupling(k)[0]
    log_k = np.interp(math.log(one.b[0]), np.log(load), np.log(k))
    return float(np.exp(log_k))


def modes_that_resolve(cohesive: float, length: float) -> int:
    """Number of modes of a patch (m) that resolve a wavenumber (1/m)."""
    number = math.ceil(MODES_OF_ENDS + FINENESS * cohesive * length)
    if number > MOST_MODES:
        raise NoLength(
            f"a patch has {0.5 * cohesive * length / math.pi:.3g} wavelengths of its fastest "
            f"fronts and needs {number} modes: up to {MOST_MODES} were tried",
            UNKNOWN,
        )
    return number


class _SlowSlip:
    """Patches of several lengths, as rates of log(v/V) and of -log(phi V/D)."""

    def __init__(self, patches: Patches, lengths: Array, number: int) -> None:
        creeps = [patches.creep(length, number) for length in lengths]
        friction, self.a, zeta = patches.constants
        self.b = self.a + zeta
        self.law = patches.law
        self.velocity = patches.velocity
        evolution = patches.evolution if self.law is None else self.law.evolution
        self.evolve = module("evolutions", evolution).growth
        stiffness = []
        for creep in creeps:
            matrix = creep.response.coupled(friction)[:, 1:] @ creep.response.modes.inverse
            stiffness.append(-(matrix / creep.normal_stress[:, None]).T)
        self.stiffness = np.array(stiffness)
        self.steady = np.array([creep.slip_rate for creep in creeps])[:, None]
        self.place = np.cos(creeps[0].response.modes.theta)

    def disturbed(self, disturbances: Array) -> Array:
        """Logarithms at the start, (2, length, disturbance, place): the state is changed."""
        rate = self.steady
        speed = rate
        if self.law is not None:
            speed = self.law.slip_speed(self.velocity * rate) / self.velocity
        shape = np.sin(np.pi * self.place) * disturbances[:, None]
        state = np.log(speed) - shape
        return np.stack([np.broadcast_to(np.log(rate), state.shape), state])

    def rates(self, logs: Array, out: Array) -> None:
        """Rates of the logarithms over V/D."""
        v, per_state = np.exp(logs)
        by_rate, by_state, speed = self._friction(v, logs[1])
        aging = per_state * self.evolve(speed / per_state)
        force = (v - self.steady) @ self.stiffness
        np.divide(force - by_state * aging, by_rate, out=out[0])
        np.negative(aging, out=out[1])

    def _friction(self, v: Array, per_state: Array) -> tuple[Array | float, Array | float, Array]:
        """Slopes df/dlog(v) and df/dlog(phi) and the slip speed over V, by the log of 1/phi."""
        law = self.law
        if law is None:
            return self.a, self.b, v
        rate = self.velocity * v
        memory = math.log(law.slip_distance / self.velocity)
        _, by_rate, by_state = law.coefficient_and_slopes(rate, memory - per_state)
        return rate * by_rate, by_state, law.slip_speed(rate) / self.velocity


@np.errstate(all="ignore")  # steps that are too long overflow, and are tried again
def lifetimes(
    patches: Patches, lengths: Array, number: int, disturbances: Array, duration: float
) -> Array:
    """Times over D/V until patches run away after weak disturbances, (length, disturbance).

    Lengths are in m, disturbances those of log(phi); the time is inf where slow slip lasts.
    Raises NoLength if the creep opens the fault, or where more than MOST_STEPS are needed.
    """
    slow = _SlowSlip(patches, lengths, number)
    logs = slow.disturbed(disturbances)
    stages = np.empty((ORDER + 2, *logs.shape))
    slow.rates(logs, stages[0])
    found = np.full(logs.shape[1:3], np.inf)
    place = np.indices(found.shape)
    time = np.zeros_like(found)
    step = np.full_like(found, FIRST_STEP)
    for _ in range(MOST_STEPS):
        after, error = _step(slow, logs, stages, step)
        accepted = error < 1.0
        np.copyto(logs, after, where=accepted[..., None])
        np.copyto(stages[0], stages[-1], where=accepted[..., None])
        time = time + accepted * step
        fast = logs[0].max(axis=-1) > math.log(FAST)
        found[*place] = np.where(fast, time, np.inf)
        lasting = ~fast & (time < duration)
        growth = 0.85 * (error + 1e-9) ** (-1.0 / ORDER)
        step = lasting * step * np.clip(growth, 0.2, 3.0)
        each = lasting.sum(axis=1)
        if not each.any():
            return found
        if not each.all() or each.max() < lasting.shape[1]:  # those that ended are dropped
            (kept,) = np.nonzero(each)
            order = np.argsort(~lasting[kept], axis=1, kind="stable")[:, : each.max()]
            at = kept[:, None], order
            slow.stiffness, slow.steady = slow.stiffness[kept], slow.steady[kept]
            place, time, step = place[:, *at], time[at], step[at]
            logs = np.ascontiguousarray(logs[:, *at])
            stages = np.ascontiguousarray(stages[:, :, *at])
    raise NoLength(f"slow slip takes more than {MOST_STEPS} steps in {duration:g} D/V", UNKNOWN)


def _step(slow: _SlowSlip, logs: Array, stages: Array, step: Array) -> tuple[Array, Array]:
    """Logarithms after a step, and their error over the tolerance; fills the later stages."""
    from scipy.integrate import RK45  # slow to load, and few processes need it

    flat = stages.reshape(len(stages), -1)  # a view: stages is contiguous
    own = step[..., None]
    for index, row in enumerate([*RK45.A[1:], RK45.B], start=1):
        change = row[:index] @ flat[:index]
        after = logs + own * change.reshape(logs.shape)
        slow.rates(after, stages[index])
    error = np.abs(RK45.E @ flat).reshape(logs.shape).max(axis=(0, -1))
    return after, np.fmin(step * error / TOLERANCE, 1e9)
