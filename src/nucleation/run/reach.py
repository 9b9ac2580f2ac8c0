"""How long the patch of a run becomes until the force drops: its block and end follow from that."""

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..fault import Fault
from ..model.friction import Friction
from ..model.settings import Perturbation, Start
from ..theory.evaluation import single_system
from ..theory.status import NoLength

if TYPE_CHECKING:
    from ..theory.creep.patches import Patches

QUIET = Perturbation(kind="normal_load", strength=1e-9)
"""In place of no perturbation: what a fine mesh does by itself (docs/drop.md)."""

_LATER = 1.3  # longest drop over the longest L_run that is sought


class Reach(NamedTuple):
    """Lengths (m) of the patch of a run."""

    unstable: float  # L_s; NaN if not known
    drop: float  # the expected L; the longest it may be, if not known
    latest: float  # upper end of its range


def patches_of(fault: Fault, law: Friction, start: Start) -> "Patches":
    """The creeping patches of a single fault with a friction law.

    They begin at the edge that is pushed, or in the interior under a remote load.
    """
    from ..theory.creep.patches import Patches  # a simulation does without, as without all below

    one = single_system(fault)
    if fault.loading == "edge":
        return Patches(one, law, fault.velocity, evolution=law.evolution)
    rate = start.stress_rate * law.slip_distance / (fault.velocity * fault.normal_stress)
    return Patches(
        one, law, fault.velocity, evolution=law.evolution, loading="remote", load_rate=rate
    )


def longest_reach(fault: Fault, critical: float) -> float:
    """A length (m) that no drop of a fault with L_c (m) is beyond, in no time.

    It is L_c, and where friction weakens little above all L_run that is known.
    """
    from ..theory.creep.patches import Patches
    from ..theory.creep.runaway import GUESS, LONGEST, WEAK
    from ..theory.creep.slow_slip import cohesive_wavenumber

    if fault.zeta >= WEAK * fault.a:
        return critical
    wavenumber = cohesive_wavenumber(Patches(single_system(fault)), critical)
    ratio = critical * wavenumber / (2.0 * math.pi)
    return max(1.0, _LATER * GUESS * LONGEST * ratio) * critical


@lru_cache(maxsize=256)  # realisations share it
def reach_of(
    fault: Fault, law: Friction, start: Start, declared: Perturbation, critical: float
) -> Reach:
    """The lengths of a fault's patch under a perturbation, by theory; L_c is in m.

    It takes a second or two; :func:`longest_reach` takes none.
    """
    from ..drop.expected_drop import expected_drop
    from ..theory.creep.lengths import stability_length_of

    patches = patches_of(fault, law, start)
    stable = stability_length_of(patches, critical)
    most = longest_reach(fault, critical)
    try:
        known = expected_drop(
            patches,
            declared if declared.acts else QUIET,
            critical,
            fault.initial_state,
            start.initial_shear_stress / fault.normal_stress,
        )
    except NoLength:
        return Reach(stable, most, most)
    uncertain = known.weak and math.isnan(known.runaway.length)
    if uncertain or not np.isfinite([known.length, known.high]).all():
        return Reach(stable, most, most)
    return Reach(stable, known.length, known.high)
