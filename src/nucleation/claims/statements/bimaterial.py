"""Claims of Sect. 4 (bimaterial interfaces)."""

import itertools

import numpy as np

from ...types import Array
from ..claim import Result
from ..evidence import Evidence
from ..independent import marginal, printed
from ..independent.elastic_layers import half_spaces
from ..said import Ours, formula

PAIRS = ((2.0, 0.25, 0.3), (0.5, 0.3, 0.2), (5.0, 0.1, 0.4), (0.9, 0.33, 0.25))
"""psi, nu(1) and nu(2) of pairs of half-spaces."""

STRENGTHENING = ((0.01, -0.004), (0.007, -0.001), (0.02, -0.015))
"""a and zeta of velocity-strengthening interfaces."""


def pair_ratios() -> Array:
    """G1 and G2 by collocation over those of Eq. (7), for all PAIRS; shape (2, pairs)."""
    expected = [printed.bimaterial_transfer(*pair) for pair in PAIRS]
    return (np.array([half_spaces(nu, psi, nu2) for psi, nu, nu2 in PAIRS]) / expected).T


def bimaterial_g1(evidence: Evidence) -> Array:
    return pair_ratios()[0]


def bimaterial_g2(evidence: Evidence) -> Array:
    return pair_ratios()[1]


def bimaterial_modulus_limit(evidence: Evidence) -> Result:
    nu = evidence.material.in_plane_ratio
    coarse, fine = (2.0 * half_spaces(nu, points=points)[0] for points in (48, 64))
    return Result(Ours.within(fine, fine - coarse), formula(1.0 / (1.0 - nu), r"$1/(1 - \nu)$"))


def bimaterial_contrast_limit(evidence: Evidence) -> float:
    nu = evidence.material.in_plane_ratio
    couplings, contrasts = [], []
    for psi in (1.02, 1.01):
        g1, g2 = half_spaces(nu, psi)
        couplings.append(g2 / g1)
        contrasts.append(printed.bimaterial_contrast(psi, nu, nu))
    part = contrasts[1] / contrasts[0]
    return float((couplings[1] - part * couplings[0]) / (1.0 - part))


def bimaterial_length(evidence: Evidence) -> list[float]:
    return [
        z / marginal.half_space_load(f_beta, 1.0, z) / printed.bimaterial_ratio(f_beta, z)
        for f_beta, z in itertools.product(
            (0.02, 0.1, 0.3, 0.5), evidence.theory["zeta_over_a"].values
        )
    ]


def bimaterial_length_limit(evidence: Evidence) -> list[float]:
    return [
        z / marginal.half_space_load(0.0, 1.0, z) for z in evidence.theory["zeta_over_a"].values
    ]


def bimaterial_smaller(evidence: Evidence) -> float:
    ratio = evidence.theory["bimaterial_length_ratio"]
    return float(ratio.where(ratio["f_beta"] > 0.0).max())


def bimaterial_decreasing(evidence: Evidence) -> float:
    ratio = evidence.theory["bimaterial_length_ratio"]
    return float((ratio.diff("f_beta").values / np.diff(ratio["f_beta"].values)).max())


def strengthening_threshold(evidence: Evidence) -> list[float]:
    return [
        marginal.strengthening_threshold(a, zeta) / printed.strengthening_threshold(a, zeta)
        for a, zeta in STRENGTHENING
    ]


def strengthening_length(evidence: Evidence) -> list[float]:
    ratios = []
    for (a, zeta), factor in itertools.product(STRENGTHENING, (1.2, 2.0)):
        f_beta = factor * printed.strengthening_threshold(a, zeta)
        ours = zeta / marginal.half_space_load(f_beta, a, zeta)
        ratios.append(ours / printed.bimaterial_ratio(f_beta, zeta / a))
    return ratios
