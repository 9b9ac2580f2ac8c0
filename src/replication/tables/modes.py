"""The bridge between simulation and theory: growth of single modes on homogeneous sliding.

The time-dependent, nonlinear solver starts from homogeneous sliding on a periodic block
(:mod:`nucleation.fem.body`) with a small perturbation of the state variable at one wavenumber.
The amplitude of ``exp(-i k x)`` in log(v) then follows ``C1 exp(Lambda1 t) + C2 exp(Lambda2 t)``:
its samples at equal intervals obey a linear recurrence, which gives both rates without any guess.
They have to be the two roots of Eq. (5). Each of them thus also gives the elastic response of two
bodies without any theory of them:

    G1 - i f G2 = -sigma0 Lambda (a Lambda ell - zeta V) / [mu k V (V + Lambda ell)] .

Between layers higher than a wavelength that is the response of half-spaces, Eqs. (7) and (8).
"""

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from nucleation.datasets.variables import Column, annotate, columns
from nucleation.fem.operator import Operator
from nucleation.run.run import PAPER_RUN, Run
from nucleation.simulation.drive import steady_drive
from nucleation.simulation.interface import Interface
from nucleation.simulation.start import layers_of
from nucleation.simulation.step import Dynamics, State
from nucleation.simulation.stepping import BDF
from nucleation.theory.critical import unstable_modes
from nucleation.theory.evaluation import single_system
from nucleation.types import Array, ComplexArray

from . import columns as col
from .curves import f_beta, on_rigid_base
from .rows import Row

NODES = 65  # per wavelength, odd
ROWS = (10, 40)  # fewest and most elements along y
GRADED = 0.25  # blocks higher than this part of the wavelength have a graded mesh,
GRADING = 4.0  # as the deformation is near the interface
SEED = 1e-6  # of log(phi)
NEWTON_TOLERANCE = 1e-12  # relative, of slip rates: far below the seed
STEP = 0.008  # in units of D/V
DURATION = 1.5  # in units of D/V
SKIPPED = 30  # steps: then they are equal, and the elastic waves of the start have decayed
INTERVAL = 5  # steps between samples

# -- one mode in time ---------------------------------------------------------------------------


def sliding_period(run: Run) -> Dynamics:
    """A period of a long block or pair that slides homogeneously at V.

    It is as long as the block and driven by traction; `n_x` must be odd. The driving force of its
    reports has no meaning.
    """
    body = layers_of(run, periodic=True)
    fault, law = run.fault, run.law
    steady = float(law.steady_coefficient(fault.velocity))
    load = body.far_load(fault.normal_stress, fault.normal_stress * steady)
    interface = Interface(law, NEWTON_TOLERANCE)
    drive = steady_drive(fault.velocity, load)
    return Dynamics(body, interface, drive, BDF(body.crossing_time))


def sliding_state(dynamics: Dynamics, perturbation: Array) -> State:
    """Homogeneous steady sliding; the perturbation is added to log(phi) at the nodes, (n_x,)."""
    body = dynamics.body
    n = dynamics.grid.n_x
    velocity = dynamics.drive.velocity
    (load,) = dynamics.drive.loads
    operator = Operator(body, 0.0)
    response = operator.respond(load, np.zeros(n))
    displacement = operator.balance(response, response.w)[0]
    # the driving traction moves the block at V: seen from there it is at rest
    factors = dynamics.factors(dynamics.drive.at(0.0))
    motion = body.at_rest(displacement, 0.0, factors)
    rates = np.full(n + 1, velocity)
    steady = float(np.log(dynamics.interface.friction.steady_state(velocity)))
    log_state = steady + np.append(0.0, perturbation)
    return State((motion,), np.zeros(1), rates[None], log_state[None], response.w[None])


def one_wavelength(run: Run, wavenumber: float, nodes: int = NODES) -> Run:
    """The bodies one wavelength ``2 pi / k`` long; elements about as high as long."""
    length = 2.0 * math.pi / wavenumber
    changes: dict[str, Any] = {"block_length": length, "n_x": nodes}
    bodies = {"": run.fault.height}
    if run.below is not None:
        bodies["second_"] = changes["second_height"] = run.below.height
    for body, height in bodies.items():
        changes[f"{body}n_y"] = round(float(np.clip(height * nodes / length, *ROWS)))
        changes[f"{body}grading"] = GRADING if height > GRADED * length else 1.0
    return run.replaced(**changes)


def measured_rates(run: Run, wavenumber: float) -> ComplexArray:
    """Both growth rates (1/s) of a wavenumber (1/m), the faster growing one first.

    Equidistant samples of a sum of two exponentials obey ``A[n+2] = p A[n+1] + q A[n]`` (Prony); p
    and q follow by least squares and the rates from the roots of ``z^2 = p z + q``.
    """
    dynamics = sliding_period(one_wavelength(run, wavenumber))
    phase = 2.0 * np.pi / NODES * np.arange(NODES)
    state = sliding_state(dynamics, SEED * np.cos(phase))
    rung = dynamics.scheme.steady_rung(STEP * run.memory_time)
    amplitudes = []
    while state.time < DURATION * run.memory_time:
        state, report = dynamics.advance(state, rung)
        log_rate = np.log(report.interface.slip_rate[1:])
        first_mode = np.fft.rfft(log_rate)[1]
        amplitudes.append(np.conj(first_mode) * 2.0 / NODES)
    samples = np.array(amplitudes[SKIPPED::INTERVAL])
    past = np.stack([samples[1:-1], samples[:-2]], axis=1)
    (p, q), *_ = np.linalg.lstsq(past, samples[2:], rcond=None)
    growth = np.roots([1.0, -p, -q])
    rates = np.log(growth) / (dynamics.scheme.steady_step(rung) * INTERVAL)
    return rates[np.argsort(-rates.real)]


# -- tables of modes ----------------------------------------------------------------------------

COLUMNS = columns(
    col.ID,
    col.HEIGHT,
    col.N_X,
    col.N_Y,
    col.SLIP_DISTANCE,
    col.VELOCITY,
    col.NORMAL_STRESS,
    col.SHEAR_MODULUS,
    col.POISSON_RATIO,
    col.PLANE,
    col.A,
    col.ZETA,
    col.WIDTH,
    col.ZETA_OVER_A,
    col.FRICTION,
    col.F_BETA,
    col.FAR_SIDE,
    col.SECOND_HEIGHT,
    col.SECOND_SHEAR_MODULUS,
    col.SECOND_POISSON_RATIO,
    Column("mode_wavenumber", "1/m", "wavenumber of the seeded mode", "k"),
    col.CRITICAL_WAVENUMBER,
    Column("measured_growth", "1/s", "growth rate in the time integration", "Re Lambda"),
    Column("measured_frequency", "1/s", "angular frequency in the time integration", "Im Lambda"),
    Column("theory_growth", "1/s", "growth rate of the seeded mode, Eq. (5)", "Re Lambda"),
    Column("theory_frequency", "1/s", "angular frequency of the seeded mode, Eq. (5)", "Im Lambda"),
    Column("wavenumber_over_critical", "1", "wavenumber over the critical one", "k/k_c"),
    Column("disagreement", "1", "difference of the complex rates over the theory's"),
)

HEIGHTS = (0.005, 0.02, 0.1, 0.5)  # m, of the paper's fault
MODES = (0.5, 0.6, 0.7, 0.8, 0.9, 0.97, 1.03, 1.1, 1.25, 1.5, 1.75, 2.0)  # k / k_c
PAIR_MODES = (0.6, 0.8, 0.97, 1.03, 1.25, 2.0)
DEEP = 1.2  # wavelengths: layers as high as this are half-spaces for a mode, to 1e-4
ENDLESS = 1e3  # m
SOFT, STIFF = 3.1e9, 9.3e9  # Pa
OF_FAULT = (
    *("height", "second_height", "shear_modulus", "second_shear_modulus", "poisson_ratio"),
    *("second_poisson_ratio", "friction", "a", "zeta", "slip_distance", "velocity"),
    "normal_stress",
)


_BODIES: Row = {
    "poisson_ratio": 1.0 / 3.0,
    "second_poisson_ratio": 0.2,
    "plane": "strain",
    "second_body": "deformable",
    "second_density": 2400.0,
    "second_far_side": "free",
}
_ABOVE = _BODIES | {"shear_modulus": STIFF, "second_shear_modulus": SOFT}
_BELOW = _BODIES | {"shear_modulus": SOFT, "second_shear_modulus": STIFF}
_LOW: Row = {"height": 0.05, "second_height": 0.6 * 0.05}
_LAYERS: dict[str, Row] = {
    "free": {"height": 0.2, "second_height": 0.6 * 0.2},  # higher: bending needs finer elements
    "clamped": _LOW | {"second_far_side": "clamped"},
    "roller": _LOW | {"second_far_side": "roller"},
}
_MUCH_STIFFER: Row = {"poisson_ratio": 0.0, "second_poisson_ratio": 0.0}

THIN_LAYERS = {
    f"stiff {place}, {side}": pair | layer
    for side, layer in _LAYERS.items()
    for place, pair in (("above", _ABOVE), ("below", _BELOW))
}

HALF_SPACES = {
    "half-spaces, stiff below": _BELOW,
    "half-spaces, stiff above": _ABOVE,
    "half-spaces, ten times, below": _BELOW | _MUCH_STIFFER | {"second_shear_modulus": 10.0 * SOFT},
    "half-spaces, ten times, above": _ABOVE | _MUCH_STIFFER | {"shear_modulus": 10.0 * SOFT},
}
"""Layers without a height have one at which their far sides do not matter."""


def _critical(run: Run) -> float:
    """k_c (1/m)."""
    return float(unstable_modes(single_system(run.fault)).wavenumber[0])


def mode_row(run: Run, ratio: float, critical: float) -> Row:
    """Both rates of a mode, measured and by Eq. (5), at a wavenumber over the critical one (1/m).

    The rate with the larger frequency is of the wave along +x and comes first.
    """
    k = ratio * critical
    rates = {
        "measured": measured_rates(run, k),
        "theory": single_system(run.fault).growth_rates(np.array([k]))[:, 0],
    }
    first = {name: both[np.argsort(-both.imag)] for name, both in rates.items()}
    return {"mode_wavenumber": k, "critical_wavenumber": critical, **first}


def _table(rows: list[Row]) -> xr.Dataset:
    """Modes on ``run``, and their rates on ``branch`` as well."""
    along = ("run", "branch")
    measured, theory = (
        np.array([row.pop(kind) for row in rows]) for kind in ("measured", "theory")
    )
    found = xr.Dataset({name: ("run", [row[name] for row in rows]) for name in rows[0]})
    for kind, both in (("measured", measured), ("theory", theory)):
        found[f"{kind}_growth"] = (along, both.real)
        found[f"{kind}_frequency"] = (along, both.imag)
    ratio = found["mode_wavenumber"] / found["critical_wavenumber"]
    apart = np.abs(measured - theory) / np.abs(theory)
    found = found.assign(wavenumber_over_critical=ratio, disagreement=(along, apart))
    return annotate(found, COLUMNS)


def _files(modes: xr.Dataset, columns: list[str]) -> dict[str, Any]:
    """Modes as netCDF, and a line for each mode and direction as CSV."""
    listed = modes.to_dataframe(["run", "branch"]).reset_index()[columns]
    return {".nc": modes, ".csv": listed.to_csv(index=False, float_format="%.8g")}


def dispersion_files(base: Run) -> dict[str, Any]:
    """Rates of modes on layers of some heights on a rigid base, with the paper's ratios to L_c."""
    own, papers = (
        on_rigid_base(one.fault, math.inf).critical_length() for one in (base, PAPER_RUN)
    )
    rows = []
    for usual in HEIGHTS:
        height = float(f"{usual * float(own / papers):.3g}")
        run = base.replaced(height=height)
        critical = _critical(run)
        rows += [{"height": height} | mode_row(run, ratio, critical) for ratio in MODES]
    order = ["height", "wavenumber_over_critical", "branch", "mode_wavenumber", "measured_growth"]
    order += ["measured_frequency", "theory_growth", "theory_frequency", "disagreement"]
    return _files(_table(rows), order)


def pair_modes(
    base: Run,
    pairs: Mapping[str, Row] = THIN_LAYERS | HALF_SPACES,
    ratios: Iterable[float] = PAIR_MODES,
) -> xr.Dataset:
    """Rates of modes between two layers with friction and loading of `base`."""
    rows = []
    for name, pair in pairs.items():
        endless = {"height": ENDLESS, "second_height": ENDLESS}
        critical = _critical(base.replaced(**endless | pair))
        for ratio in ratios:
            height = DEEP * 2.0 * np.pi / (ratio * critical)
            run = base.replaced(**{"height": height, "second_height": height} | pair)
            fault = run.fault
            described: Row = {
                "id": name,
                "far_side": fault.second_far_side,
                **{column: getattr(fault, column) for column in OF_FAULT},
                "f_beta": f_beta(run),
            }
            rows.append(described | mode_row(run, ratio, critical))
    return _table(rows)


def pair_mode_files(base: Run) -> dict[str, Any]:
    """:func:`pair_modes` as files; each pair replaces the moduli of the base."""
    found = pair_modes(base)
    return _files(found, ["branch", *map(str, found.data_vars)])
