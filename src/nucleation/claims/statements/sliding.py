"""Claims of Sect. 2 (the conventional approach) and Sect. 3 (homogeneous sliding)."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from scipy.optimize import brentq

from ...model.friction.evolutions import aging, slip
from ...verification.dispersion import disagreement
from ..claim import Cause, Claim, Result, claim
from ..evidence import Evidence
from ..independent import marginal, printed
from ..independent.elastic_layers import HALF_SPACE, Layer, pair_transfer
from ..said import Missing, Ours, below, formula, words

CLAIMS: list[Claim] = []

SHORT = np.geomspace(1.001, 100.0, 60)  # wavenumbers over the critical one


@claim(
    CLAIMS, id="evolution-slope", where="Sect. 2",
    statement="Both evolution laws have g'(1) = -1.",
    quotation=r"feature $g'(1)=-1$",
    method="central difference of either law's g at 1; the worse of the two",
    said=formula(-1.0, "-1"),
)  # fmt: skip
def evolution_slope(evidence: Evidence) -> Ours:
    h = 1e-5
    slopes = [float(law.growth(1.0 + h) - law.growth(1.0 - h)) / (2.0 * h) for law in (aging, slip)]
    return Ours.furthest(slopes, target=-1.0)


def linearised(evidence: Evidence, velocity: float) -> np.ndarray:
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


@claim(
    CLAIMS, id="spring-stiffness", where="Eq. (1)",
    statement="Steady sliding of a spring-block is unstable below the stiffness "
    "K_c = g'(1) F_N df/dlogV / D, inertia left out.",
    quotation=r"K < K_c\equiv\frac{df(V,D/V)}{d\log{V}}\frac{g'(1)F_N}{D}",
    method="stiffness at which a root of the numerically linearised friction law and spring gets "
    "a positive real part, over the printed K_c",
    said=formula(1.0, "K_c"),
)  # fmt: skip
def spring_stiffness(evidence: Evidence) -> Ours:
    velocity, distance = evidence.loading.velocity, evidence.friction.characteristic_slip_distance
    (f_v, f_phi), (g_v, g_phi) = linearised(evidence, velocity)

    def rate(stiffness: float) -> float:
        # K dx + f_v dv + f_phi dphi = 0 per normal force, dx' = dv, dphi' = g_v dv + g_phi dphi
        dv = np.array([-stiffness / f_v, -f_phi / f_v])
        matrix = np.array([dv, g_v * dv + [0.0, g_phi]])
        return float(np.linalg.eigvals(matrix).real.max())

    printed_stiffness = evidence.friction.expansion(velocity).zeta / distance
    critical = brentq(rate, 0.2 * printed_stiffness, 5.0 * printed_stiffness, rtol=1e-12)
    return Ours.exactly(critical / printed_stiffness)


@claim(
    CLAIMS, id="literature-eta", where="Sect. 2, below Eq. (3)",
    statement="The prefactor eta of the literature lies between 2/pi and 4/3.",
    quotation=r"its value varies between $2/\pi$ and $4/3$ in the available literature",
    method="none", said=None,
)  # fmt: skip
def literature_eta(evidence: Evidence) -> Ours:
    raise Missing("It is about other publications, of which none is computed here")


@claim(
    CLAIMS, id="literature-underestimate", where="Sect. 3, below Eq. (6)",
    statement="Simulations of others found nucleation lengths well above those of eta near 1.",
    quotation=r"quite significantly underestimates the observed $L_c$",
    method="none", said=None,
)  # fmt: skip
def literature_underestimate(evidence: Evidence) -> Ours:
    raise Missing(
        "It is about simulations of others, which were not made again; ours of two half-spaces are "
        "judged beside Eq. (6) in the table of two bodies"
    )


def half_spaces(evidence: Evidence, points: int = 64) -> tuple[float, float]:
    """G1 and G2 of two identical half-spaces, from Navier's equation."""
    nu = evidence.material.in_plane_ratio
    return pair_transfer(Layer(HALF_SPACE, nu), Layer(-HALF_SPACE, nu), points)


@claim(
    CLAIMS, id="half-spaces-g1", where="Sect. 3 and Eq. (S-G_gen)",
    statement="Two identical half-spaces have G1 = 1/[2(1 - nu)].",
    quotation=r"$G_1=\text{sign}(k)[2(1-\nu)]^{-1}$",
    method="Navier's equation by collocation, two layers of kH = 40",
)  # fmt: skip
def half_spaces_g1(evidence: Evidence) -> Result:
    fine, coarse = half_spaces(evidence)[0], half_spaces(evidence, 48)[0]
    nu = evidence.material.in_plane_ratio
    return Result(Ours.within(fine, fine - coarse), formula(1.0 / (2.0 * (1.0 - nu))))


@claim(
    CLAIMS, id="half-spaces-g2", where="Sect. 3 and Eq. (S-G_gen)",
    statement="Identical half-spaces do not couple slip and normal stress: G2 = 0.",
    quotation=r"$G_2=0$ (see Supporting Information)",
    method="Navier's equation by collocation, two layers of kH = 40", said=formula(0.0, "0"),
)  # fmt: skip
def half_spaces_g2(evidence: Evidence) -> Ours:
    return Ours.furthest([half_spaces(evidence, points)[1] for points in (48, 64)], target=0.0)


@claim(
    CLAIMS, id="symmetric-g2", where="Text S1.1",
    statement="G2 = 0 for any pair of bodies that mirror each other.",
    quotation=r"$G_2=0$, and no coupling exists between tangential motion and normal traction",
    method="the same for layers of kH = 0.1, 0.5, 1 and 3", said=formula(0.0, "0"),
)  # fmt: skip
def symmetric_g2(evidence: Evidence) -> Ours:
    nu = evidence.material.in_plane_ratio
    couplings = [pair_transfer(Layer(q, nu), Layer(-q, nu), 32)[1] for q in (0.1, 0.5, 1.0, 3.0)]
    return Ours.furthest(couplings, target=0.0)


def half_spaces_wavenumber(evidence: Evidence) -> tuple[float, float]:
    """k_c (1/m) of two identical half-spaces, and the frequency over V/ell."""
    transfer = half_spaces(evidence)
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


@claim(
    CLAIMS, id="half-spaces-wavenumber", where="Sect. 3",
    statement="Identical half-spaces: k_c = 2(1 - nu) zeta sigma0/(mu ell).",
    quotation=r"$k_c=2(1-\nu)\zeta \sigma _0 \mu^{-1} \ell^{-1}$",
    method="largest wavenumber with a growing root of Eq. (5), by search, transfer functions by "
    "collocation", unit="1/m",
)  # fmt: skip
def half_spaces_critical(evidence: Evidence) -> Result:
    k, _ = half_spaces_wavenumber(evidence)
    return Result(Ours.within(k, 1e-9 * k), formula(_printed_wavenumber(evidence)))


def eta(evidence: Evidence) -> float:
    """``L_c zeta sigma0/(mu ell)`` of two identical half-spaces."""
    interface = evidence.interface
    scale = interface.zeta * interface.normal_stress / interface.slip_length
    k, _ = half_spaces_wavenumber(evidence)
    return 2.0 * math.pi / k * scale / evidence.material.shear_modulus


@claim(
    CLAIMS, id="eta", where="Eq. (6)",
    statement="L_c = 2 pi/k_c of identical half-spaces is Eq. (3) with eta = pi/(1 - nu).",
    quotation=r"\eta=\frac{\pi }{1-\nu}",
    method="from the k_c found by search",
)  # fmt: skip
def eta_value(evidence: Evidence) -> Result:
    nu = evidence.material.in_plane_ratio
    return Result(Ours.exactly(eta(evidence)), formula(math.pi / (1.0 - nu), "pi/(1 - nu)"))


@claim(
    CLAIMS, id="eta-over-literature", where="Sect. 3, below Eq. (6)",
    statement="eta is pi times larger than the largest one of the literature, 4/3.",
    quotation=r"is $\pi$ times larger than the largest value",
    method="eta from the k_c found by search, over 4/3", said=formula(math.pi, "pi"),
)  # fmt: skip
def eta_over_literature(evidence: Evidence) -> Result:
    quarter = dataclasses.replace(
        evidence, material=dataclasses.replace(evidence.material, poisson_ratio=0.25)
    )
    ratios = [Ours.exactly(0.75 * eta(case)) for case in (evidence, quarter)]
    text = "4/3 is 1/(1 - nu) for nu = 1/4, and for that nu ours is"
    return Result(ratios[0], cause=Cause("The factor pi", text, ratios[1]))


@claim(
    CLAIMS, id="eta-larger", where="Abstract and Sect. 3",
    statement="The length is significantly larger than the conventional one.",
    quotation=r"resulting in a significantly larger $L_c$ in our approach",
    method="eta from the k_c found by search, over 4/3, minus one", said=words("significant"),
)  # fmt: skip
def eta_larger(evidence: Evidence) -> Ours:
    return Ours.exactly(eta(evidence) * 3.0 / 4.0 - 1.0)


@claim(
    CLAIMS, id="uncoupled-frequency", where="Text S1.4",
    statement="If G2 = 0 the critical mode has the frequency sqrt(zeta/a) V/ell, whatever the "
    "material and the normal stress.",
    quotation=r"$\omega=\sqrt{\frac{\zeta}{a }}\frac{ V}{\ell }$, which is independent of material",
    method="imaginary part of the root at the k_c found by search", unit="1/s",
)  # fmt: skip
def uncoupled_frequency(evidence: Evidence) -> Result:
    interface = evidence.interface
    rate = interface.velocity / interface.slip_length
    _, frequency = half_spaces_wavenumber(evidence)
    said = formula(math.sqrt(interface.zeta / interface.a) * rate)
    return Result(Ours.within(frequency * rate, 1e-8 * frequency * rate), said)


@claim(
    CLAIMS, id="friction-perturbation", where="Sect. 3 and Eq. (S-delta_f)",
    statement="A perturbation of slip changes friction by "
    "Lambda (a Lambda ell - zeta V)/[V (V + Lambda ell)].",
    quotation=r"\tfrac{\Lambda(a\Lambda\ell-\zeta V)}{V(V+\Lambda\ell)}",
    method="numerical linearisation of the full friction law over the printed formula, for "
    "Lambda = (0.3 + i) V/ell, (0.1 + 2i) V/ell and i V/ell; largest |ratio - 1|",
    said=formula(0.0, "0"),
)  # fmt: skip
def friction_perturbation(evidence: Evidence) -> Ours:
    velocity, ell = evidence.loading.velocity, evidence.friction.characteristic_slip_distance
    _, a, zeta = evidence.friction.expansion(velocity)
    (f_v, f_phi), (g_v, g_phi) = linearised(evidence, velocity)
    differences = []
    for relative in (0.3 + 1j, 0.1 + 2j, 1j):
        rate = relative * velocity / ell
        ours = rate * (f_v + f_phi * g_v / (rate - g_phi))
        stated = rate * (a * rate * ell - zeta * velocity) / (velocity * (velocity + rate * ell))
        differences.append(abs(ours / stated - 1.0))
    return Ours.exactly(max(differences))


@claim(
    CLAIMS, id="spectrum-in-time", where="Eq. (5)",
    statement="Perturbations of homogeneous sliding grow and oscillate with the roots of Eq. (5).",
    quotation=r"we obtain an equation for $\Lambda(k)$",
    method="single modes integrated in time by the full inertial equations, four heights, twelve "
    "wavenumbers, both roots: largest |Lambda/Lambda_theory - 1| (results/dispersion.nc)",
    said=words("negligible"),
)  # fmt: skip
def spectrum_in_time(evidence: Evidence) -> Ours:
    return Ours.worst(disagreement(evidence.dispersion).values.ravel())


@claim(
    CLAIMS, id="growth-changes-sign", where="Sect. 3",
    statement="Growth sets in below k_c: Re Lambda(k_c) = 0.",
    quotation=r"the largest wavenumber $k$ (smallest wavelength) for which $\Re[\Lambda(k)]=0$",
    method="zero of the growth of single modes integrated in time, over k_c of the theory; the "
    "worst of four heights (results/dispersion.nc)", said=words("computed"),
)  # fmt: skip
def growth_changes_sign(evidence: Evidence) -> Ours:
    dataset, zeros = evidence.dispersion, []
    for height in dataset["height"].values:
        one = dataset.sel(height=height)
        ratio = (one["mode_wavenumber"] / one["critical_wavenumber"]).values
        growth = one["measured_growth"].max("branch").values
        last = int(np.flatnonzero(growth > 0.0)[-1])
        part = growth[last] / (growth[last] - growth[last + 1])
        zeros.append(ratio[last] + part * (ratio[last + 1] - ratio[last]))
    return Ours.worst(zeros, target=1.0)


@claim(
    CLAIMS, id="short-waves-stable", where="Sect. 3",
    statement="All wavelengths shorter than the critical one are stable.",
    quotation=r"one expects short wavelength $\lambda$ (large wavenumber $k=2\pi/\lambda$) "
    r"perturbations to be stable",
    method="largest growth of the roots of Eq. (5) from 1.001 to 100 k_c, heights of Fig. 3's "
    "curve, Eq. (10), over V/ell", said=None,
)  # fmt: skip
def short_waves_stable(evidence: Evidence) -> Result:
    material, curve = evidence.material, evidence.theory.isel(height=slice(None, None, 10))

    def fastest(height: float, k_c: float) -> float:
        def transfer(wavenumber: float) -> tuple[float, float]:
            q = min(wavenumber * height, HALF_SPACE)
            return printed.block_transfer(q, material.in_plane_ratio)

        modulus, interface = material.shear_modulus, evidence.interface
        return max(marginal.growth_at(k, transfer, modulus, interface).real for k in k_c * SHORT)

    largest = max(map(fastest, curve["height"].values, curve["critical_wavenumber"].values))
    return Result(Ours.exactly(largest), below(0.0))
