"""Claims of Sect. 4 (bimaterial interfaces)."""

import itertools

import numpy as np

from ..claim import Result
from ..evidence import Evidence
from ..independent import marginal, printed
from ..independent.elastic_layers import HALF_SPACE, Layer, pair_transfer
from ..said import Ours, formula

PAIRS = ((2.0, 0.25, 0.3), (0.5, 0.3, 0.2), (5.0, 0.1, 0.4), (0.9, 0.33, 0.25))
"""psi, nu(1) and nu(2) of pairs of half-spaces."""

STRENGTHENING = ((0.01, -0.004), (0.007, -0.001), (0.02, -0.015))
"""a and zeta of velocity-strengthening interfaces."""


def pair_ratios(points: int = 64) -> np.ndarray:
    """G1 and G2 by collocation over those of Eq. (7), for all PAIRS; shape (pairs, 2)."""
    ratios = []
    for psi, nu1, nu2 in PAIRS:
        ours = pair_transfer(Layer(HALF_SPACE, nu1), Layer(-HALF_SPACE, nu2, psi), points)
        g1 = 0.5 * printed.bimaterial_modulus(psi, nu1, nu2)
        beta = printed.bimaterial_contrast(psi, nu1, nu2)
        ratios.append([ours[0] / g1, ours[1] / (beta * g1)])
    return np.array(ratios)


def bimaterial_g1(evidence: Evidence) -> Ours:
    return Ours.furthest(pair_ratios()[:, 0], target=1.0)


def bimaterial_g2(evidence: Evidence) -> Ours:
    return Ours.furthest(pair_ratios()[:, 1], target=1.0)


def bimaterial_modulus_limit(evidence: Evidence) -> Result:
    nu = evidence.material.in_plane_ratio
    values = [
        2.0 * pair_transfer(Layer(HALF_SPACE, nu), Layer(-HALF_SPACE, nu), points)[0]
        for points in (48, 64)
    ]
    said = formula(1.0 / (1.0 - nu), r"$1/(1 - \nu)$")
    return Result(Ours.within(values[1], values[1] - values[0]), said)


def bimaterial_contrast_limit(evidence: Evidence) -> Ours:
    nu = evidence.material.in_plane_ratio
    couplings, contrasts = [], []
    for psi in (1.02, 1.01):
        g1, g2 = pair_transfer(Layer(HALF_SPACE, nu), Layer(-HALF_SPACE, nu, psi))
        couplings.append(g2 / g1)
        contrasts.append(printed.bimaterial_contrast(psi, nu, nu))
    part = contrasts[1] / contrasts[0]
    return Ours.exactly((couplings[1] - part * couplings[0]) / (1.0 - part))


def bimaterial_length(evidence: Evidence) -> Ours:
    return Ours.furthest(
        [
            z / marginal.half_space_load(f_beta, 1.0, z) / printed.bimaterial_ratio(f_beta, z)
            for f_beta, z in itertools.product(
                (0.02, 0.1, 0.3, 0.5), evidence.theory["zeta_over_a"].values
            )
        ],
        target=1.0,
    )


def bimaterial_length_limit(evidence: Evidence) -> Ours:
    return Ours.furthest(
        [z / marginal.half_space_load(0.0, 1.0, z) for z in evidence.theory["zeta_over_a"].values],
        target=1.0,
    )


def bimaterial_smaller(evidence: Evidence) -> Ours:
    ratio = evidence.theory["bimaterial_length_ratio"]
    return Ours.exactly(ratio.where(ratio["f_beta"] > 0.0, drop=True).max())


def bimaterial_decreasing(evidence: Evidence) -> Ours:
    ratio = evidence.theory["bimaterial_length_ratio"]
    slopes = ratio.diff("f_beta").values / np.diff(ratio["f_beta"].values)
    return Ours.exactly(slopes.max())


def strengthening_threshold(evidence: Evidence) -> Ours:
    return Ours.furthest(
        [
            marginal.strengthening_threshold(a, zeta) / printed.strengthening_threshold(a, zeta)
            for a, zeta in STRENGTHENING
        ],
        target=1.0,
    )


def strengthening_length(evidence: Evidence) -> Ours:
    ratios = []
    for (a, zeta), factor in itertools.product(STRENGTHENING, (1.2, 2.0)):
        f_beta = factor * printed.strengthening_threshold(a, zeta)
        ours = zeta / marginal.half_space_load(f_beta, a, zeta)
        ratios.append(ours / printed.bimaterial_ratio(f_beta, zeta / a))
    return Ours.furthest(ratios, target=1.0)
