"""Claims on the conventional approach and on homogeneous sliding (Sects. 2 and 3)."""

import dataclasses
import math

import numpy as np
import xarray as xr
from scipy.optimize import brentq

from nucleation.model.friction.evolutions import aging, slip
from nucleation.types import Array

from ..claim import Computation, Result
from ..evidence import Evidence
from ..expected import Estimate, formula
from ..independent import marginal, printed
from ..independent.elastic_layers import HALF_SPACE, Layer, half_spaces, pair_transfer, refined

_SHORT_WAVES = np.geomspace(1.001, 100.0, 60)
"""Wavenumbers over the critical one."""


def evolution_slope(evidence: Evidence) -> list[float]:
    step = 1e-5
    slopes = []
    for law in (aging, slip):
        ahead = law.growth(1.0 + step)
        behind = law.growth(1.0 - step)
        slopes.append((ahead - behind) / (2.0 * step))
    return slopes


def _linearised(evidence: Evidence, velocity: float) -> Array:
    """``[[f_v, f_phi], [g_v, g_phi]]`` at steady sliding, by central differences (SI units)."""
    law = evidence.friction
    state = float(law.steady_state(velocity))
    steps = (
        (1e-5 * velocity, 0.0),
        (0.0, 1e-5 * state),
    )
    columns = []
    for dv, dphi in steps:
        ahead = (velocity + dv, state + dphi)
        behind = (velocity - dv, state - dphi)
        step = 2.0 * (dv + dphi)
        column = []
        for function in (law.coefficient, law.state_rate):
            change = function(*ahead) - function(*behind)
            column.append(change / step)
        columns.append(column)
    return np.transpose(columns)


def spring_stiffness(evidence: Evidence) -> float:
    velocity = evidence.loading.velocity
    (f_v, f_phi), (g_v, g_phi) = _linearised(evidence, velocity)

    def growth(stiffness: float) -> float:
        # K dx + f_v dv + f_phi dphi = 0 per normal force, dx' = dv, dphi' = g_v dv + g_phi dphi
        dv = np.array([-stiffness / f_v, -f_phi / f_v])
        dphi = g_v * dv + [0.0, g_phi]
        matrix = np.array([dv, dphi])
        rates = np.linalg.eigvals(matrix)
        return float(rates.real.max())

    zeta = evidence.friction.expansion(velocity).zeta
    expected = zeta / evidence.friction.slip_distance
    found = brentq(
        growth,
        0.2 * expected,
        5.0 * expected,
        rtol=1e-12,
    )
    return float(found / expected)


def half_spaces_g1(evidence: Evidence) -> Result:
    nu = evidence.nu
    ours = refined(lambda points: half_spaces(nu, points=points)[0])
    return Result(ours, formula(1.0 / (2.0 * (1.0 - nu))))


def half_spaces_g2(evidence: Evidence) -> list[float]:
    return [half_spaces(evidence.nu, points=points)[1] for points in (48, 64)]


def symmetric_g2(evidence: Evidence) -> list[float]:
    couplings = []
    for q in (0.1, 0.5, 1.0, 3.0):
        upper, lower = (Layer(side, evidence.nu, points=32) for side in (q, -q))
        _, g2 = pair_transfer(upper, lower)
        couplings.append(g2)
    return couplings


def _printed_wavenumber(evidence: Evidence) -> float:
    modulus = evidence.material.shear_modulus
    return printed.half_space_wavenumber(evidence.nu, modulus, evidence.interface)


def _critical(evidence: Evidence) -> tuple[float, float]:
    """k_c (1/m) of two identical half-spaces by search, and the frequency over V/ell."""
    g1_and_g2 = half_spaces(evidence.nu)
    return marginal.critical_wavenumber(
        lambda wavenumber: g1_and_g2,
        evidence.material.shear_modulus,
        evidence.interface,
        guess=_printed_wavenumber(evidence),
    )


def half_spaces_wavenumber(evidence: Evidence) -> Result:
    k, _ = _critical(evidence)
    ours = Estimate.within(k, 1e-9 * k)
    return Result(ours, formula(_printed_wavenumber(evidence)))


def _eta(evidence: Evidence) -> float:
    """``L_c zeta sigma0/(mu ell)`` of two identical half-spaces."""
    interface = evidence.interface
    scale = interface.zeta * interface.normal_stress / interface.slip_length
    k, _ = _critical(evidence)
    length = 2.0 * math.pi / k
    return length * scale / evidence.material.shear_modulus


def eta(evidence: Evidence) -> Result:
    expected = math.pi / (1.0 - evidence.nu)
    return Result(_eta(evidence), formula(expected, r"$\pi/(1 - \nu)$"))


def _eta_over_literature(evidence: Evidence) -> float:
    """eta over 4/3, the largest one of the literature."""
    return 0.75 * _eta(evidence)


def eta_over_literature(evidence: Evidence) -> Result:
    material = dataclasses.replace(evidence.material, poisson_ratio=0.25)
    with_quarter = dataclasses.replace(evidence, material=material)
    return Result(
        _eta_over_literature(evidence),
        formula(math.pi, r"$\pi$"),
        without_cause=_eta_over_literature(with_quarter),
        cause=r"4/3 is $1/(1 - \nu)$ for $\nu = 1/4$, and for that $\nu$ our number is",
        finding="The factor pi",
    )


def eta_larger(evidence: Evidence) -> float:
    return _eta_over_literature(evidence) - 1.0


def uncoupled_frequency(evidence: Evidence) -> Result:
    interface = evidence.interface
    unit = interface.velocity / interface.slip_length
    _, in_units = _critical(evidence)
    frequency = unit * in_units
    ours = Estimate.within(frequency, 1e-8 * frequency)
    expected = math.sqrt(interface.zeta / interface.a) * unit
    return Result(ours, formula(expected))


def friction_perturbation(evidence: Evidence) -> list[float]:
    law = evidence.friction
    velocity = evidence.loading.velocity
    ell = law.slip_distance
    _, a, zeta = law.expansion(velocity)
    (f_v, f_phi), (g_v, g_phi) = _linearised(evidence, velocity)
    differences = []
    for relative in (0.3 + 1j, 0.1 + 2j, 1j):
        rate = relative * velocity / ell
        ours = rate * (f_v + f_phi * g_v / (rate - g_phi))
        dividend = rate * (a * rate * ell - zeta * velocity)
        divisor = velocity * (velocity + rate * ell)
        expected = dividend / divisor
        differences.append(abs(ours / expected - 1.0))
    return differences


def growth_changes_sign(evidence: Evidence) -> list[float]:
    modes = evidence.dispersion
    return [_zero_of_growth(modes.sel(height=height)) for height in modes["height"].values]


def _zero_of_growth(modes: xr.Dataset) -> float:
    """The wavenumber over the critical one at which the growth changes sign, interpolated."""
    ratios = modes["mode_wavenumber"] / modes["critical_wavenumber"]
    growth = modes["measured_growth"].max("branch").values
    growing = np.flatnonzero(growth > 0.0)
    last = int(growing[-1])
    before, after = growth[last : last + 2]
    part = before / (before - after)
    first, second = ratios.values[last : last + 2]
    return first + part * (second - first)


def short_waves_stable(evidence: Evidence) -> float:
    curve = evidence.theory.isel(height=slice(None, None, 10))
    heights = curve["height"].values
    critical = curve["critical_wavenumber"].values
    blocks = zip(heights, critical, strict=True)
    return max(_largest_rate(evidence, height, k_c) for height, k_c in blocks)


def _largest_rate(
    evidence: Evidence,
    height: float,
    k_c: float,
) -> float:
    """The largest growth of short waves in a block, over V/ell."""
    modulus = evidence.material.shear_modulus

    def transfer(wavenumber: float) -> tuple[float, float]:
        q = min(wavenumber * height, HALF_SPACE)
        return printed.block_transfer(q, evidence.nu)

    def growth(wavenumber: float) -> float:
        return marginal.growth_at(wavenumber, transfer, modulus, evidence.interface).real

    return max(map(growth, k_c * _SHORT_WAVES))


SHORT: dict[str, Computation] = {
    "spectrum-in-time": lambda evidence: evidence.dispersion["disagreement"],
}
