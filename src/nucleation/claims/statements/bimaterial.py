"""Claims of Sect. 4 (bimaterial interfaces)."""

from __future__ import annotations

import itertools

import numpy as np

from ..claim import Claim, Result, claim
from ..evidence import Evidence
from ..independent import marginal, printed
from ..independent.elastic_layers import HALF_SPACE, Layer, pair_transfer
from ..said import Ours, below, formula

CLAIMS: list[Claim] = []

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


@claim(
    CLAIMS, id="bimaterial-g1", where="Eqs. (7), (8)",
    statement="Two different half-spaces have G1 = M/(2 mu).",
    quotation=r"G_1=\frac{{\C M}}{2 \mu}\text{sign}(k)",
    method="Navier's equation by collocation over the formula, four pairs of materials; the worst",
    said=formula(1.0, "Eq. (7)"),
)  # fmt: skip
def bimaterial_g1(evidence: Evidence) -> Ours:
    return Ours.furthest(pair_ratios()[:, 0], target=1.0)


@claim(
    CLAIMS, id="bimaterial-g2", where="Eqs. (7), (8)",
    statement="Two different half-spaces have G2 = beta M/(2 mu).",
    quotation=r"G_2=\frac{\beta {\C M}}{2\mu}",
    method="Navier's equation by collocation over the formula, four pairs of materials; the worst",
    said=formula(1.0, "Eq. (7)"),
)  # fmt: skip
def bimaterial_g2(evidence: Evidence) -> Ours:
    return Ours.furthest(pair_ratios()[:, 1], target=1.0)


@claim(
    CLAIMS, id="bimaterial-modulus-limit", where="Sect. 4, below Eq. (8)",
    statement="M becomes mu/(1 - nu) for identical materials.",
    quotation=r"which approaches $\mu/(1-\nu)$ in the identical materials limit",
    method="2 mu G1 of two identical half-spaces by collocation, over mu",
)  # fmt: skip
def bimaterial_modulus_limit(evidence: Evidence) -> Result:
    nu = evidence.material.in_plane_ratio
    values = [
        2.0 * pair_transfer(Layer(HALF_SPACE, nu), Layer(-HALF_SPACE, nu), points)[0]
        for points in (48, 64)
    ]
    said = formula(1.0 / (1.0 - nu), "1/(1 - nu)")
    return Result(Ours.within(values[1], values[1] - values[0]), said)


@claim(
    CLAIMS, id="bimaterial-contrast-limit", where="Sect. 4, below Eq. (8)",
    statement="beta, and with it G2, vanishes in the limit of identical materials.",
    quotation=r"vanishes in the identical materials limit",
    method="G2/G1 of half-spaces whose moduli differ by 2 % and 1 %, by collocation, extrapolated "
    "to no difference with the ratio of the two by Eq. (8)", said=formula(0.0, "0"),
)  # fmt: skip
def bimaterial_contrast_limit(evidence: Evidence) -> Ours:
    nu = evidence.material.in_plane_ratio
    couplings, contrasts = [], []
    for psi in (1.02, 1.01):
        g1, g2 = pair_transfer(Layer(HALF_SPACE, nu), Layer(-HALF_SPACE, nu, psi))
        couplings.append(g2 / g1)
        contrasts.append(printed.bimaterial_contrast(psi, nu, nu))
    part = contrasts[1] / contrasts[0]
    return Ours.exactly((couplings[1] - part * couplings[0]) / (1.0 - part))


@claim(
    CLAIMS, id="bimaterial-length", where="Eq. (9)",
    statement="The closed form of L_c for two different half-spaces.",
    quotation=r"\frac{\pi {\C M} \ell}{\zeta \sigma_0}",
    method="largest wavenumber with a growing root of Eq. (5), by search, over the formula; "
    "f beta = 0.02 to 0.5, zeta/a of Fig. 2; the worst",
    said=formula(1.0, "Eq. (9)"),
)  # fmt: skip
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


@claim(
    CLAIMS, id="bimaterial-length-limit", where="Eqs. (6), (9)",
    statement="Without contrast Eq. (9) is Eq. (6) with M in the place of mu/(1 - nu).",
    quotation=r"is obtained by replacing $\mu/(1-\nu)$ in our result in "
    r"Eq.~\eqref{eq:half_spaces} by the effective modulus ${\C M}$",
    method="L_c/L_c^M at f beta = 0, by search; the worst over zeta/a of Fig. 2",
    said=formula(1.0, "1"),
)  # fmt: skip
def bimaterial_length_limit(evidence: Evidence) -> Ours:
    return Ours.furthest(
        [z / marginal.half_space_load(0.0, 1.0, z) for z in evidence.theory["zeta_over_a"].values],
        target=1.0,
    )


@claim(
    CLAIMS, id="bimaterial-smaller", where="Sect. 4 and Fig. 2",
    statement="L_c of bimaterial interfaces is smaller than L_c^M.",
    quotation=r"is generically {\em smaller} than the conventional estimate $L_c^{\cal M}$",
    method="largest L_c/L_c^M over all f beta > 0 and zeta/a of Fig. 2 (results/theory.nc)",
    said=below(1.0),
)  # fmt: skip
def bimaterial_smaller(evidence: Evidence) -> Ours:
    ratio = evidence.theory["bimaterial_length_ratio"]
    return Ours.exactly(ratio.where(ratio["f_beta"] > 0.0, drop=True).max())


@claim(
    CLAIMS, id="bimaterial-decreasing", where="Sect. 4 and Fig. 2",
    statement="L_c decreases with increasing bimaterial contrast.",
    quotation=r"one expects $L_c$ to decrease with increasing bimaterial contrast",
    method="largest slope of L_c/L_c^M against f beta, all zeta/a of Fig. 2 (results/theory.nc)",
    said=below(0.0),
)  # fmt: skip
def bimaterial_decreasing(evidence: Evidence) -> Ours:
    ratio = evidence.theory["bimaterial_length_ratio"]
    slopes = ratio.diff("f_beta").values / np.diff(ratio["f_beta"].values)
    return Ours.exactly(slopes.max())


@claim(
    CLAIMS, id="strengthening-threshold", where="Sect. 4, below Eq. (9)",
    statement="With velocity strengthening, sliding is unstable from "
    "f beta = 2 sqrt(-a zeta)/(a + zeta) on.",
    quotation=r"$f\beta\ge\frac{2\sqrt{-a \zeta }}{a+\zeta}$",
    method="least f beta with a growing root of Eq. (5), by search, over the formula; three pairs "
    "of a and zeta; the worst", said=formula(1.0, "the threshold"),
)  # fmt: skip
def strengthening_threshold(evidence: Evidence) -> Ours:
    return Ours.furthest(
        [
            marginal.strengthening_threshold(a, zeta) / printed.strengthening_threshold(a, zeta)
            for a, zeta in STRENGTHENING
        ],
        target=1.0,
    )


@claim(
    CLAIMS, id="strengthening-length", where="Sect. 4, below Eq. (9)",
    statement="Eq. (9) gives L_c for velocity strengthening too.",
    quotation=r"remains valid also in the presence of velocity-strengthening friction, $\zeta<0$",
    method="L_c by search over the formula at 1.2 and 2 times the threshold; the worst",
    said=formula(1.0, "Eq. (9)"),
)  # fmt: skip
def strengthening_length(evidence: Evidence) -> Ours:
    ratios = []
    for (a, zeta), factor in itertools.product(STRENGTHENING, (1.2, 2.0)):
        f_beta = factor * printed.strengthening_threshold(a, zeta)
        ours = zeta / marginal.half_space_load(f_beta, a, zeta)
        ratios.append(ours / printed.bimaterial_ratio(f_beta, zeta / a))
    return Ours.furthest(ratios, target=1.0)
