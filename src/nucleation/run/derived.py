"""What follows from a run: digests of its fault and its ensemble, its expected drop.

Tables have the digests in a column; runs of the same fault are found by comparing them. Values that
differ only by round-off have the same digest.
"""

import hashlib
import json
from functools import lru_cache
from typing import TYPE_CHECKING

from ..fault.parameters import names_of
from ..theory.critical import critical_length_of
from .checks import require_uniform_edge
from .run import Run

if TYPE_CHECKING:
    from ..drop.expected_drop import ExpectedDrop

DIGITS = 10  # significant, of numbers
_DIGEST_LENGTH = 12  # enough for thousands of faults


def fault(run: Run) -> str:
    """Digest of the fault: materials, friction, loads, initial state, heights and far sides.

    The block must be so long that its length has no effect.
    """
    return identity(run, *names_of("block", "stepping", "perturbation"))


def ensemble(run: Run) -> str:
    """Digest of all parameters except the seed and the recording."""
    return identity(run, "seed", "record")


@lru_cache(2**14)
def identity(run: Run, *excluded: str) -> str:
    """Digest, of twelve digits, of the parameters but those with the names `excluded`."""
    kept = {}
    for name, value in run.to_dict().items():
        if name not in excluded:
            rounded = isinstance(value, float)
            kept[name] = float(f"{value:.{DIGITS}g}") if rounded else value
    content = json.dumps(kept, sort_keys=True)
    return hashlib.sha256(content.encode()).hexdigest()[:_DIGEST_LENGTH]


def drop_of_run(run: Run) -> "ExpectedDrop":
    """The expected drop of a uniform run that is pushed at its edge; raises NoLength."""
    from ..drop.expected_drop import expected_drop

    require_uniform_edge(run)
    fault = run.fault
    return expected_drop(
        run.patches,
        run.perturbation,
        critical_length_of(fault),
        fault.initial_state,
        run.start.initial_shear_stress / fault.normal_stress,
        (run.block.length, fault.height),
    )
