"""Claims of Sect. 4 (bimaterial interfaces)."""

import itertools

import numpy as np
import xarray as xr

from ...types import Array
from ..claim import Computation, Result
from ..evidence import Evidence
from ..independent import marginal, printed
from ..independent.elastic_layers import half_spaces, refined
from ..said import formula

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
}
"""The claims whose numbers take a line; each of the others has a function with its name."""
