"""The oscillating mode of the creeping patch along its creep, and its response to a forcing.

The patches of :mod:`nucleation.theory.creep.front` have everything that the law of the drop needs:
time and Lambda at each length, and the left eigenvector. The mode's complex amplitude A obeys

    dA/dt = Lambda A + eps g(t) xi,

scaled such that A = 1 where the slip rate swings by V. The left eigenvector gives g. By linearised
force balance each kind of forcing (:mod:`nucleation.model.settings`) acts as

    normal_load      f sigma eps xi(t)
    drive_velocity   a displacement U of the edge, with the slip ``p U``, ``(K1 + f S2) p = 0``
    strength         f sigma eps xi(x)
    state            eps (V/D) xi(x, t) in d(dpsi)/dt

An infinite block is loaded evenly, so that a load acts on friction alone. As in the frozen patch,
dl/dt and the nodes at the front that begin to slip are neglected (docs/creeping_patch.md). Either
changes growth by some 0.2 1/s, where Re Lambda reaches 3 1/s.
"""

import dataclasses
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..theory.creep.front import Advance, first_growing, oscillating
from ..theory.creep.linearised import edge_slip
from ..theory.creep.patches import Patches
from ..theory.status import STABLE, NoLength
from ..types import Array, ComplexArray

FIRST, LAST = 0.8, 1.7  # lengths over L_s that are followed
INSTANTS = 24  # number of lengths
SLOWED = 0.45  # frequency over that at L_s below which a patch no longer oscillates
FEWEST = 6  # instants from which trends can be made
NARROWED = 3  # number of times that a narrower range of lengths is tried for them
JUMP = 2.0  # change of the rate, over that to the next instant, at which another mode is fastest
PLACES = 400  # along x


@dataclasses.dataclass(frozen=True)
class ModeHistory:
    """The oscillating mode along the creep, on (instant) or (instant, x).

    The weights are those of ``A`` in each kind of forcing, for a mode with a slip rate that swings
    by V.
    """

    patches: Patches  # of the fault
    x: Array  # m
    time: Array  # s
    length: Array  # m
    rate: ComplexArray  # Lambda (1/s)
    normal_load: ComplexArray  # g (1/s) of a relative change of the load
    drive: ComplexArray  # g (1/(m s)) of a displacement of the driven edge
    strength: ComplexArray  # g (1/s) of a relative change of friction at each place
    state: ComplexArray  # g (1) of a source in d log(phi)/dt at each place


@lru_cache(maxsize=4)  # which perturbations of one fault share
def mode_history(
    patches: Patches, critical_length: float, initial_state: float, initial_stress: float = 0.0
) -> ModeHistory:
    """The mode of a fault's creep, at the instants at which it can be followed.

    The creep begins with phi0 (s) and a shear stress over sigma0; L_c is in m. Raises NoLength if
    no patch of the lengths tried turns unstable, its creep opens the fault, or the mode oscillates
    in too few of them.
    """
    if not np.isfinite(critical_length):
        raise NoLength("homogeneous sliding is stable", STABLE)
    stable = first_growing(patches, critical_length, initial_state, initial_stress)
    lengths = stable * np.linspace(FIRST, LAST, INSTANTS)
    for _ in range(NARROWED + 1):
        found = Advance(patches, lengths, initial_state, initial_stress)
        rates = oscillating(found)
        known = followed(found.length, rates, stable)
        if known.size >= FEWEST:
            break
        lengths = _narrower(lengths, known, stable)
    else:
        raise NoLength(
            f"growth begins at a patch length of {stable / critical_length:.4g} L_c, and the mode "
            "does not oscillate long enough around it to determine its growth"
        )
    x = np.linspace(0.0, found.length[-1], PLACES)
    rows = [_weights(patches, found, int(i), complex(rates[i]), x) for i in known]
    columns: list[ComplexArray] = [np.array(column) for column in zip(*rows, strict=True)]
    load, drive, strength, state = columns
    memory = patches.memory
    return ModeHistory(
        patches=patches,
        x=x,
        time=found.time[known],
        length=found.length[known],
        rate=rates[known] / memory,
        normal_load=load / memory,
        drive=drive / memory,
        strength=strength / memory,
        state=state,
    )


def _narrower(lengths: Array, known: NDArray[np.intp], stable: float) -> Array:
    """Lengths (m) over the narrower range in which the mode is known, or around L_s."""
    middle = int(np.searchsorted(lengths, stable))
    first, last = middle, middle - 1
    if known.size:
        first, last = known[0], known[-1]
    low = lengths[max(first - 1, 0)]
    high = lengths[min(last + 1, INSTANTS - 1)]
    return np.linspace(low, high, INSTANTS)


def followed(length: Array, rates: ComplexArray, stable: float) -> NDArray[np.intp]:
    """Indices of the lengths at which a rate belongs to the mode that begins to grow at L_s.

    The mode is followed from L_s to either side, until it no longer oscillates or the rate jumps:
    there another mode is the fastest growing one that oscillates.

    Takes length (m), stable (m). Returns: The indices, rising.
    """
    slowest = SLOWED * np.interp(stable, length, rates.imag)
    grows = (rates.imag > slowest) & (rates.real > 0.0)
    left = (length > stable) & ~grows
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
    """Whether the first of three neighbouring rates is near the line through the others."""
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
    patch, creep, friction = found.patches[i], found.creeps[i], found.frictions[i]
    modes = creep.response.modes
    places = creep.slip_rate.size
    # a mode with the largest displacement 1 and its conjugate swing the slip rate by 2 |Lambda|
    left = 2.0 * abs(rate) * patch.amplitude(rate)
    by_slip, by_state = left[:places], left[places:]
    by_rate = by_slip + patch.evolution_by_rate * by_state
    by_force = -by_rate / (creep.normal_stress * friction.by_rate)
    uniform = patches.constants[0]
    slip_of_edge = modes.values @ edge_slip(creep.response, uniform, uniform)[0]
    drive = -complex(by_slip @ slip_of_edge) * rate / found.distance
    position = found.length[i] * np.cos(modes.theta)
    spacing = np.sin(modes.theta) * found.length[i]
    spacing = spacing * 0.5 * np.pi / places

    def along_x(weights: ComplexArray) -> ComplexArray:
        density = weights / spacing
        along = np.interp(x, position[::-1], density[::-1], right=0.0)
        return along * (x[1] - x[0])

    load = complex(by_force @ friction.friction)
    strength = along_x(by_force * friction.friction * creep.normal_stress)
    return load, drive, strength, along_x(by_state)
