"""Claims on bimaterial interfaces (Sect. 4) and blocks on a rigid base (Sect. 5, Text S1)."""

import itertools
import math

import numpy as np
import xarray as xr

from ...types import Array
from ..claim import Computation, Result
from ..evidence import Evidence
from ..independent import elastic_layers, marginal, printed
from ..independent.elastic_layers import (
    HALF_SPACE,
    Layer,
    compliance,
    half_spaces,
    pair_transfer,
    refined,
)
from ..said import Ours, formula

PAIRS = ((2.0, 0.25, 0.3), (0.5, 0.3, 0.2), (5.0, 0.1, 0.4), (0.9, 0.33, 0.25))
"""psi, nu(1) and nu(2) of pairs of half-spaces."""

STRENGTHENING = ((0.01, -0.004), (0.007, -0.001), (0.02, -0.015))
"""a and zeta of velocity-strengthening interfaces."""


def pair_ratios() -> Array:
    """G1 and G2 by collocation over those of Eq. (7), for all PAIRS; shape (2, pairs)."""
    expected = [printed.bimaterial_transfer(*pair) for pair in PAIRS]
    return (np.array([half_spaces(nu, psi, nu2) for psi, nu, nu2 in PAIRS]) / expected).T


def bimaterial_contrast_limit(evidence: Evidence) -> float:
    nu, differences = evidence.nu, (1.02, 1.01)
    g1, g2 = np.transpose([half_spaces(nu, psi) for psi in differences])
    contrasts = [printed.bimaterial_contrast(psi, nu, nu) for psi in differences]
    part = contrasts[1] / contrasts[0]
    return float((g2[1] / g1[1] - part * g2[0] / g1[0]) / (1.0 - part))


def searched(evidence: Evidence, f_beta: float) -> list[float]:
    """L_c over L_c^M by search, for the zeta/a of Fig. 2."""
    weakenings = evidence.theory["zeta_over_a"].values
    return [z / marginal.half_space_load(f_beta, 1.0, z) for z in weakenings]


def bimaterial_length(evidence: Evidence) -> list[Array]:
    weakenings = evidence.theory["zeta_over_a"].values
    return [
        np.divide(
            searched(evidence, f_beta), [printed.bimaterial_ratio(f_beta, z) for z in weakenings]
        )
        for f_beta in (0.02, 0.1, 0.3, 0.5)
    ]


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


def theory_ratio(evidence: Evidence) -> xr.DataArray:
    return evidence.theory["bimaterial_length_ratio"]


LAYER_NUMBERS = (0.1, 0.3, 1.0, 3.0, 10.0)
THIN = 1e-3  # kH of a thin block
FAR_BELOW = 1e-5  # m: a height far below those of Fig. 3


def block(q: float, evidence: Evidence) -> Layer:
    """A block of kH = q, free of stress on top."""
    return Layer(q, evidence.nu, far_side="traction")


def block_transfer(q: float, evidence: Evidence) -> tuple[float, float]:
    """G1 and G2 of a block on a rigid base; thin ones need few points, and lose with more."""
    q = min(q, HALF_SPACE)
    return pair_transfer(block(q, evidence), points=16 if q < 0.1 else 32 if q < 10.0 else 64)


def _block_ratios(evidence: Evidence) -> Array:
    """G1 and G2 by collocation over those of Eq. (10), shape (2, heights)."""
    nu = evidence.nu
    ours = np.array([block_transfer(q, evidence) for q in LAYER_NUMBERS])
    return (ours / [printed.block_transfer(q, nu) for q in LAYER_NUMBERS]).T


def block_high_limit(evidence: Evidence) -> Result:
    nu = evidence.nu

    def coupling(points: int) -> float:
        g1, g2 = pair_transfer(block(HALF_SPACE, evidence), points=points)
        return g2 / g1

    return Result(refined(coupling), formula((1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))))


def block_thin_g1(evidence: Evidence) -> Result:
    ratios = [block_transfer(q, evidence)[0] / (2.0 * q) for q in (THIN, 2.0 * THIN)]
    limit = (4.0 * ratios[0] - ratios[1]) / 3.0
    said = formula(1.0 / (1.0 - evidence.nu), r"$1/(1 - \nu)$")
    return Result(Ours.within(limit, 1e-7 * limit), said)


def thin_ratio(height: float, evidence: Evidence) -> float:
    """L_c by search, transfer functions by collocation, over Eq. (11)."""
    modulus, interface = evidence.material.shear_modulus, evidence.interface
    thin = printed.thin_length(height, evidence.nu, modulus, interface)
    k, _ = marginal.critical_wavenumber(
        lambda k: block_transfer(k * height, evidence), modulus, interface, 2.0 * math.pi / thin
    )
    return 2.0 * math.pi / k / thin


def thin_length(evidence: Evidence) -> Ours:
    one, quarter = (thin_ratio(FAR_BELOW * part, evidence) for part in (1.0, 0.25))
    limit = 2.0 * quarter - one
    return Ours.within(limit, limit - quarter)


def thin_over_curve(evidence: Evidence) -> xr.DataArray:
    """Eq. (11) over L_c at the heights of Fig. 3's curve."""
    return evidence.theory["thin_limit_length"] / evidence.theory["critical_length"]


def matrix_difference(evidence: Evidence, q: float, points: int = 40) -> float:
    """Largest difference of a layer's matrix M from the printed one, over its largest entry."""
    nu, high = evidence.nu, q == HALF_SPACE
    expected = printed.half_space_response(nu) if high else printed.response_matrix(q, nu)
    difference = compliance(Layer(q, nu), points) - expected
    return float(np.abs(difference).max() / np.abs(expected).max())


def block_field(evidence: Evidence) -> list[float]:
    differences = []
    for q in LAYER_NUMBERS[1:]:
        y, u, w = elastic_layers.block_field(block(q, evidence), 40)
        field = printed.block_field(q, y / q, evidence.nu)
        field = field / field[0, 0]
        differences.append(max(np.abs(field[0] - u).max(), np.abs(field[1] - 1j * w).max()))
    return differences


OURS: dict[str, Computation] = {
    "bimaterial-g1": lambda e: pair_ratios()[0],
    "bimaterial-g2": lambda e: pair_ratios()[1],
    "bimaterial-modulus-limit": lambda e: Result(
        refined(lambda points: 2.0 * half_spaces(e.nu, points=points)[0]),
        formula(1.0 / (1.0 - e.nu), r"$1/(1 - \nu)$"),
    ),
    "bimaterial-length-limit": lambda e: searched(e, 0.0),
    "bimaterial-smaller": lambda e: theory_ratio(e).where(theory_ratio(e)["f_beta"] > 0.0).max(),
    "bimaterial-decreasing": lambda e: (
        theory_ratio(e).diff("f_beta") / np.diff(theory_ratio(e)["f_beta"])
    ).max(),
    "block-g1": lambda e: _block_ratios(e)[0],
    "block-g2": lambda e: _block_ratios(e)[1],
    "block-thin-g2": lambda e: np.divide(*block_transfer(THIN, e)[::-1]),
    "thin-agreement": lambda e: thin_over_curve(e)[0],
    "thin-deviation": lambda e: thin_over_curve(e).interp(height=0.1) - 1.0,
    "response-matrix": lambda e: [matrix_difference(e, q) for q in LAYER_NUMBERS[1:]],
    "response-matrix-limit": lambda e: matrix_difference(e, HALF_SPACE, 64),
}
"""The claims whose numbers take a line; each of the others has a function with its name."""
