"""Claims on bimaterial interfaces (Sect. 4)."""

import itertools

import numpy as np
import xarray as xr

from nucleation.types import Array

from ..claim import Computation, Result
from ..evidence import Evidence
from ..expected import formula
from ..independent import marginal, printed
from ..independent.elastic_layers import half_spaces, refined
from ..independent.printed import over_formula

_PAIRS = (
    (2.0, 0.25, 0.3),
    (0.5, 0.3, 0.2),
    (5.0, 0.1, 0.4),
    (0.9, 0.33, 0.25),
)
"""psi, nu(1) and nu(2) of pairs of half-spaces."""

_CONTRASTS = (0.02, 0.1, 0.3, 0.5)
"""Values of f beta."""

_STRENGTHENING = (
    (0.01, -0.004),
    (0.007, -0.001),
    (0.02, -0.015),
)
"""a and zeta of velocity-strengthening interfaces."""


def _transfer_ratios(component: int) -> Array:
    """G1 (component 0) or G2 (component 1) by collocation over Eq. (7), for all pairs."""
    ratios = over_formula(
        lambda psi, nu, nu2: half_spaces(nu, psi, nu2), printed.bimaterial_transfer, _PAIRS
    )
    return ratios[:, component]


def bimaterial_modulus_limit(evidence: Evidence) -> Result:
    nu = evidence.nu
    ours = refined(lambda points: 2.0 * half_spaces(nu, points=points)[0])
    return Result(ours, formula(1.0 / (1.0 - nu), r"$1/(1 - \nu)$"))


def bimaterial_contrast_limit(evidence: Evidence) -> float:
    nu = evidence.nu
    far, near = 1.02, 1.01
    g1_far, g2_far = half_spaces(nu, far)
    g1_near, g2_near = half_spaces(nu, near)
    part = printed.bimaterial_contrast(near, nu, nu)
    part /= printed.bimaterial_contrast(far, nu, nu)
    difference = g2_near / g1_near - part * g2_far / g1_far
    return difference / (1.0 - part)


def _weakenings(evidence: Evidence) -> Array:
    """The zeta/a of Fig. 2."""
    return evidence.theory["zeta_over_a"].values


def _searched_ratio(f_beta: float, z: float) -> float:
    """L_c over L_c^M by search, for a zeta/a."""
    return z / marginal.half_space_load(f_beta, 1.0, z)


def bimaterial_length(evidence: Evidence) -> Array:
    cases = itertools.product(_CONTRASTS, _weakenings(evidence))
    return over_formula(_searched_ratio, printed.bimaterial_ratio, cases)


def bimaterial_length_limit(evidence: Evidence) -> list[float]:
    weakenings = _weakenings(evidence)
    return [_searched_ratio(0.0, z) for z in weakenings]


def _theory_ratio(evidence: Evidence) -> xr.DataArray:
    """L_c over L_c^M by the library's theory, on f beta and zeta/a."""
    return evidence.theory["bimaterial_length_ratio"]


def bimaterial_smaller(evidence: Evidence) -> xr.DataArray:
    ratio = _theory_ratio(evidence)
    different = ratio["f_beta"] > 0.0
    return ratio.where(different).max()


def bimaterial_decreasing(evidence: Evidence) -> xr.DataArray:
    ratio = _theory_ratio(evidence)
    steps = np.diff(ratio["f_beta"])
    slopes = ratio.diff("f_beta") / steps
    return slopes.max()


def strengthening_threshold(evidence: Evidence) -> Array:
    return over_formula(
        marginal.strengthening_threshold, printed.strengthening_threshold, _STRENGTHENING
    )


def strengthening_length(evidence: Evidence) -> list[float]:
    ratios = []
    for a, zeta in _STRENGTHENING:
        threshold = printed.strengthening_threshold(a, zeta)
        for factor in (1.2, 2.0):
            f_beta = factor * threshold
            ours = zeta / marginal.half_space_load(f_beta, a, zeta)
            ratios.append(ours / printed.bimaterial_ratio(f_beta, zeta / a))
    return ratios


SHORT: dict[str, Computation] = {
    "bimaterial-g1": lambda evidence: _transfer_ratios(0),
    "bimaterial-g2": lambda evidence: _transfer_ratios(1),
}
