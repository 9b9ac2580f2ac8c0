"""Claims of Sect. 5's theory (a block on a rigid base) and of Text S1."""

import math

import numpy as np

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


def _block_ratios(evidence: Evidence, which: int) -> Ours:
    nu = evidence.material.in_plane_ratio
    ratios = [
        block_transfer(q, evidence)[which] / printed.block_transfer(q, nu)[which]
        for q in LAYER_NUMBERS
    ]
    return Ours.furthest(ratios, target=1.0)


def block_g1(evidence: Evidence) -> Ours:
    return _block_ratios(evidence, 0)


def block_g2(evidence: Evidence) -> Ours:
    return _block_ratios(evidence, 1)


def block_high_limit(evidence: Evidence) -> Result:
    nu = evidence.material.in_plane_ratio
    values = []
    for points in (48, 64):
        g1, g2 = pair_transfer(block(HALF_SPACE, evidence), points=points)
        values.append(g2 / g1)
    said = formula((1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)))
    return Result(Ours.within(values[1], values[1] - values[0]), said)


def block_thin_g1(evidence: Evidence) -> Result:
    ratios = [block_transfer(q, evidence)[0] / (2.0 * q) for q in (THIN, 2.0 * THIN)]
    limit = (4.0 * ratios[0] - ratios[1]) / 3.0
    said = formula(1.0 / (1.0 - evidence.material.in_plane_ratio), r"$1/(1 - \nu)$")
    return Result(Ours.within(limit, 1e-7 * limit), said)


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


def thin_length(evidence: Evidence) -> Ours:
    one, quarter = (thin_ratio(FAR_BELOW * part, evidence) for part in (1.0, 0.25))
    limit = 2.0 * quarter - one
    return Ours.within(limit, limit - quarter)


def _thin_over_curve(evidence: Evidence) -> np.ndarray:
    return (evidence.theory["thin_limit_length"] / evidence.theory["critical_length"]).values


def thin_agreement(evidence: Evidence) -> Ours:
    return Ours.exactly(_thin_over_curve(evidence)[0])


def thin_deviation(evidence: Evidence) -> Ours:
    heights = evidence.theory["height"].values
    return Ours.exactly(np.interp(0.1, heights, _thin_over_curve(evidence)) - 1.0)


def _matrix_difference(evidence: Evidence, q: float, expected: np.ndarray, points: int) -> float:
    ours = compliance(Layer(q, evidence.material.in_plane_ratio), points)
    return float(np.abs(ours - expected).max() / np.abs(expected).max())


def response_matrix(evidence: Evidence) -> Ours:
    nu = evidence.material.in_plane_ratio
    return Ours.exactly(
        max(
            _matrix_difference(evidence, q, printed.response_matrix(q, nu), 40)
            for q in LAYER_NUMBERS[1:]
        )
    )


def response_matrix_limit(evidence: Evidence) -> Ours:
    expected = printed.half_space_response(evidence.material.in_plane_ratio)
    return Ours.exactly(_matrix_difference(evidence, HALF_SPACE, expected, 64))


def block_field(evidence: Evidence) -> Ours:
    differences = []
    for q in LAYER_NUMBERS[1:]:
        y, u, w = elastic_layers.block_field(block(q, evidence), 40)
        field = printed.block_field(q, y / q, evidence.material.in_plane_ratio)
        field = field / field[0, 0]
        differences.append(max(np.abs(field[0] - u).max(), np.abs(field[1] - 1j * w).max()))
    return Ours.exactly(max(differences))
