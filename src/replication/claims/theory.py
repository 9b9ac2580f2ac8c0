"""Claims that need no run: homogeneous sliding, two half-spaces and blocks of finite height.

Our numbers are those of the library's theory. Tests compare the paper's formulas, and the library,
with evaluations that use neither (tests/claims/test_formulas.py).
"""

import dataclasses
import itertools
import math

import numpy as np
import xarray as xr

from nucleation.model.friction.evolutions import aging, slip
from nucleation.theory.closed_forms import bimaterial_length_ratio, thin_limit_length
from nucleation.theory.critical import critical_modes, modes_on_rigid_base
from nucleation.theory.marginal import marginal_stiffness
from nucleation.theory.of_runs import blocks_on_rigid_base
from nucleation.theory.pair import LayerPair
from nucleation.theory.spectrum import Systems
from nucleation.theory.stiffness import Layers
from nucleation.types import ComplexArray

from . import printed
from .evidence import Evidence
from .expected import Computation, Estimate, Result, between, formula

PAIRS = (
    (2.0, 0.25, 0.3),
    (0.5, 0.3, 0.2),
    (5.0, 0.1, 0.4),
    (0.9, 0.33, 0.25),
)
"""psi, nu(1) and nu(2) of pairs of half-spaces."""

CONTRASTS = (0.02, 0.1, 0.3, 0.5)
"""Values of f beta."""

STRENGTHENING = ((0.01, -0.004), (0.007, -0.001), (0.02, -0.015))
"""a and zeta of velocity-strengthening interfaces."""

LAYER_NUMBERS = (0.1, 0.3, 1.0, 3.0, 10.0)
"""Values of kH."""

_HALF_SPACE = 40.0  # kH of a body that counts as a half-space
_THIN = 1e-3  # kH of a thin block
_FAR_BELOW = 1e-5  # m: a height far below those of Fig. 3


def layer(q: float, nu: float, psi: float = 1.0, far_side: str = "traction") -> Layers:
    """A layer of kH = q and a shear modulus psi; lengths in units of 1/k."""
    return Layers(np.array(psi), np.array(nu), np.array(q), far_side)


def transfer(upper: Layers, lower: Layers | None = None) -> tuple[float, float]:
    """G1 and G2 of two layers, or of one on a rigid base."""
    g1, g2 = LayerPair(upper, lower).transfer_functions(np.array(1.0))
    return float(g1), float(g2)


def half_spaces(nu: float, psi: float = 1.0, nu2: float | None = None) -> tuple[float, float]:
    """G1 and G2 of two half-spaces."""
    lower = layer(math.inf, nu if nu2 is None else nu2, psi)
    return transfer(layer(math.inf, nu), lower)


def _slopes(evidence: Evidence) -> list[float]:
    """g'(1) of both evolution laws, by central differences."""
    step = 1e-5
    return [
        (law.growth(1.0 + step) - law.growth(1.0 - step)) / (2.0 * step) for law in (aging, slip)
    ]


def _spring_stiffness(evidence: Evidence) -> float:
    """Marginal stiffness over the normal force of a body without coupling, over K_c."""
    _, a, zeta = evidence.friction.expansion(evidence.loading.velocity)
    _, marginal = marginal_stiffness(0.0, a, zeta)
    return float(marginal / zeta)


def _critical(evidence: Evidence) -> tuple[float, float]:
    """k_c (1/m) and frequency (1/s) of two identical half-spaces."""
    at, modulus = evidence.interface, evidence.material.shear_modulus
    body = layer(math.inf, evidence.nu, modulus)
    softness = modulus * at.slip_length / at.normal_stress
    fields = (at.friction, at.a, at.zeta, softness, at.velocity / at.slip_length)
    pair = LayerPair(body, body).at(np.newaxis)
    found = critical_modes(Systems(pair, *(np.array([field]) for field in fields)))
    return float(found.wavenumber[0]), float(found.angular_frequency[0])


def _wavenumber(evidence: Evidence) -> Result:
    at, modulus = evidence.interface, evidence.material.shear_modulus
    expected = 2.0 * (1.0 - evidence.nu) * at.zeta * at.normal_stress / modulus / at.slip_length
    return Result(_critical(evidence)[0], formula(expected))


def _eta(evidence: Evidence) -> float:
    """``L_c zeta sigma0/(mu ell)`` of two identical half-spaces."""
    at, modulus = evidence.interface, evidence.material.shear_modulus
    length = 2.0 * math.pi / _critical(evidence)[0]
    return length * at.zeta * at.normal_stress / at.slip_length / modulus


def _eta_over_largest(evidence: Evidence) -> Result:
    """eta over 4/3, and the same for Poisson's ratio 1/4."""
    quarter = dataclasses.replace(evidence.material, poisson_ratio=0.25)
    without = 0.75 * _eta(dataclasses.replace(evidence, material=quarter))
    sentence = (
        r"4/3 is $1/(1 - \nu)$ for $\nu = 1/4$, and for that $\nu$ our number is "
        f"{without:.4g} (results: The factor pi)."
    )
    expected = formula(math.pi, r"$\pi$")
    return Result(0.75 * _eta(evidence), expected, explained=(without, sentence))


def _uncoupled_frequency(evidence: Evidence) -> Result:
    at = evidence.interface
    expected = math.sqrt(at.zeta / at.a) * at.velocity / at.slip_length
    return Result(_critical(evidence)[1], formula(expected))


def _friction_perturbation(evidence: Evidence) -> list[float]:
    """``|ratio - 1|`` of the linearised law and state over the printed formula, ell/V = 1."""
    _, a, zeta = evidence.friction.expansion(evidence.loading.velocity)
    differences = []
    for rate in (0.3 + 1j, 0.1 + 2j, 1j):
        state = -rate / (rate + 1.0)  # relative change of phi for a change of slip rate
        ours = a * rate + (a + zeta) * state
        differences.append(abs(ours * (1.0 + rate) / (rate * (a * rate - zeta)) - 1.0))
    return differences


def _zero_of_growth(modes: xr.Dataset) -> float:
    """The wavenumber over the critical one at which the growth changes sign, interpolated."""
    ratios = (modes["mode_wavenumber"] / modes["critical_wavenumber"]).values
    growth = modes["measured_growth"].max("branch").values
    last = int(np.flatnonzero(growth > 0.0)[-1])
    part = growth[last] / (growth[last] - growth[last + 1])
    return float(ratios[last] + part * (ratios[last + 1] - ratios[last]))


def _short_waves(evidence: Evidence) -> float:
    """The largest growth of waves shorter than the critical one over V/ell, at Fig. 3's heights."""
    curve = evidence.theory.isel(height=slice(None, None, 10))
    at = evidence.interface
    systems = blocks_on_rigid_base(evidence.material, curve["height"].values, at)
    ratios = np.geomspace(1.001, 100.0, 60)[:, None]
    rates = systems.growth_rates(ratios * curve["critical_wavenumber"].values)
    return float(rates.real.max() * at.slip_length / at.velocity)


def _bimaterial(component: int) -> list[float]:
    """G1 (component 0) or G2 (component 1) of the pairs over Eq. (7)."""
    return [
        half_spaces(nu, psi, nu2)[component] / printed.bimaterial_transfer(psi, nu, nu2)[component]
        for psi, nu, nu2 in PAIRS
    ]


def _bimaterial_length(evidence: Evidence) -> list[float]:
    weakenings = evidence.theory["zeta_over_a"].values
    return [
        float(bimaterial_length_ratio(f_beta, z)) / printed.bimaterial_ratio(f_beta, z)
        for f_beta, z in itertools.product(CONTRASTS, weakenings)
    ]


def _bimaterial_smaller(evidence: Evidence) -> xr.DataArray:
    ratio = evidence.theory["bimaterial_length_ratio"]
    return ratio.where(ratio["f_beta"] > 0.0).max()


def _bimaterial_slope(evidence: Evidence) -> xr.DataArray:
    ratio = evidence.theory["bimaterial_length_ratio"]
    return (ratio.diff("f_beta") / np.diff(ratio["f_beta"])).max()


def _least_contrast(a: float, zeta: float) -> float:
    """The least f beta for which two half-spaces have a length, by bisection."""
    stable, unstable = 0.0, 50.0
    while unstable - stable > 1e-12:
        middle = 0.5 * (stable + unstable)
        if np.isnan(bimaterial_length_ratio(middle, zeta / a)):
            stable = middle
        else:
            unstable = middle
    return unstable


def _strengthening_length(evidence: Evidence) -> list[float]:
    ratios = []
    for (a, zeta), factor in itertools.product(STRENGTHENING, (1.2, 2.0)):
        f_beta = factor * printed.strengthening_threshold(a, zeta)
        ours = float(bimaterial_length_ratio(f_beta, zeta / a))
        ratios.append(ours / printed.bimaterial_ratio(f_beta, zeta / a))
    return ratios


def _block(evidence: Evidence, component: int) -> list[float]:
    """G1 (component 0) or G2 (component 1) of a block on a rigid base over Eq. (10)."""
    nu = evidence.nu
    return [
        transfer(layer(q, nu))[component] / printed.block_transfer(q, nu)[component]
        for q in LAYER_NUMBERS
    ]


def _block_high(evidence: Evidence) -> Result:
    g1, g2 = transfer(layer(_HALF_SPACE, evidence.nu))
    return Result(g2 / g1, formula((1.0 - 2.0 * evidence.nu) / (2.0 * (1.0 - evidence.nu))))


def _thin_ratio(evidence: Evidence) -> float:
    """G2 over G1 of a thin block."""
    g1, g2 = transfer(layer(_THIN, evidence.nu))
    return g2 / g1


def _thin_length(evidence: Evidence) -> Estimate:
    """L_c over Eq. (11), extrapolated to a height of zero."""
    heights = np.array([1.0, 0.25]) * _FAR_BELOW
    lengths = modes_on_rigid_base(heights, evidence.material, evidence.interface).length
    ratio, quarter = lengths / thin_limit_length(heights, evidence.material, evidence.interface)
    limit = 2.0 * quarter - ratio
    return between(limit, quarter, 2.0 * limit - quarter)


def _thin_over_curve(evidence: Evidence) -> xr.DataArray:
    """Eq. (11) over L_c at the heights of Fig. 3's curve."""
    return evidence.theory["thin_limit_length"] / evidence.theory["critical_length"]


def _response_error(q: float, nu: float, expected: ComplexArray) -> float:
    """Difference of the matrix M of a layer from `expected`, over its largest entry."""
    found = layer(q, nu, far_side="velocity").stiffness(1.0)
    stiffness = np.array([[found.xx, 1j * found.xy], [-1j * found.xy, found.yy]])
    difference = np.abs(-np.linalg.inv(stiffness) - expected)
    return float(difference.max() / np.abs(expected).max())


def _block_field(evidence: Evidence) -> list[float]:
    """``|ratio - 1|`` of the stresses of the printed field at the interface over G1 and G2."""
    nu, step = evidence.nu, 1e-5
    lame = 2.0 * nu / (1.0 - 2.0 * nu)
    differences = []
    for q in LAYER_NUMBERS[1:]:
        below, at, above = printed.block_field(q, np.array([-step, 0.0, step]), nu).T
        u, w = at[0].real, at[1].imag
        du, dw = (above - below) / (2.0 * step * q)
        shear = du.real + w
        normal = (lame + 2.0) * dw.imag - lame * u
        g1, g2 = transfer(layer(q, nu))
        differences += [abs(-shear / u / g1 - 1.0), abs(normal / u / g2 - 1.0)]
    return differences


NUMBERS: dict[str, Computation] = {
    "evolution-slope": _slopes,
    "spring-stiffness": _spring_stiffness,
    "half-spaces-g1": lambda e: Result(half_spaces(e.nu)[0], formula(1.0 / (2.0 * (1.0 - e.nu)))),
    "half-spaces-g2": lambda e: half_spaces(e.nu)[1],
    "symmetric-g2": lambda e: [transfer(layer(q, e.nu), layer(q, e.nu))[1] for q in LAYER_NUMBERS],
    "half-spaces-wavenumber": _wavenumber,
    "eta": lambda e: Result(_eta(e), formula(math.pi / (1.0 - e.nu), r"$\pi/(1 - \nu)$")),
    "eta-over-literature": _eta_over_largest,
    "eta-larger": lambda e: 0.75 * _eta(e) - 1.0,
    "uncoupled-frequency": _uncoupled_frequency,
    "friction-perturbation": _friction_perturbation,
    "spectrum-in-time": lambda e: e.dispersion["disagreement"],
    "growth-changes-sign": lambda e: [
        _zero_of_growth(e.dispersion.sel(height=h)) for h in e.dispersion["height"].values
    ],
    "short-waves-stable": _short_waves,
    "bimaterial-g1": lambda e: _bimaterial(0),
    "bimaterial-g2": lambda e: _bimaterial(1),
    "bimaterial-modulus-limit": lambda e: Result(
        2.0 * half_spaces(e.nu)[0], formula(1.0 / (1.0 - e.nu), r"$1/(1 - \nu)$")
    ),
    "bimaterial-contrast-limit": lambda e: half_spaces(e.nu)[1],
    "bimaterial-length": _bimaterial_length,
    "bimaterial-length-limit": lambda e: bimaterial_length_ratio(
        0.0, e.theory["zeta_over_a"].values
    ),
    "bimaterial-smaller": _bimaterial_smaller,
    "bimaterial-decreasing": _bimaterial_slope,
    "strengthening-threshold": lambda e: [
        _least_contrast(*pair) / printed.strengthening_threshold(*pair) for pair in STRENGTHENING
    ],
    "strengthening-length": _strengthening_length,
    "block-g1": lambda e: _block(e, 0),
    "block-g2": lambda e: _block(e, 1),
    "block-high-limit": _block_high,
    "block-thin-g1": lambda e: Result(
        transfer(layer(1e-6, e.nu))[0] / 2e-6, formula(1.0 / (1.0 - e.nu), r"$1/(1 - \nu)$")
    ),
    "block-thin-g2": _thin_ratio,
    "thin-length": _thin_length,
    "thin-agreement": lambda e: _thin_over_curve(e)[0],
    "thin-deviation": lambda e: _thin_over_curve(e).interp(height=0.1) - 1.0,
    "response-matrix": lambda e: [
        _response_error(q, e.nu, printed.response_matrix(q, e.nu)) for q in LAYER_NUMBERS[1:]
    ],
    "response-matrix-limit": lambda e: _response_error(
        _HALF_SPACE, e.nu, printed.half_space_response(e.nu)
    ),
    "block-field": _block_field,
}
"""The function of each claim, by its id."""
