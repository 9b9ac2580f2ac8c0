"""Claims of Sect. 5's theory (a block on a rigid base) and of Text S1."""

from __future__ import annotations

import math

import numpy as np

from ..claim import Claim, Result, claim
from ..evidence import Evidence
from ..independent import marginal, printed
from ..independent.elastic_layers import HALF_SPACE, Layer, block_field, compliance, pair_transfer
from ..said import Ours, formula, words

CLAIMS: list[Claim] = []

LAYER_NUMBERS = (0.1, 0.3, 1.0, 3.0, 10.0)
THIN = 1e-3  # kH of a thin block
FAR_BELOW = 1e-5  # m: a height far below those of Fig. 3


def block(q: float, evidence: Evidence) -> Layer:
    """A block of kH = q, free of stress on top."""
    return Layer(q, evidence.material.in_plane_ratio, far_side="traction")


def block_transfer(q: float, evidence: Evidence) -> tuple[float, float]:
    """G1 and G2 of a block on a rigid base; thin ones need few points, and lose with more."""
    q = min(q, HALF_SPACE)
    return pair_transfer(block(q, evidence), points=16 if q < 0.1 else 32 if q < 10.0 else 64)


def _block_ratios(evidence: Evidence, which: int) -> Ours:
    nu = evidence.material.in_plane_ratio
    ratios = [
        block_transfer(q, evidence)[which] / printed.block_transfer(q, nu)[which]
        for q in LAYER_NUMBERS
    ]
    return Ours.furthest(ratios, target=1.0)


@claim(
    CLAIMS, id="block-g1", where="Eq. (10)",
    statement="G1 of a block of height H on a rigid base, constant stress on top.",
    quotation=r"G_1=\frac{4 (1-\nu ) (2 H k+\sinh (2 H k))}",
    method="Navier's equation by collocation over the formula, kH = 0.1 to 10; the worst",
    said=formula(1.0, "Eq. (10)"),
)  # fmt: skip
def block_g1(evidence: Evidence) -> Ours:
    return _block_ratios(evidence, 0)


@claim(
    CLAIMS, id="block-g2", where="Eq. (10)",
    statement="G2 of a block of height H on a rigid base, constant stress on top.",
    quotation=r"G_2=\frac{4 \left(H^2 k^2+(1-2 \nu ) \sinh ^2(H k)\right)}",
    method="Navier's equation by collocation over the formula, kH = 0.1 to 10; the worst",
    said=formula(1.0, "Eq. (10)"),
)  # fmt: skip
def block_g2(evidence: Evidence) -> Ours:
    return _block_ratios(evidence, 1)


@claim(
    CLAIMS, id="block-high-limit", where="Sect. 5 with Eqs. (7), (8)",
    statement="A high block on a rigid base is the pair of half-spaces with mu(2) -> infinity, "
    "G2/G1 = beta = (1 - 2 nu)/[2(1 - nu)].",
    quotation=r"once the limit $\mu\2\to\infty$ is taken",
    method="Navier's equation by collocation, kH = 40",
)  # fmt: skip
def block_high_limit(evidence: Evidence) -> Result:
    nu = evidence.material.in_plane_ratio
    values = []
    for points in (48, 64):
        g1, g2 = pair_transfer(block(HALF_SPACE, evidence), points=points)
        values.append(g2 / g1)
    said = formula((1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)))
    return Result(Ours.within(values[1], values[1] - values[0]), said)


@claim(
    CLAIMS, id="block-thin-g1", where="Sect. 5, above Eq. (11)",
    statement="G1 becomes 2Hk/(1 - nu) for Hk -> 0.",
    quotation=r"we find $G_1\simeq2 H k(1-\nu)^{-1}$",
    method="G1/(2Hk) by collocation at Hk = 0.002 and 0.001, extrapolated to zero",
)  # fmt: skip
def block_thin_g1(evidence: Evidence) -> Result:
    ratios = [block_transfer(q, evidence)[0] / (2.0 * q) for q in (THIN, 2.0 * THIN)]
    limit = (4.0 * ratios[0] - ratios[1]) / 3.0
    said = formula(1.0 / (1.0 - evidence.material.in_plane_ratio), "1/(1 - nu)")
    return Result(Ours.within(limit, 1e-7 * limit), said)


@claim(
    CLAIMS, id="block-thin-g2", where="Sect. 5, above Eq. (11)",
    statement="G2 is negligible beside G1 for Hk -> 0.",
    quotation=r"and $G_2\simeq0$",
    method="G2/G1 by collocation at Hk = 0.001", said=words("negligible"),
)  # fmt: skip
def block_thin_g2(evidence: Evidence) -> Ours:
    g1, g2 = block_transfer(THIN, evidence)
    return Ours.exactly(g2 / g1)


def thin_ratio(height: float, evidence: Evidence) -> float:
    """L_c by search, transfer functions by collocation, over Eq. (11)."""
    material, interface = evidence.material, evidence.interface
    thin = printed.thin_length(
        height, material.in_plane_ratio, interface.zeta, interface.normal_stress,
        material.shear_modulus, interface.slip_length,
    )  # fmt: skip
    k, _ = marginal.critical_wavenumber(
        lambda k: block_transfer(k * height, evidence), material.shear_modulus, interface,
        2.0 * math.pi / thin,
    )  # fmt: skip
    return 2.0 * math.pi / k / thin


@claim(
    CLAIMS, id="thin-length", where="Eq. (11)",
    statement="L_c becomes 2 pi sqrt{2 H mu ell/[zeta (1 - nu) sigma0]} for Hk -> 0.",
    quotation=r"2\pi \sqrt{\frac{2H \mu\,\ell }{\zeta  (1-\nu ) \sigma _0}}",
    method="L_c by search for H = 1e-5 m and a quarter of it, over the formula, extrapolated to "
    "zero along sqrt(H)", said=words("computed"),
)  # fmt: skip
def thin_length(evidence: Evidence) -> Ours:
    one, quarter = (thin_ratio(FAR_BELOW * part, evidence) for part in (1.0, 0.25))
    limit = 2.0 * quarter - one
    return Ours.within(limit, limit - quarter)


def _thin_over_curve(evidence: Evidence) -> np.ndarray:
    return (evidence.theory["thin_limit_length"] / evidence.theory["critical_length"]).values


@claim(
    CLAIMS, id="thin-agreement", where="Sect. 5 and Fig. 3",
    statement="Eq. (11) agrees perfectly with L_c(H) at small H.",
    quotation=r"perfect agreement at small $H$",
    method="Eq. (11) over L_c at the smallest height of Fig. 3's curve (results/theory.nc)",
    said=words("perfect"),
)  # fmt: skip
def thin_agreement(evidence: Evidence) -> Ours:
    return Ours.exactly(_thin_over_curve(evidence)[0])


@claim(
    CLAIMS, id="thin-deviation", where="Sect. 5 and Fig. 3",
    statement="Eq. (11) deviates significantly from L_c(H) at larger H.",
    quotation=r"significant deviations at larger $H$",
    method="Eq. (11) over L_c minus one at H = 0.1 m, interpolated (results/theory.nc)",
    said=words("significant"),
)  # fmt: skip
def thin_deviation(evidence: Evidence) -> Ours:
    heights = evidence.theory["height"].values
    return Ours.exactly(np.interp(0.1, heights, _thin_over_curve(evidence)) - 1.0)


def _matrix_difference(evidence: Evidence, q: float, expected: np.ndarray, points: int) -> float:
    ours = compliance(Layer(q, evidence.material.in_plane_ratio), points)
    return float(np.abs(ours - expected).max() / np.abs(expected).max())


@claim(
    CLAIMS, id="response-matrix", where="Eq. (S-general_M)",
    statement="The matrix M of a layer held at its far side.",
    quotation=r"-4 (1-\nu ) \sinh ^2(H k) & i (2 H k+(1-2 \nu ) \sinh (2 H k))",
    method="Navier's equation by collocation, kH = 0.3 to 10: largest difference of an entry over "
    "the largest entry", said=formula(0.0, "0"),
)  # fmt: skip
def response_matrix(evidence: Evidence) -> Ours:
    nu = evidence.material.in_plane_ratio
    return Ours.exactly(
        max(
            _matrix_difference(evidence, q, printed.response_matrix(q, nu), 40)
            for q in LAYER_NUMBERS[1:]
        )
    )


@claim(
    CLAIMS, id="response-matrix-limit", where="Eq. (S-M_inf)",
    statement="The matrix M of a half-space.",
    quotation=r"-2 (1-\nu) \text{sign}(Hk) & i (1-2 \nu )",
    method="the same for kH = 40", said=formula(0.0, "0"),
)  # fmt: skip
def response_matrix_limit(evidence: Evidence) -> Ours:
    expected = printed.half_space_response(evidence.material.in_plane_ratio)
    return Ours.exactly(_matrix_difference(evidence, HALF_SPACE, expected, 64))


@claim(
    CLAIMS, id="block-field", where="Eq. (S-sol_inf)",
    statement="The displacement field in a block on a rigid base.",
    quotation=r"2 q^2 \left(\tilde{y}-1\right) \cosh \left(q \tilde{y}\right)",
    method="Navier's equation by collocation, kH = 0.3 to 10: largest difference over the slip",
    said=formula(0.0, "0"),
)  # fmt: skip
def block_displacement(evidence: Evidence) -> Ours:
    differences = []
    for q in LAYER_NUMBERS[1:]:
        y, u, w = block_field(block(q, evidence), 40)
        field = printed.block_field(q, y / q, evidence.material.in_plane_ratio)
        field = field / field[0, 0]
        differences.append(max(np.abs(field[0] - u).max(), np.abs(field[1] - 1j * w).max()))
    return Ours.exactly(max(differences))
