"""Which runs are of the same fault, and which differ in the seed of their perturbation alone.

Either is told by a digest of the parameters that count, which tables carry in a column: what looks
for the runs of a fault compares it, and nothing else. Numbers that differ by rounding are the same,
and a second body's values that are left out are those of the first.
"""

import dataclasses
import hashlib
import json
from functools import lru_cache

from .parameters import Parameters

NOT_PHYSICAL = (
    "geometry.length", "mesh", "second_body.n_y", "second_body.grading", "stepping", "perturbation",
    "recording",
)  # fmt: skip
"""Parameters and groups of them that are not of a fault but of how it is solved and shaken. The
block is to be so long that its length plays no role."""

LATER = {
    "material.plane": "strain", "loading.kind": "edge", "loading.stress_rate": 0.0,
    "heterogeneity.varies": "none", "heterogeneity.shape": "bump", "heterogeneity.centre": None,
    "heterogeneity.width": 0.1, "heterogeneity.change": 0.0,
}  # fmt: skip
"""Parameters that came later, with what all faults had before: their digests stay."""

DIGITS = 10  # significant, of numbers


def fault(parameters: Parameters) -> str:
    """The fault of a run: materials, friction, loads and start, heights and far sides."""
    return identity(parameters, *NOT_PHYSICAL)


def ensemble(parameters: Parameters) -> str:
    """The runs that one run is a realisation of: those that differ in the seed, or are recorded
    otherwise."""
    return identity(parameters, "perturbation.seed", "recording")


@lru_cache(2**14)
def identity(parameters: Parameters, *apart: str) -> str:
    """Digest of all parameters but some, given by full name (``mesh.n_x``) or group (``mesh``)."""
    values = parameters.named()
    if (below := parameters.below) is not None:
        own = {"bottom": below.bottom}
        for part in (below.material, below.geometry, below.mesh):
            own |= dataclasses.asdict(part)
        values |= {k: own[k.partition(".")[2]] for k in values if k.startswith("second_body.")
                   and k != "second_body.kind"}  # fmt: skip
    kept = {
        name: float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value
        for name, value in values.items()
        if name not in apart
        and name.partition(".")[0] not in apart
        and (name not in LATER or value != LATER[name])
    }
    digest = hashlib.sha256(json.dumps(kept, sort_keys=True).encode()).hexdigest()
    return digest[:12]  # thousands of faults never share so many
