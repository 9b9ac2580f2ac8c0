"""L_run and W_c in the page: tables that take minutes, which the workflow makes (``patch_tables``).

L_run over L_s depends on zeta/a and on the height; Poisson's ratio and f change it by a few per
cent, and have one value here. W_c over L_c of identical half-spaces depends on zeta/a, on how much
the surroundings strengthen, ``-outside_zeta/zeta``, and on their direct effect over the patch's.
"""

import json
from functools import partial
from typing import Any

import numpy as np

from nucleation.theory.arrays import critical_length
from nucleation.theory.creep.lengths import stability_length
from nucleation.theory.creep.runaway import runaway_length
from nucleation.theory.weakening_patch import weakening_patch_length
from nucleation.types import Array

from .stability import FAULT, B
from .tabulated import PLACES, Table, height_at, tabulate

RUNAWAY_PRECISION = {"rigid_base": 0.12, "identical_layers": 0.06}
"""Relative error of L_run in the page, against
:func:`~nucleation.theory.creep.runaway.runaway_length`; tested for random faults."""
PATCH_PRECISION = 0.01
"""Likewise of W_c, against :func:`~nucleation.theory.weakening_patch.weakening_patch_length`."""

_FAULT = {**FAULT, "poisson_ratio": 0.25}
_FRICTION_LENGTH = 0.05 / 0.75  # m: mu D/[(1 - nu) b sigma0] of this fault


def _over_stability(place: Array, zeta_over_a: Array, **more: Any) -> Array:
    """L_run over L_s; without further parameters of two identical layers."""
    fault: dict[str, Any] = {
        **_FAULT,
        "a": B / (1.0 + zeta_over_a),
        "height": height_at(place) * _FRICTION_LENGTH,
        **more,
    }
    return np.asarray(runaway_length(**fault) / stability_length(**fault))


def _smallest_patch(
    zeta_over_a: Array,
    strengthening: Array,
    outside_a_over_a: Array,
) -> Array:
    """W_c over L_c between identical half-spaces; the arguments broadcast."""
    a = B / (1.0 + zeta_over_a)
    width = weakening_patch_length(
        outside_zeta=-strengthening * (B - a),
        outside_a=outside_a_over_a * a,
        a=a,
        **_FAULT,
    )
    return np.asarray(width / critical_length(a=a, **_FAULT))


_WEAK = {"place": PLACES, "zeta_over_a": (0.4, 2.0)}
_on_rigid_base = partial(
    _over_stability,
    friction=0.4,
    second_shear_modulus=np.inf,
)
RUNAWAY = {
    "rigid_base": Table(_on_rigid_base, _WEAK, (5, 3)),
    "identical_layers": Table(_over_stability, _WEAK, (5, 3)),
}
"""By the names of the systems in the page."""
PATCH = Table(
    _smallest_patch,
    {
        "zeta_over_a": (0.4, 20.0),
        "strengthening": (0.1, 10.0),
        "outside_a_over_a": (0.5, 2.0),
    },
    (5, 5, 3),
)


def files() -> dict[str, str]:
    """The step ``patch_tables``: all tables as JSON, by file extension."""
    tables = {
        "runaway": {name: tabulate(table) for name, table in RUNAWAY.items()},
        "runaway_precision": RUNAWAY_PRECISION,
        "patch": tabulate(PATCH),
        "patch_precision": PATCH_PRECISION,
    }
    return {".json": json.dumps(tables, indent=1)}
