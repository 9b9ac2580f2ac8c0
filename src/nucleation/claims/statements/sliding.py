"""Claims on friction, the conventional approach and homogeneous sliding: Text S2.1, Sects. 2, 3."""

import dataclasses
import math
from typing import Any

import numpy as np
from scipy.optimize import brentq

from ...configuration.roles import JUDGED, PAPERS
from ...model.friction.evolutions import aging, slip
from ...model.friction.law import Expansion
from ...types import Array
from ..claim import Cause, Computation, Result
from ..evidence import Evidence, of_runs
from ..independent import marginal, printed
from ..independent.elastic_layers import HALF_SPACE, Layer, half_spaces, pair_transfer, refined
from ..said import Missing, Ours, formula

FINE = np.geomspace(1e-11, 10.0, 4801)  # m/s


def at_v(evidence: Evidence) -> Expansion:
    """Friction, a and zeta at V."""
    return evidence.friction.expansion(evidence.loading.velocity)


def logarithmic_law(evidence: Evidence) -> Array:
    law, velocity = evidence.friction, evidence.loading.velocity
    factors = np.geomspace(0.1, 10.0, 41)
    v, phi = np.meshgrid(velocity * factors, law.steady_state(velocity) * factors)
    return law.logarithmic(v, phi, velocity) / law.coefficient(v, phi)


def steady_extremes(evidence: Evidence) -> tuple[float, float]:
    """Slip rates (m/s) of the maximum and of the minimum of steady-state friction around V."""
    f = evidence.friction.steady_coefficient(FINE)
    turns = 1 + np.flatnonzero(np.diff(np.sign(np.diff(f))) != 0)
    lower = [i for i in turns if FINE[i] < evidence.loading.velocity and f[i] > f[i - 1]]
    upper = [i for i in turns if FINE[i] > evidence.loading.velocity and f[i] < f[i - 1]]
    if not lower or not upper:
        raise Missing("Steady-state friction has no velocity-weakening branch around V")
    return float(FINE[lower[-1]]), float(FINE[upper[0]])


def steady_agreement(evidence: Evidence) -> float:
    law, velocity = evidence.friction, evidence.loading.velocity
    low, high = steady_extremes(evidence)
    v = FINE[slice(*np.searchsorted(FINE, [low, high]))]
    state = law.characteristic_slip_distance / v
    difference = np.abs(law.logarithmic(v, state, velocity) / law.steady_coefficient(v) - 1.0)
    middle = int(np.abs(np.log(v / velocity)).argmin())
    off = np.flatnonzero(difference >= 0.02)
    first = off[off < middle].max(initial=-1) + 1
    last = off[off > middle].min(initial=v.size) - 1
    return math.log10(v[last] / v[first])


def well_approximated(evidence: Evidence, part: str) -> Result:
    """Where the slip law with v is good: the least of all its runs, of either study."""
    judged, papers = (
        [run[part] for run in evidence.each(role, evolution="slip")] for role in (JUDGED, PAPERS)
    )
    return Result(judged, on_papers_mesh=papers)


def slip_law_approximation_ahead(evidence: Evidence) -> Result:
    """What the healing by v0 alone changes of the strength, where nothing slips."""
    judged, papers = (evidence.each(role, evolution="slip") for role in (JUDGED, PAPERS))
    latest = max(judged, key=lambda run: run["onset_time"])
    share = min(run["state_rate_share"] for run in judged)
    note = (
        f"At the latest onset the state is {healed_state(evidence, latest):.2f} s in the place of "
        f"{latest['phi0']:.2f} s. Only the relative error of $\\dot\\phi$ is large there: it is "
        f"below 10 % in {share:.2g} of the interface (results: The slip law ahead of the front)."
    )
    ours, other = ([_strengthened(evidence, run) for run in runs] for runs in (judged, papers))
    return Result(ours, on_papers_mesh=other, note=note)


def healed_state(evidence: Evidence, run: dict[str, Any]) -> float:
    """State (s) of the slip law at a run's onset where nothing slips: log(phi v0/D) decays."""
    law = evidence.friction
    rate = law.regularisation_slip_rate / law.characteristic_slip_distance
    decay = math.exp(-rate * run["onset_time"])
    return float((run["phi0"] * rate) ** decay / rate)


def _strengthened(evidence: Evidence, run: dict[str, Any]) -> float:
    """Relative change of friction at V by that healing."""
    velocity, law = evidence.loading.velocity, evidence.friction
    healed = law.coefficient(velocity, healed_state(evidence, run))
    return float(healed / law.coefficient(velocity, run["phi0"]) - 1.0)


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
    **{f"f0-{where}": lambda e: at_v(e).f0 for where in ("table", "main")},
    **{f"a-{where}": lambda e: at_v(e).a for where in ("table", "main")},
    **{f"zeta-{where}": lambda e: at_v(e).zeta for where in ("table", "main")},
    "weakening-at-v": lambda e: at_v(e).zeta,
    "slip-rate-over-v0": lambda e: math.log10(
        e.loading.velocity / e.friction.regularisation_slip_rate
    ),
    "friction-vanishes": lambda e: (
        e.friction.coefficient(1e-5 * e.friction.regularisation_slip_rate, 1.0) / at_v(e).f0
    ),
    "strengthening-branch": lambda e: steady_extremes(e)[1] / e.loading.velocity,
    "weakening-branch": lambda e: e.loading.velocity / steady_extremes(e)[0],
    "minimum-plays-no-role": of_runs("onset_rate", lambda e: steady_extremes(e)[1]),
    "regularisation-irrelevant": of_runs("regular_share"),
    "state-rate-at-v": lambda e: e.friction.slip_speed(e.loading.velocity) / e.loading.velocity,
    "slip-law-approximation": lambda e: well_approximated(e, "state_rate_share_patch"),
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
    "spectrum-in-time": lambda e: e.dispersion["disagreement"],
}
"""The claims whose numbers take a line; each of the others has a function with its name."""
