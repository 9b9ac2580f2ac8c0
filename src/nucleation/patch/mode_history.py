"""The oscillating mode of the creeping patch along its creep, and how a forcing stirs it.

The patches of :mod:`nucleation.theory.creep.front` have what the law of the drop asks for: time and
Lambda at each length, and the left eigenvector. The mode's complex amplitude A obeys

    dA/dt = Lambda A + eps g(t) xi,

scaled such that A = 1 where the slip rate swings by V. The left eigenvector gives g: linearised
force balance makes of each kind of forcing (:mod:`nucleation.model.perturbation`)

    normal_load      f sigma eps xi(t)
    drive_velocity   a displacement U of the edge, with the slip ``p U``, ``(K1 + f S2) p = 0``
    strength         f sigma eps xi(x)
    state            eps (V/D) xi(x, t) in d(dpsi)/dt

An infinite block is loaded evenly, so that a load acts on friction alone. Left out is what freezing
leaves out: dl/dt, and the nodes at the front that begin to slip (docs/creeping_patch.md). Either
changes growth by some 0.2 1/s, where Re Lambda comes to 3 1/s.
"""

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ..model.parameters import Parameters
from ..theory.creep.front import Advance, advance, first_growing, oscillating
from ..theory.creep.lengths import NoPatch, Patches
from ..theory.creep.linearised import local_coefficients
from ..theory.creep.modes import edge_slip
from ..theory.status import STABLE
from ..types import Array, ComplexArray

FIRST, LAST, INSTANTS = 0.8, 1.7, 24  # lengths over L_s that are followed, and how many
SLOWED = 0.45  # frequency over that at L_s below which a patch leaves its oscillation behind
FEWEST = 6  # instants of which trends can be made,
NARROWED = 3  # and how often a narrower range of lengths is tried for them
JUMP = 2.0  # change of the rate, over that to the next instant, which is one to another mode
PLACES = 400  # along x, for what depends on it


@dataclasses.dataclass(frozen=True)
class ModeHistory:
    """The oscillating mode along the creep, on (instant) or (instant, x).

    The weights are those of ``A`` in each kind of forcing, for a mode whose slip rate swings by V.
    """

    parameters: Parameters
    x: Array  # m
    time: Array  # s
    length: Array  # m
    rate: ComplexArray  # Lambda (1/s)
    normal_load: ComplexArray  # g (1/s) of a relative change of the load
    drive: ComplexArray  # g (1/(m s)) of a displacement of the driven edge
    strength: ComplexArray  # g (1/s) of a relative change of friction at each place
    state: ComplexArray  # g (1) of a source in d log(phi)/dt at each place


def mode_history(parameters: Parameters, theory_length: float) -> ModeHistory:
    """The mode of a run's creep, by the theory whose critical length is given (m).

    NoPatch if none turns unstable within the lengths looked at, or its creep opens the fault.
    """
    patches, loading = Patches.of(parameters), parameters.loading
    if not np.isfinite(theory_length):
        raise NoPatch("homogeneous sliding is stable", STABLE)
    start = loading.initial_state, loading.initial_shear_stress / loading.normal_stress
    stable = first_growing(patches, theory_length, *start)
    lengths = stable * np.linspace(FIRST, LAST, INSTANTS)
    for _ in range(NARROWED + 1):
        found = advance(patches, lengths, *start)
        rates = oscillating(found)
        known = followed(found.length, rates, stable)
        if known.size >= FEWEST:
            break
        middle = int(np.searchsorted(lengths, stable))
        first, last = (known[0], known[-1]) if known.size else (middle, middle - 1)
        low, high = lengths[max(first - 1, 0)], lengths[min(last + 1, INSTANTS - 1)]
        lengths = np.linspace(low, high, INSTANTS)
    else:
        raise NoPatch(
            f"growth begins at a patch length of {stable:.4g} m, and the mode does not oscillate "
            "long enough around it for its growth to be followed"
        )
    x = np.linspace(0.0, found.length[-1], PLACES)
    rows = [_weights(patches, found, int(i), complex(rates[i]), x) for i in known]
    columns: list[ComplexArray] = [np.array(column) for column in zip(*rows, strict=True)]
    load, drive, strength, state = columns
    memory = parameters.memory_time
    return ModeHistory(
        parameters, x, found.time[known], found.length[known], rates[known] / memory,
        load / memory, drive / memory, strength / memory, state,
    )  # fmt: skip


def followed(length: Array, rates: ComplexArray, stable: float) -> NDArray[np.intp]:
    """Indices of the lengths at which a rate is that of the mode whose growth begins at L_s.

    The mode is followed from L_s to either side, until it leaves its oscillation behind or the
    rate jumps: there another mode is the fastest growing one that oscillates.

    Parameters
    ----------
    length : patch lengths (m), rising, (n,).
    rates : Lambda of the fastest growing oscillating mode at each, NaN without one, (n,).
    stable : L_s (m).
    """
    at_stable = np.interp(stable, length, rates.imag)
    above = length > stable
    left = above & ~((rates.imag > SLOWED * at_stable) & (rates.real > 0.0))
    end = int(np.argmax(left)) if left.any() else length.size
    middle = int(np.searchsorted(length[:end], stable))
    first = last = min(middle, end - 1)
    while first > 0 and _continues(rates[first - 1 : first + 2]):
        first -= 1
    while last < end - 1 and _continues(rates[max(last - 1, 0) : last + 2][::-1]):
        last += 1
    known = np.arange(first, last + 1)
    return known[np.isfinite(rates[known])]


def _continues(rates: ComplexArray) -> bool:
    """Whether the first of three neighbouring rates is about where the others point to."""
    if not np.isfinite(rates).all():
        return False
    if rates.size < 3:
        return True
    step = rates[1] - rates[2]
    return bool(abs(rates[0] - rates[1] - step) < JUMP * abs(step))


def _weights(
    patches: Patches, found: Advance, i: int, rate: complex, x: Array
) -> tuple[complex, complex, ComplexArray, ComplexArray]:
    """The weights of a :class:`ModeHistory`, time in D/V."""
    patch, creep, law = found.patches[i], found.creeps[i], patches.law
    assert law is not None
    friction = local_coefficients(law, patches.velocity, creep.slip_rate, found.log_states[i])
    n = creep.slip_rate.size
    # a mode of largest displacement 1 and its conjugate swing the slip rate by 2 |Lambda|
    left = 2.0 * abs(rate) * patch.amplitude(rate)
    by_rate = left[:n] + patch.evolution_by_rate * left[n:]
    by_force = -by_rate / (creep.normal_stress * friction.by_rate)
    base = float(patches.one.friction[0])
    follows = creep.response.modes.values @ edge_slip(creep.response, base, base).rates
    drive = -complex(left[:n] @ follows) * rate / law.characteristic_slip_distance
    theta = creep.response.modes.theta
    places, shares = found.length[i] * np.cos(theta), np.sin(theta) * found.length[i]
    shares = shares * 0.5 * np.pi / n
    along = [
        np.interp(x, places[::-1], (weights / shares)[::-1], right=0.0) * (x[1] - x[0])
        for weights in (by_force * friction.friction * creep.normal_stress, left[n:])
    ]
    return complex(by_force @ friction.friction), drive, along[0], along[1]
