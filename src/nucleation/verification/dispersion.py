"""The bridge between simulation and theory: growth of one wavenumber on homogeneous sliding.

The time-dependent, nonlinear solver starts from homogeneous sliding on a periodic block
(:mod:`nucleation.fem.periodic`) with a small perturbation of the state variable at one wavenumber.
The amplitude of ``exp(-i k x)`` in log(v) then follows ``C1 exp(Lambda1 t) + C2 exp(Lambda2 t)``,
with both roots of Eq. (5): its samples at equal intervals obey a linear recurrence, which gives the
roots without any guess.
"""

import dataclasses
import math

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..datasets.shared import SHARED
from ..datasets.variables import Variable, annotate
from ..fem.bodies import period_of
from ..model.friction.law import Friction
from ..model.linearised import interface_state
from ..model.material import Material
from ..model.parameters import Geometry, Loading, Mesh, Parameters
from ..simulation.drive import Steady
from ..simulation.interface import Interface
from ..simulation.state import State
from ..simulation.step import Dynamics
from ..simulation.stepping import BDF
from ..theory.critical import critical_length, critical_wavenumber
from ..theory.curves import CURVES
from ..theory.spectrum import growth_rates
from ..theory.transfer import RIGID, Body
from ..types import Array, ComplexArray

HEIGHTS = (0.005, 0.02, 0.1, 0.5)  # m, of the paper's fault
MODES = (0.5, 0.6, 0.7, 0.8, 0.9, 0.97, 1.03, 1.1, 1.25, 1.5, 1.75, 2.0)  # k / k_c
CURVE = np.linspace(0.4, 2.1, 171)  # k / k_c of the theory's curves
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

MODES_OF_SLIDING = {
    "height": SHARED["height"],
    "mode_wavenumber": Variable("1/m", "wavenumber of the seeded mode", "k"),
    "measured_growth": Variable("1/s", "growth rate in the time integration", "Re Lambda"),
    "measured_frequency": Variable("1/s", "angular frequency in the time integration", "Im Lambda"),
    "theory_growth": Variable("1/s", "growth rate of the seeded mode, Eq. (5)", "Re Lambda"),
    "theory_frequency": Variable(
        "1/s", "angular frequency of the seeded mode, Eq. (5)", "Im Lambda"
    ),
    "disagreement": Variable("1", "difference of the complex rates over the theory's"),
    "curve_wavenumber": Variable("1/m", "wavenumber of the theory's curve", "k"),
    "curve_growth": Variable("1/s", "growth rate, Eq. (5)", "Re Lambda"),
    "curve_frequency": Variable("1/s", "angular frequency, Eq. (5)", "Im Lambda"),
    "critical_wavenumber": CURVES["critical_wavenumber"],
    "memory_time": Variable("s", "time over which friction forgets at V", "D/V"),
}


def sliding_period(parameters: Parameters) -> Dynamics:
    """Compose a period of a long block or pair that slides homogeneously at V.

    It is driven by traction, or by its top. The driving force of its reports has no meaning.

    Parameters
    ----------
    parameters : Parameters
        ``geometry.length`` is the period, ``mesh.n_x`` must be odd.

    Returns
    -------
    Dynamics
    """
    body = period_of(parameters)
    law = parameters.friction
    loading = parameters.loading
    steady = float(law.steady_coefficient(loading.velocity))
    load = body.top_load(loading.normal_stress, loading.normal_stress * steady)
    interface = Interface(law, NEWTON_TOLERANCE)
    drive = Steady(loading.velocity, load)
    return Dynamics(body, interface, drive, BDF(body.crossing_time))


def sliding_state(dynamics: Dynamics, perturbation: Array) -> State:
    """Make homogeneous steady sliding with a perturbed state variable.

    Parameters
    ----------
    dynamics : Dynamics
        The period, as of :func:`sliding_period`.
    perturbation : ndarray
        Added to log(phi) at the period's nodes, shape (n_x,).

    Returns
    -------
    State
    """
    body = dynamics.body
    friction = dynamics.interface.friction
    n = dynamics.grid.n_x
    velocity = dynamics.drive.velocity
    load = dynamics.drive.load(0.0)
    operator = body.operator(0.0)
    response = operator.respond(load, np.zeros(n))
    if body.far_side == "velocity":  # the interface lags behind the top that drags it
        strength = friction.steady_coefficient(velocity) * response.normal[1:]
        stiffness, _ = operator.apply(np.ones(n))
        response = operator.respond(load, -strength / stiffness)
    balance = operator.balance(response, response.w)
    # the driving traction moves the block at V: seen from there it is at rest
    motion = body.at_rest(balance.displacement, 0.0)
    rates = np.full(n + 1, velocity)
    steady = float(np.log(friction.steady_state(velocity)))
    log_state = steady + np.append(0.0, perturbation)
    return State.beginning(
        motion,
        rates,
        log_state,
        response.w,
        balance.memory,
    )


def one_wavelength(
    parameters: Parameters,
    height: float,
    wavenumber: float,
    nodes: int = NODES,
) -> Parameters:
    """Replace the block by one wavelength ``2 pi / k``, with a mesh that resolves it.

    Parameters
    ----------
    parameters : Parameters
        Material, friction and loading.
    height : float
        H (m).
    wavenumber : float
        k (1/m).
    nodes : int
        Nodes per wavelength; elements are about as high as long, their number along y is within
        :data:`ROWS`.

    Returns
    -------
    Parameters
    """
    length = 2.0 * math.pi / wavenumber
    geometry = Geometry(height, length)
    mesh = _mesh(geometry, nodes)
    found = dataclasses.replace(parameters, geometry=geometry, mesh=mesh)
    if found.below is None:
        return found
    below = _mesh(Geometry(found.below.geometry.height, length), nodes)
    return found.replaced({"second_n_y": below.n_y, "second_grading": below.grading})


def _mesh(geometry: Geometry, nodes: int) -> Mesh:
    """A mesh of a layer, one wavelength long."""
    fewest, most = ROWS
    rows = geometry.height * nodes / geometry.length
    graded = geometry.height > GRADED * geometry.length
    return Mesh(
        nodes,
        round(min(max(rows, fewest), most)),
        GRADING if graded else 1.0,
    )


def _follow_mode(parameters: Parameters) -> tuple[float, ComplexArray]:
    """Integrate homogeneous sliding of one period with its first mode seeded in log(phi).

    Returns the time between samples (s) and the samples of the complex amplitude of
    ``exp(-i k x)`` in log(v).
    """
    dynamics = sliding_period(parameters)
    n = parameters.mesh.n_x
    phase = 2.0 * np.pi / n * np.arange(n)
    state = sliding_state(dynamics, SEED * np.cos(phase))
    rung = dynamics.scheme.steady_rung(STEP * parameters.memory_time)
    amplitudes = []
    while state.time < DURATION * parameters.memory_time:
        state, report = dynamics.advance(state, rung)
        log_rate = np.log(report.interface.slip_rate[1:])
        first_mode = np.fft.rfft(log_rate)[1]
        amplitudes.append(np.conj(first_mode) * 2.0 / n)
    interval = dynamics.scheme.steady_step(rung) * INTERVAL
    return interval, np.array(amplitudes[SKIPPED::INTERVAL])


def _fitted_rates(interval: float, amplitude: ComplexArray) -> ComplexArray:
    """The two growth rates (1/s) in equidistant samples of a sum of two exponentials.

    Such samples obey ``A[n+2] = p A[n+1] + q A[n]`` (Prony); p and q follow by least squares
    and the rates from the roots of ``z^2 = p z + q``. The faster growing rate comes first.
    """
    past = np.stack([amplitude[1:-1], amplitude[:-2]], axis=1)
    (p, q), *_ = np.linalg.lstsq(past, amplitude[2:], rcond=None)
    rates = np.log(np.roots([1.0, -p, -q])) / interval
    return rates[np.argsort(-rates.real)]


def measured_rates(
    parameters: Parameters,
    height: float,
    wavenumber: float,
    nodes: int = NODES,
) -> ComplexArray:
    """Measure both growth rates of a wavenumber in the time integration.

    Parameters
    ----------
    parameters, height, wavenumber, nodes
        As in :func:`one_wavelength`.

    Returns
    -------
    ndarray
        The rates (1/s), the faster growing one first, shape (2,).
    """
    period = one_wavelength(parameters, height, wavenumber, nodes)
    interval, amplitude = _follow_mode(period)
    return _fitted_rates(interval, amplitude)


def by_direction(rates: ArrayLike) -> ComplexArray:
    """Order rates along the last axis by falling frequency."""
    values = np.asarray(rates, dtype=complex)
    order = np.argsort(-values.imag, axis=-1)
    return np.take_along_axis(values, order, axis=-1)


def _heights_for(parameters: Parameters) -> list[float]:
    """Heights (m) that have the ratios of :data:`HEIGHTS` to the L_c of a high block."""
    own, papers = (
        critical_length(math.inf, fault.material, interface_state(fault))
        for fault in (parameters, Parameters())
    )
    ratio = float(own / papers)
    return [float(f"{height * ratio:.3g}") for height in HEIGHTS]


def dispersion_dataset(
    parameters: Parameters,
    heights: ArrayLike = HEIGHTS,
    modes: ArrayLike = MODES,
) -> xr.Dataset:
    """Compute growth rates and frequencies by Eq. (5) and by the time integration.

    Parameters
    ----------
    parameters : Parameters
        Material, friction and loading of the block.
    heights : array_like
        Block heights (m), shape (height,).
    modes : array_like
        Wavenumbers over the critical one of each height, shape (mode,).

    Returns
    -------
    Dataset
        :data:`MODES_OF_SLIDING` on (height, mode, branch), the theory's curves on (height, curve,
        branch). The branch with the larger frequency travels along +x, the direction of sliding,
        and comes first.
    """
    heights = np.asarray(heights, dtype=float)
    modes = np.asarray(modes, dtype=float)
    interface = interface_state(parameters)
    critical = []
    measured = []
    theory = []
    curves = []
    for height in heights:
        body = Body(parameters.material, float(height), "traction")
        k_c = critical_wavenumber(body, RIGID, interface).wavenumber
        critical.append(k_c)
        measured.append([measured_rates(parameters, height, k) for k in k_c * modes])
        theory.append(growth_rates(k_c * modes, body, RIGID, interface).T)
        curves.append(growth_rates(k_c * CURVE, body, RIGID, interface).T)
    critical_k = np.array(critical)
    found = xr.Dataset(
        {
            "mode_wavenumber": (("height", "mode"), np.outer(critical_k, modes)),
            "curve_wavenumber": (("height", "curve"), np.outer(critical_k, CURVE)),
            "critical_wavenumber": ("height", critical_k),
            "memory_time": parameters.memory_time,
            **_columns("measured", by_direction(measured), "mode"),
            **_columns("theory", by_direction(theory), "mode"),
            **_columns("curve", by_direction(curves), "curve"),
        },
        {"height": heights},
    )
    return annotate(found.assign(disagreement=disagreement(found)), MODES_OF_SLIDING)


Values = tuple[tuple[str, ...], Array]
"""Dimensions of a variable and its values."""


def _columns(
    name: str,
    rates: ComplexArray,
    along: str,
) -> dict[str, Values]:
    """Growth and frequency of complex rates on (height, along, branch)."""
    dimensions = ("height", along, "branch")
    return {
        f"{name}_growth": (dimensions, rates.real),
        f"{name}_frequency": (dimensions, rates.imag),
    }


def disagreement(dataset: xr.Dataset) -> xr.DataArray:
    """Return ``|Lambda - Lambda_theory| / |Lambda_theory|`` of each mode and branch."""
    growth = dataset["theory_growth"]
    frequency = dataset["theory_frequency"]
    error = dataset["measured_growth"] - growth
    error_of_frequency = dataset["measured_frequency"] - frequency
    difference: xr.DataArray = xr.apply_ufunc(
        np.hypot,
        error,
        error_of_frequency,
    )
    size: xr.DataArray = xr.apply_ufunc(np.hypot, growth, frequency)
    return difference / size


def dispersion_csv(dataset: xr.Dataset) -> str:
    """Return measured and theoretical rates of every mode as comma-separated text."""
    rates = [name for name in MODES_OF_SLIDING if name.startswith(("measured", "theory"))]
    columns = ["mode_wavenumber", *rates, "disagreement"]
    ratio = dataset["mode_wavenumber"] / dataset["critical_wavenumber"]
    table = dataset[columns].assign(wavenumber_over_critical=ratio)
    frame = table.to_dataframe().reset_index()
    order = ["height", "wavenumber_over_critical", "branch", *columns]
    return frame[order].to_csv(index=False, float_format="%.8g")


def files(
    material: Material,
    friction: Friction,
    loading: Loading,
) -> dict[str, xr.Dataset | str]:
    """Make the files of the step ``dispersion``.

    Parameters
    ----------
    material, friction, loading : Material, Friction, Loading
        Those of the block.

    Returns
    -------
    dict
        :func:`dispersion_dataset` and its CSV, by suffix.
    """
    parameters = Parameters(material=material, friction=friction, loading=loading)
    found = dispersion_dataset(parameters, _heights_for(parameters))
    return {".nc": found, ".csv": dispersion_csv(found)}
