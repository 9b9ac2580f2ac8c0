"""Claims on blocks of finite height on a rigid base (Sect. 5, Text S1)."""

import math

import numpy as np
import xarray as xr

from nucleation.types import Array, ComplexArray

from ..claim import Computation, Result
from ..evidence import Evidence
from ..expected import Estimate, formula
from ..independent import elastic_layers, marginal, printed
from ..independent.elastic_layers import HALF_SPACE, Layer, compliance, pair_transfer, refined

_LAYER_NUMBERS = (0.1, 0.3, 1.0, 3.0, 10.0)
_NOT_THIN = _LAYER_NUMBERS[1:]
_THIN = 1e-3  # kH of a thin block
_FAR_BELOW = 1e-5  # m: a height far below those of Fig. 3


def _block(q: float, nu: float, points: int) -> Layer:
    """A block of kH = q, free of stress on top."""
    return Layer(q, nu, far_side="traction", points=points)


def _points(q: float) -> int:
    """Number of collocation points; with more points, round-off spoils thin blocks."""
    if q < 0.1:
        return 16
    return 32 if q < 10.0 else 64


def block_transfer(
    q: float,
    nu: float,
) -> tuple[float, float]:
    """G1 and G2 of a block on a rigid base by collocation.

    Parameters
    ----------
    q : float
        kH.
    nu : float
        Poisson's ratio in the plane.
    """
    q = min(q, HALF_SPACE)
    return pair_transfer(_block(q, nu, _points(q)))


def _transfer_ratios(evidence: Evidence, component: int) -> Array:
    """G1 (component 0) or G2 (component 1) by collocation over Eq. (10), at several kH."""
    cases = [(q, evidence.nu) for q in _LAYER_NUMBERS]
    return printed.over_formula(block_transfer, printed.block_transfer, cases)[:, component]


def block_high_limit(evidence: Evidence) -> Result:
    nu = evidence.nu

    def coupling(points: int) -> float:
        g1, g2 = pair_transfer(_block(HALF_SPACE, nu, points))
        return g2 / g1

    beta = (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))
    return Result(refined(coupling), formula(beta))


def block_thin_g1(evidence: Evidence) -> Result:
    thin, twice = (block_transfer(q, evidence.nu)[0] / (2.0 * q) for q in (_THIN, 2.0 * _THIN))
    limit = (4.0 * thin - twice) / 3.0
    ours = Estimate.within(limit, 1e-7 * limit)
    expected = 1.0 / (1.0 - evidence.nu)
    return Result(ours, formula(expected, r"$1/(1 - \nu)$"))


def block_thin_g2(evidence: Evidence) -> float:
    g1, g2 = block_transfer(_THIN, evidence.nu)
    return g2 / g1


def _searched_ratio(height: float, evidence: Evidence) -> float:
    """L_c by search, transfer functions by collocation, over Eq. (11)."""
    modulus = evidence.material.shear_modulus
    interface = evidence.interface
    thin = printed.thin_length(height, evidence.nu, modulus, interface)
    k, _ = marginal.critical_wavenumber(
        lambda wavenumber: block_transfer(wavenumber * height, evidence.nu),
        modulus,
        interface,
        guess=2.0 * math.pi / thin,
    )
    return 2.0 * math.pi / k / thin


def thin_length(evidence: Evidence) -> Estimate:
    ratio = _searched_ratio(_FAR_BELOW, evidence)
    quarter = _searched_ratio(0.25 * _FAR_BELOW, evidence)
    limit = 2.0 * quarter - ratio
    return Estimate.within(limit, limit - quarter)


def _thin_over_curve(evidence: Evidence) -> xr.DataArray:
    """Eq. (11) over L_c at the heights of Fig. 3's curve."""
    theory = evidence.theory
    return theory["thin_limit_length"] / theory["critical_length"]


def thin_deviation(evidence: Evidence) -> xr.DataArray:
    ratio = _thin_over_curve(evidence).interp(height=0.1)
    return ratio - 1.0


def _relative_difference(ours: ComplexArray, expected: ComplexArray) -> float:
    """Largest difference of an entry of two matrices, over the largest entry."""
    difference = np.abs(ours - expected)
    size = np.abs(expected)
    return float(difference.max() / size.max())


def response_matrix(evidence: Evidence) -> list[float]:
    nu = evidence.nu
    differences = []
    for q in _NOT_THIN:
        ours = compliance(Layer(q, nu, points=40))
        differences.append(_relative_difference(ours, printed.response_matrix(q, nu)))
    return differences


def response_matrix_limit(evidence: Evidence) -> float:
    nu = evidence.nu
    ours = compliance(Layer(HALF_SPACE, nu))
    return _relative_difference(ours, printed.half_space_response(nu))


def block_field(evidence: Evidence) -> list[float]:
    differences = []
    for q in _NOT_THIN:
        y, u, w = elastic_layers.block_field(_block(q, evidence.nu, points=40))
        field = printed.block_field(q, y / q, evidence.nu)
        u_x, u_y = field / field[0, 0]
        along = np.abs(u_x - u)
        across = np.abs(u_y - 1j * w)
        differences += [along.max(), across.max()]
    return differences


SHORT: dict[str, Computation] = {
    "block-g1": lambda evidence: _transfer_ratios(evidence, 0),
    "block-g2": lambda evidence: _transfer_ratios(evidence, 1),
    "thin-agreement": lambda evidence: _thin_over_curve(evidence)[0],
}
