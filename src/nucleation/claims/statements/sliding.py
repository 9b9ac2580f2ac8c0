"""Claims of Sect. 2 (the conventional approach) and Sect. 3 (homogeneous sliding)."""

import dataclasses
import math

import numpy as np
from scipy.optimize import brentq

from ...model.friction.evolutions import aging, slip
from ...types import Array
from ...verification.dispersion import disagreement
from ..claim import Cause, Result
from ..evidence import Evidence
from ..independent import marginal, printed
from ..independent.elastic_layers import HALF_SPACE, Layer, half_spaces, pair_transfer
from ..said import Ours, formula

SHORT = np.geomspace(1.001, 100.0, 60)  # wavenumbers over the critical one


def evolution_slope(evidence: Evidence) -> list[float]:
    h = 1e-5
    return [float(law.growth(1.0 + h) - law.growth(1.0 - h)) / (2.0 * h) for law in (aging, slip)]


def linearised(evidence: Evidence, velocity: float) -> Array:
    """``[[f_v, f_phi], [g_v, g_phi]]`` at steady sliding, by central differences (SI units)."""
    law = evidence.friction
    state = float(law.steady_state(velocity))
    matrix = np.empty((2, 2))
    for column, (dv, dphi) in enumerate(((1e-5 * velocity, 0.0), (0.0, 1e-5 * state))):
        ahead, behind = (velocity + dv, state + dphi), (velocity - dv, state - dphi)
        step = 2.0 * (dv + dphi)
        matrix[0, column] = (law.coefficient(*ahead) - law.coefficient(*behind)) / step
        matrix[1, column] = (law.state_rate(*ahead) - law.state_rate(*behind)) / step
    return matrix


def spring_stiffness(evidence: Evidence) -> float:
    velocity, distance = evidence.loading.velocity, evidence.friction.characteristic_slip_distance
    (f_v, f_phi), (g_v, g_phi) = linearised(evidence, velocity)

    def rate(stiffness: float) -> float:
        # K dx + f_v dv + f_phi dphi = 0 per normal force, dx' = dv, dphi' = g_v dv + g_phi dphi
        dv = np.array([-stiffness / f_v, -f_phi / f_v])
        matrix = np.array([dv, g_v * dv + [0.0, g_phi]])
        return float(np.linalg.eigvals(matrix).real.max())

    printed_stiffness = evidence.friction.expansion(velocity).zeta / distance
    critical = brentq(rate, 0.2 * printed_stiffness, 5.0 * printed_stiffness, rtol=1e-12)
    return float(critical / printed_stiffness)


def half_spaces_g1(evidence: Evidence) -> Result:
    nu = evidence.material.in_plane_ratio
    coarse, fine = (half_spaces(nu, points=points)[0] for points in (48, 64))
    return Result(Ours.within(fine, fine - coarse), formula(1.0 / (2.0 * (1.0 - nu))))


def half_spaces_g2(evidence: Evidence) -> list[float]:
    nu = evidence.material.in_plane_ratio
    return [half_spaces(nu, points=points)[1] for points in (48, 64)]


def symmetric_g2(evidence: Evidence) -> list[float]:
    nu = evidence.material.in_plane_ratio
    return [pair_transfer(Layer(q, nu), Layer(-q, nu), 32)[1] for q in (0.1, 0.5, 1.0, 3.0)]


def _critical(evidence: Evidence) -> tuple[float, float]:
    """k_c (1/m) of two identical half-spaces, and the frequency over V/ell."""
    transfer = half_spaces(evidence.material.in_plane_ratio)
    modulus = evidence.material.shear_modulus
    return marginal.critical_wavenumber(
        lambda k: transfer, modulus, evidence.interface, _printed_wavenumber(evidence)
    )


def _printed_wavenumber(evidence: Evidence) -> float:
    interface, material = evidence.interface, evidence.material
    return printed.half_space_wavenumber(
        material.in_plane_ratio, interface.zeta, interface.normal_stress, material.shear_modulus,
        interface.slip_length,
    )  # fmt: skip


def half_spaces_wavenumber(evidence: Evidence) -> Result:
    k, _ = _critical(evidence)
    return Result(Ours.within(k, 1e-9 * k), formula(_printed_wavenumber(evidence)))


def _eta(evidence: Evidence) -> float:
    """``L_c zeta sigma0/(mu ell)`` of two identical half-spaces."""
    interface = evidence.interface
    scale = interface.zeta * interface.normal_stress / interface.slip_length
    k, _ = _critical(evidence)
    return 2.0 * math.pi / k * scale / evidence.material.shear_modulus


def eta(evidence: Evidence) -> Result:
    nu = evidence.material.in_plane_ratio
    return Result(_eta(evidence), formula(math.pi / (1.0 - nu), r"$\pi/(1 - \nu)$"))


def eta_over_literature(evidence: Evidence) -> Result:
    quarter = dataclasses.replace(
        evidence, material=dataclasses.replace(evidence.material, poisson_ratio=0.25)
    )
    ratios = [0.75 * _eta(case) for case in (evidence, quarter)]
    text = r"4/3 is $1/(1 - \nu)$ for $\nu = 1/4$, and for that $\nu$ ours is"
    return Result(
        ratios[0], formula(math.pi, r"$\pi$"), cause=Cause("The factor pi", text, ratios[1])
    )


def eta_larger(evidence: Evidence) -> float:
    return 0.75 * _eta(evidence) - 1.0


def uncoupled_frequency(evidence: Evidence) -> Result:
    interface = evidence.interface
    rate = interface.velocity / interface.slip_length
    _, frequency = _critical(evidence)
    said = formula(math.sqrt(interface.zeta / interface.a) * rate)
    return Result(Ours.within(frequency * rate, 1e-8 * frequency * rate), said)


def friction_perturbation(evidence: Evidence) -> list[float]:
    velocity, ell = evidence.loading.velocity, evidence.friction.characteristic_slip_distance
    _, a, zeta = evidence.friction.expansion(velocity)
    (f_v, f_phi), (g_v, g_phi) = linearised(evidence, velocity)
    differences = []
    for relative in (0.3 + 1j, 0.1 + 2j, 1j):
        rate = relative * velocity / ell
        ours = rate * (f_v + f_phi * g_v / (rate - g_phi))
        stated = rate * (a * rate * ell - zeta * velocity) / (velocity * (velocity + rate * ell))
        differences.append(abs(ours / stated - 1.0))
    return differences


def spectrum_in_time(evidence: Evidence) -> Array:
    return disagreement(evidence.dispersion).values


def growth_changes_sign(evidence: Evidence) -> list[float]:
    dataset, zeros = evidence.dispersion, []
    for height in dataset["height"].values:
        one = dataset.sel(height=height)
        ratio = (one["mode_wavenumber"] / one["critical_wavenumber"]).values
        growth = one["measured_growth"].max("branch").values
        last = int(np.flatnonzero(growth > 0.0)[-1])
        part = growth[last] / (growth[last] - growth[last + 1])
        zeros.append(ratio[last] + part * (ratio[last + 1] - ratio[last]))
    return zeros


def short_waves_stable(evidence: Evidence) -> float:
    material, curve = evidence.material, evidence.theory.isel(height=slice(None, None, 10))

    def fastest(height: float, k_c: float) -> float:
        def transfer(wavenumber: float) -> tuple[float, float]:
            q = min(wavenumber * height, HALF_SPACE)
            return printed.block_transfer(q, material.in_plane_ratio)

        modulus, interface = material.shear_modulus, evidence.interface
        return max(marginal.growth_at(k, transfer, modulus, interface).real for k in k_c * SHORT)

    return max(map(fastest, curve["height"].values, curve["critical_wavenumber"].values))
