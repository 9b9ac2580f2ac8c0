"""Digests that identify the fault of a run, and the ensemble of its realisations.

Tables have these digests in a column; runs of the same fault are found by comparing it. Values
that differ only by round-off have the same digest, and a second body's value that is left out
counts as the first body's.
"""

import dataclasses
import hashlib
import json
from functools import lru_cache
from typing import Any

from .parameters import Parameters

_NOT_PHYSICAL = (
    "geometry.length",
    "mesh",
    "second_body.n_y",
    "second_body.grading",
    "stepping",
    "perturbation",
    "recording",
)
"""Parameters and groups that describe the solution and the perturbation, not the fault.

The block must be so long that its length has no effect.
"""

_ADDED_LATER = {
    "material.plane": "strain",
    "loading.kind": "edge",
    "loading.stress_rate": 0.0,
    "heterogeneity.varies": "none",
    "heterogeneity.shape": "bump",
    "heterogeneity.centre": None,
    "heterogeneity.width": 0.1,
    "heterogeneity.change": 0.0,
}
"""Parameters that were added later, with their earlier implicit values.

Digests leave them out where they have these values, so that earlier digests stay valid.
"""

DIGITS = 10  # significant, of numbers
_DIGEST_LENGTH = 12  # enough for thousands of faults


def fault(parameters: Parameters) -> str:
    """Digest of the fault: materials, friction, loads, initial state, heights and far sides."""
    return identity(parameters, *_NOT_PHYSICAL)


def ensemble(parameters: Parameters) -> str:
    """Digest of all parameters except the seed and the recording."""
    return identity(parameters, "perturbation.seed", "recording")


@lru_cache(2**14)
def identity(parameters: Parameters, *excluded: str) -> str:
    """Digest of the parameters.

    Parameters
    ----------
    parameters : Parameters
        All parameters of a run.
    *excluded : str
        Parameters that do not count, by full name (``mesh.n_x``) or group (``mesh``).

    Returns
    -------
    str
        Twelve hexadecimal digits.
    """
    kept = {}
    for name, value in _completed(parameters).items():
        if name in excluded or name.partition(".")[0] in excluded:
            continue
        if name in _ADDED_LATER and value == _ADDED_LATER[name]:
            continue
        rounded = isinstance(value, float)
        kept[name] = float(f"{value:.{DIGITS}g}") if rounded else value
    content = json.dumps(kept, sort_keys=True)
    return hashlib.sha256(content.encode()).hexdigest()[:_DIGEST_LENGTH]


def _completed(parameters: Parameters) -> dict[str, Any]:
    """Values by full name, with those that the second block has from the first."""
    values = parameters.named()
    below = parameters.below
    if below is None:
        return values
    own: dict[str, Any] = {"far_side": below.far_side}
    for part in (below.material, below.geometry, below.mesh):
        own |= dataclasses.asdict(part)
    for name in values:
        group, _, field = name.partition(".")
        if group == "second_body" and field != "kind":
            values[name] = own[field]
    return values
