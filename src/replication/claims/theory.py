"""Claims that need no run: homogeneous sliding, half-spaces and blocks.

Our numbers are those of the library's theory. Tests compare the paper's formulas, and the library,
with evaluations that use neither (tests/claims/test_formulas.py).
"""

import itertools
import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr

from nucleation.fault.fault import Fault
from nucleation.theory.closed_forms import bimaterial_length_ratio, thin_limit_length
from nucleation.theory.pair import Layers
from nucleation.theory.spectrum import marginal_stiffness
from nucleation.types import Array, ComplexArray

from . import printed
from .evidence import Evidence
from .verdicts import Computation, Estimate, Result, between, formula

PAIRS = ((2.0, 0.25, 0.3), (0.5, 0.3, 0.2), (5.0, 0.1, 0.4), (0.9, 0.33, 0.25))
"""psi, nu(1) and nu(2) of pairs of half-spaces."""

CONTRASTS = (0.02, 0.1, 0.3, 0.5)
"""Values of f beta."""

STRENGTHENING = ((0.01, -0.004), (0.007, -0.001), (0.02, -0.015))
"""a and zeta of velocity-strengthening interfaces."""

LAYER_NUMBERS = np.array([0.1, 0.3, 1.0, 3.0, 10.0])
"""Values of kH."""

HALF_SPACE = 40.0
"""kH of a body that counts as a half-space."""

_OF_BOTH = ("shear_modulus", "normal_stress", "friction", "a", "zeta", "slip_distance", "velocity")


def main_text(evidence: Evidence, **changes: Any) -> Fault:
    """Two identical half-spaces with the main text's friction, and changes."""
    kept = {name: getattr(evidence.interface, name) for name in _OF_BOTH}
    return Fault(**kept | {"poisson_ratio": evidence.nu} | changes)


def block(evidence: Evidence, height: float | Array) -> Fault:
    """A block of a height (m) on a rigid base, with the main text's friction."""
    return main_text(evidence, height=height, second_shear_modulus=math.inf)


def _coupling(evidence: Evidence, q: float) -> float:
    """G2 over G1 of a block of kH = q on a rigid base."""
    g1, g2 = block(evidence, q).transfer_functions(1.0)
    return float(g2 / g1)


# -- homogeneous sliding ------------------------------------------------------------------------


def _softness(evidence: Evidence) -> float:
    """``mu ell/(zeta sigma0)`` (m)."""
    at = evidence.interface
    return evidence.material.shear_modulus * at.slip_distance / at.zeta / at.normal_stress


def _eta(evidence: Evidence, **changes: float) -> float:
    """``L_c zeta sigma0/(mu ell)`` of two identical half-spaces."""
    return float(main_text(evidence, **changes).critical_length() / _softness(evidence))


def _eta_over_largest(evidence: Evidence) -> Result:
    """eta over 4/3, and the same for Poisson's ratio 1/4."""
    without = 0.75 * _eta(evidence, poisson_ratio=0.25)
    sentence = (
        r"4/3 is $1/(1 - \nu)$ for $\nu = 1/4$, and for that $\nu$ our number is "
        f"{without:.4g} (results: The factor pi)."
    )
    expected = formula(math.pi, r"$\pi$")
    return Result(0.75 * _eta(evidence), expected, explained=(without, sentence))


def _uncoupled_frequency(evidence: Evidence) -> Result:
    at = evidence.interface
    expected = math.sqrt(at.zeta / at.a) * at.velocity / at.slip_distance
    return Result(main_text(evidence).critical_mode().angular_frequency, formula(expected))


def _disagreement(evidence: Evidence) -> Array:
    """Differences of the measured rates of single modes from the theory's, over these."""
    modes = evidence.dispersion
    measured, theory = (
        modes[f"{kind}_growth"].values + 1j * modes[f"{kind}_frequency"].values
        for kind in ("measured", "theory")
    )
    return np.abs(measured - theory) / np.abs(theory)


def _zero_of_growth(modes: xr.Dataset) -> float:
    """The wavenumber over the critical one at which the growth changes sign, interpolated."""
    ratios = modes["wavenumber_over_critical"].values
    growth = modes["measured_growth"].max("branch").values
    last = int(np.flatnonzero(growth > 0.0)[-1])
    part = growth[last] / (growth[last] - growth[last + 1])
    return float(ratios[last] + part * (ratios[last + 1] - ratios[last]))


def _short_waves(evidence: Evidence) -> float:
    """The largest growth of waves shorter than the critical one over V/ell, at Fig. 3's heights."""
    curve = evidence.theory.isel(height=slice(None, None, 10))
    ratios = np.geomspace(1.001, 100.0, 60)[:, None]
    wavenumbers = ratios * curve["critical_wavenumber"].values
    rates = block(evidence, curve["height"].values).spectrum(wavenumbers)
    return float(rates.real.max() * evidence.interface.slip_distance / evidence.velocity)


# -- two half-spaces ----------------------------------------------------------------------------


def _bimaterial(evidence: Evidence, component: int) -> Any:
    """G1 (component 0) or G2 (component 1) of the pairs over Eq. (7)."""
    psi, nu, nu2 = np.array(PAIRS).T
    modulus = psi * evidence.material.shear_modulus
    pairs = main_text(
        evidence, poisson_ratio=nu, second_shear_modulus=modulus, second_poisson_ratio=nu2
    )
    expected = [printed.bimaterial_transfer(*pair)[component] for pair in PAIRS]
    return pairs.transfer_functions(1.0)[component] / expected


def _over_printed(cases: Iterable[tuple[float, float]]) -> list[float]:
    """L_c over L_c^M by the library over Eq. (9), for values of f beta and zeta/a."""
    return [
        float(bimaterial_length_ratio(*case)) / printed.bimaterial_ratio(*case) for case in cases
    ]


def _over_threshold(a: float, zeta: float) -> float:
    """The least f beta for which two half-spaces have a length, by bisection, over the printed."""
    stable, unstable = 0.0, 50.0
    while unstable - stable > 1e-12:
        middle = 0.5 * (stable + unstable)
        if np.isnan(bimaterial_length_ratio(middle, zeta / a)):
            stable = middle
        else:
            unstable = middle
    return unstable / printed.strengthening_threshold(a, zeta)


def _strengthening_length(evidence: Evidence) -> list[float]:
    """L_c over Eq. (9) above the threshold, for zeta < 0."""
    cases = itertools.product(STRENGTHENING, (1.2, 2.0))
    return _over_printed(
        (factor * printed.strengthening_threshold(a, zeta), zeta / a) for (a, zeta), factor in cases
    )


# -- blocks of finite height --------------------------------------------------------------------


def _block(evidence: Evidence, component: int) -> Any:
    """G1 (component 0) or G2 (component 1) of a block on a rigid base over Eq. (10)."""
    expected = [printed.block_transfer(q, evidence.nu)[component] for q in LAYER_NUMBERS]
    return block(evidence, LAYER_NUMBERS).transfer_functions(1.0)[component] / expected


def _thin_length(evidence: Evidence) -> Estimate:
    """L_c over Eq. (11), extrapolated to a height of zero."""
    heights = np.array([1e-5, 2.5e-6])  # m: far below those of Fig. 3
    thin = thin_limit_length(heights, block(evidence, 1.0))
    ratio, quarter = block(evidence, heights).critical_length() / thin
    limit = 2.0 * quarter - ratio
    return between(limit, quarter, 2.0 * limit - quarter)


def _response_error(q: float, nu: float, expected: ComplexArray) -> float:
    """Difference of the matrix M of a layer from `expected`, over its largest entry."""
    layer = Layers(np.array(1.0), np.array(nu), np.array(q), "velocity")
    found = layer.stiffness(1.0)
    stiffness = np.array([[found.xx, 1j * found.xy], [-1j * found.xy, found.yy]])
    difference = np.abs(-np.linalg.inv(stiffness) - expected)
    return float(difference.max() / np.abs(expected).max())


def _block_field(evidence: Evidence) -> list[float]:
    """``|ratio - 1|`` of the stresses of the printed field at the interface over G1 and G2."""
    nu, step = evidence.nu, 1e-5
    lame = 2.0 * nu / (1.0 - 2.0 * nu)
    differences = []
    for q in LAYER_NUMBERS[1:]:
        y = np.array([-step, 0.0, step])
        below, at, above = printed.block_field(q, y, nu).T
        u, w = at[0].real, at[1].imag
        du, dw = (above - below) / (2.0 * step * q)
        g1, g2 = block(evidence, q).transfer_functions(1.0)
        differences.append(abs(-(du.real + w) / u / g1 - 1.0))
        differences.append(abs(((lame + 2.0) * dw.imag - lame * u) / u / g2 - 1.0))
    return differences


NUMBERS: dict[str, Computation] = {
    "spring-stiffness": lambda e: marginal_stiffness(0.0, *e.at_v[1:])[1] / e.at_v.zeta,
    "half-spaces-g1": lambda e: Result(
        main_text(e).transfer_functions(1.0)[0], formula(1.0 / (2.0 * (1.0 - e.nu)))
    ),
    "half-spaces-g2": lambda e: main_text(e).transfer_functions(1.0)[1],
    "symmetric-g2": lambda e: main_text(
        e, height=LAYER_NUMBERS, second_height=LAYER_NUMBERS
    ).transfer_functions(1.0)[1],
    "half-spaces-wavenumber": lambda e: Result(
        main_text(e).critical_mode().wavenumber, formula(2.0 * (1.0 - e.nu) / _softness(e))
    ),
    "eta": lambda e: Result(_eta(e), formula(math.pi / (1.0 - e.nu), r"$\pi/(1 - \nu)$")),
    "eta-over-literature": _eta_over_largest,
    "eta-larger": lambda e: 0.75 * _eta(e) - 1.0,
    "uncoupled-frequency": _uncoupled_frequency,
    "spectrum-in-time": _disagreement,
    "growth-changes-sign": lambda e: [
        _zero_of_growth(modes) for _, modes in e.dispersion.groupby("height")
    ],
    "short-waves-stable": _short_waves,
    "bimaterial-g1": lambda e: _bimaterial(e, 0),
    "bimaterial-g2": lambda e: _bimaterial(e, 1),
    "bimaterial-modulus-limit": lambda e: Result(
        2.0 * main_text(e).transfer_functions(1.0)[0], formula(1.0 / (1.0 - e.nu), r"$1/(1 - \nu)$")
    ),
    "bimaterial-contrast-limit": lambda e: main_text(e).transfer_functions(1.0)[1],
    "bimaterial-length": lambda e: _over_printed(
        itertools.product(CONTRASTS, e.theory["zeta_over_a"].values)
    ),
    "bimaterial-length-limit": lambda e: bimaterial_length_ratio(0.0, e.theory["zeta_over_a"]),
    "bimaterial-smaller": lambda e: (
        e.theory["bimaterial_length_ratio"].where(e.theory["f_beta"] > 0.0).max()
    ),
    "bimaterial-decreasing": lambda e: (
        e.theory["bimaterial_length_ratio"].diff("f_beta") / np.diff(e.theory["f_beta"])
    ).max(),
    "strengthening-threshold": lambda e: [_over_threshold(*pair) for pair in STRENGTHENING],
    "strengthening-length": _strengthening_length,
    "block-g1": lambda e: _block(e, 0),
    "block-g2": lambda e: _block(e, 1),
    "block-high-limit": lambda e: Result(
        _coupling(e, HALF_SPACE), formula((1.0 - 2.0 * e.nu) / (2.0 * (1.0 - e.nu)))
    ),
    "block-thin-g1": lambda e: Result(
        block(e, 1e-6).transfer_functions(1.0)[0] / 2e-6,
        formula(1.0 / (1.0 - e.nu), r"$1/(1 - \nu)$"),
    ),
    "block-thin-g2": lambda e: _coupling(e, 1e-3),
    "thin-length": _thin_length,
    "thin-agreement": lambda e: (e.theory["thin_limit_length"] / e.theory["critical_length"])[0],
    "thin-deviation": lambda e: (
        np.interp(
            0.1, e.theory["height"], e.theory["thin_limit_length"] / e.theory["critical_length"]
        )
        - 1.0
    ),
    "response-matrix": lambda e: [
        _response_error(q, e.nu, printed.response_matrix(q, e.nu)) for q in LAYER_NUMBERS[1:]
    ],
    "response-matrix-limit": lambda e: _response_error(
        HALF_SPACE, e.nu, printed.half_space_response(e.nu)
    ),
    "block-field": _block_field,
}
"""The function of each claim, by its id."""
