"""Claims of Sect. 2 (the conventional approach) and Sect. 3 (homogeneous sliding)."""

import dataclasses
import math

import numpy as np
from scipy.optimize import brentq

from ...model.friction.evolutions import aging, slip
from ...types import Array
from ...verification.dispersion import disagreement
from ..claim import Cause, Computation, Result
from ..evidence import Evidence
from ..independent import marginal, printed
from ..independent.elastic_layers import HALF_SPACE, Layer, half_spaces, pair_transfer, refined
from ..said import Ours, formula

SHORT = np.geomspace(1.001, 100.0, 60)  # wavenumbers over the critical one


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


def printed_wavenumber(evidence: Evidence) -> float:
    material = evidence.material
    return printed.half_space_wavenumber(evidence.nu, material.shear_modulus, evidence.interface)


def critical(evidence: Evidence) -> tuple[float, float]:
    """k_c (1/m) of two identical half-spaces, and the frequency over V/ell."""
    transfer, modulus = half_spaces(evidence.nu), evidence.material.shear_modulus
    guess = printed_wavenumber(evidence)
    return marginal.critical_wavenumber(lambda k: transfer, modulus, evidence.interface, guess)


def eta_of(evidence: Evidence) -> float:
    """``L_c zeta sigma0/(mu ell)`` of two identical half-spaces."""
    interface = evidence.interface
    scale = interface.zeta * interface.normal_stress / interface.slip_length
    k, _ = critical(evidence)
    return 2.0 * math.pi / k * scale / evidence.material.shear_modulus


def eta_over_literature(evidence: Evidence) -> Result:
    quarter = dataclasses.replace(
        evidence, material=dataclasses.replace(evidence.material, poisson_ratio=0.25)
    )
    text = r"4/3 is $1/(1 - \nu)$ for $\nu = 1/4$, and for that $\nu$ ours is"
    cause = Cause("The factor pi", text, 0.75 * eta_of(quarter))
    return Result(0.75 * eta_of(evidence), formula(math.pi, r"$\pi$"), cause=cause)


def uncoupled_frequency(evidence: Evidence) -> Result:
    interface = evidence.interface
    rate = interface.velocity / interface.slip_length
    frequency = rate * critical(evidence)[1]
    said = formula(math.sqrt(interface.zeta / interface.a) * rate)
    return Result(Ours.within(frequency, 1e-8 * frequency), said)


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
    modulus, interface = evidence.material.shear_modulus, evidence.interface
    curve = evidence.theory.isel(height=slice(None, None, 10))

    def fastest(height: float, k_c: float) -> float:
        def transfer(wavenumber: float) -> tuple[float, float]:
            return printed.block_transfer(min(wavenumber * height, HALF_SPACE), evidence.nu)

        return max(marginal.growth_at(k, transfer, modulus, interface).real for k in k_c * SHORT)

    return max(map(fastest, curve["height"].values, curve["critical_wavenumber"].values))


OURS: dict[str, Computation] = {
    "evolution-slope": lambda e: [
        (law.growth(1.0 + 1e-5) - law.growth(1.0 - 1e-5)) / 2e-5 for law in (aging, slip)
    ],
    "half-spaces-g1": lambda e: Result(
        refined(lambda points: half_spaces(e.nu, points=points)[0]),
        formula(1.0 / (2.0 * (1.0 - e.nu))),
    ),
    "half-spaces-g2": lambda e: [half_spaces(e.nu, points=points)[1] for points in (48, 64)],
    "symmetric-g2": lambda e: [
        pair_transfer(Layer(q, e.nu), Layer(-q, e.nu), 32)[1] for q in (0.1, 0.5, 1.0, 3.0)
    ],
    "half-spaces-wavenumber": lambda e: Result(
        Ours.within(critical(e)[0], 1e-9 * critical(e)[0]), formula(printed_wavenumber(e))
    ),
    "eta": lambda e: Result(eta_of(e), formula(math.pi / (1.0 - e.nu), r"$\pi/(1 - \nu)$")),
    "eta-larger": lambda e: 0.75 * eta_of(e) - 1.0,
    "spectrum-in-time": lambda e: disagreement(e.dispersion),
}
"""The claims whose numbers take a line; each of the others has a function with its name."""
