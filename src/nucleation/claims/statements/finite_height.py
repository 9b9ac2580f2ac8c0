"""Claims of Sect. 5's theory (a block on a rigid base) and of Text S1."""

import math

import numpy as np

from ...types import Array, ComplexArray
from ..claim import Result
from ..evidence import Evidence
from ..independent import elastic_layers, marginal, printed
from ..independent.elastic_layers import HALF_SPACE, Layer, compliance, pair_transfer
from ..said import Ours, formula

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


def _block_ratios(evidence: Evidence) -> Array:
    """G1 and G2 by collocation over those of Eq. (10), shape (2, heights)."""
    nu = evidence.material.in_plane_ratio
    ours = np.array([block_transfer(q, evidence) for q in LAYER_NUMBERS])
    return (ours / [printed.block_transfer(q, nu) for q in LAYER_NUMBERS]).T


def block_g1(evidence: Evidence) -> Array:
    return _block_ratios(evidence)[0]


def block_g2(evidence: Evidence) -> Array:
    return _block_ratios(evidence)[1]


def block_high_limit(evidence: Evidence) -> Result:
    nu, high = evidence.material.in_plane_ratio, block(HALF_SPACE, evidence)
    coarse, fine = (g2 / g1 for g1, g2 in (pair_transfer(high, points=n) for n in (48, 64)))
    said = formula((1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)))
    return Result(Ours.within(fine, fine - coarse), said)


def block_thin_g1(evidence: Evidence) -> Result:
    ratios = [block_transfer(q, evidence)[0] / (2.0 * q) for q in (THIN, 2.0 * THIN)]
    limit = (4.0 * ratios[0] - ratios[1]) / 3.0
    said = formula(1.0 / (1.0 - evidence.material.in_plane_ratio), r"$1/(1 - \nu)$")
    return Result(Ours.within(limit, 1e-7 * limit), said)


def block_thin_g2(evidence: Evidence) -> float:
    g1, g2 = block_transfer(THIN, evidence)
    return g2 / g1


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


def thin_length(evidence: Evidence) -> Ours:
    one, quarter = (thin_ratio(FAR_BELOW * part, evidence) for part in (1.0, 0.25))
    limit = 2.0 * quarter - one
    return Ours.within(limit, limit - quarter)


def thin_agreement(evidence: Evidence) -> float:
    theory = evidence.theory.isel(height=0)
    return float(theory["thin_limit_length"] / theory["critical_length"])


def thin_deviation(evidence: Evidence) -> float:
    ratio = evidence.theory["thin_limit_length"] / evidence.theory["critical_length"]
    return float(ratio.interp(height=0.1)) - 1.0


def _matrix_difference(nu: float, q: float, expected: ComplexArray, points: int) -> float:
    ours = compliance(Layer(q, nu), points)
    return float(np.abs(ours - expected).max() / np.abs(expected).max())


def response_matrix(evidence: Evidence) -> list[float]:
    nu = evidence.material.in_plane_ratio
    return [
        _matrix_difference(nu, q, printed.response_matrix(q, nu), 40) for q in LAYER_NUMBERS[1:]
    ]


def response_matrix_limit(evidence: Evidence) -> float:
    nu = evidence.material.in_plane_ratio
    return _matrix_difference(nu, HALF_SPACE, printed.half_space_response(nu), 64)


def block_field(evidence: Evidence) -> list[float]:
    differences = []
    for q in LAYER_NUMBERS[1:]:
        y, u, w = elastic_layers.block_field(block(q, evidence), 40)
        field = printed.block_field(q, y / q, evidence.material.in_plane_ratio)
        field = field / field[0, 0]
        differences.append(max(np.abs(field[0] - u).max(), np.abs(field[1] - 1j * w).max()))
    return differences
