"""The bridge between simulation and theory: growth of one wavenumber on homogeneous sliding.

The time-dependent, nonlinear solver starts from homogeneous sliding on a periodic block
(:mod:`nucleation.fem.periodic`) with a small perturbation of the state variable at one
wavenumber. The amplitude that multiplies ``exp(-i k x)`` in log(v) then follows
``C1 exp(Lambda1 t) + C2 exp(Lambda2 t)``, with both roots of Eq. (5): its samples at equal
intervals obey a linear recurrence, which gives the roots without any guess.
"""

import dataclasses
import math
from typing import Any

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
GRADING = 4.0  # the deformation being near the interface
SEED = 1e-6  # of log(phi)
NEWTON_TOLERANCE = 1e-12  # relative, of slip rates: far below the seed
STEP = 0.008  # in units of D/V
DURATION = 1.5  # in units of D/V
SKIPPED = 30  # steps, until they are equal and the start's elastic waves are gone
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
    """A period of a long block or pair that slides homogeneously at V: by traction, or by its top.

    ``geometry.length`` is the period, ``mesh.n_x`` must be odd. The reports' driving force has no
    meaning here.
    """
    body = period_of(parameters)
    law, loading = parameters.friction, parameters.loading
    shear = loading.normal_stress * float(law.steady_coefficient(loading.velocity))
    load = body.top_load(loading.normal_stress, shear)
    interface, drive = Interface(law, NEWTON_TOLERANCE), Steady(loading.velocity, load)
    return Dynamics(body, interface, drive, BDF(body.crossing_time))


def sliding_state(dynamics: Dynamics, perturbation: Array) -> State:
    """Homogeneous steady sliding, with a perturbation of log(phi) at the period's nodes."""
    body, n, velocity = dynamics.body, dynamics.grid.n_x, dynamics.drive.velocity
    operator = body.operator(0.0)
    far_side = getattr(body, "upper", body).far_side  # type: ignore[union-attr]
    load = dynamics.drive.load(0.0)
    response = operator.respond(load, np.zeros(n))
    if far_side == "velocity":  # the interface lags behind the top that drags it
        strength = dynamics.interface.friction.steady_coefficient(velocity) * response.normal[1:]
        response = operator.respond(load, -strength / operator.apply(np.ones(n))[0])
    balance = operator.balance(response, response.w)
    steady = float(np.log(dynamics.interface.friction.steady_state(velocity)))
    # carried along by the driving traction, it stands still as seen from V
    motion = body.at_rest(balance.displacement, 0.0)
    rates, log_state = np.full(n + 1, velocity), steady + np.append(0.0, perturbation)
    return State.beginning(motion, rates, log_state, response.w, balance.memory)


def one_wavelength(
    parameters: Parameters, height: float, wavenumber: float, nodes: int = NODES
) -> Parameters:
    """The parameters with a block of one wavelength ``2 pi / k`` and a mesh that resolves it.

    Parameters
    ----------
    parameters : material, friction and loading are taken from it.
    height : H (m).
    wavenumber : k (1/m).
    nodes : per wavelength; elements along y are about as high as long, within :data:`ROWS`.
    """
    length = 2.0 * math.pi / wavenumber

    def mesh(height: float) -> Mesh:
        rows = round(min(max(height * nodes / length, ROWS[0]), ROWS[1]))
        return Mesh(nodes, rows, GRADING if height > GRADED * length else 1.0)

    found = dataclasses.replace(parameters, geometry=Geometry(height, length), mesh=mesh(height))
    if found.below is None:
        return found
    below = mesh(found.below.geometry.height)
    return found.replaced({"second_n_y": below.n_y, "second_grading": below.grading})


def follow_mode(parameters: Parameters) -> tuple[float, ComplexArray]:
    """Integrate homogeneous sliding of one period with its first mode seeded in log(phi).

    Returns the time between samples (s) and the samples of the complex amplitude of
    ``exp(-i k x)`` in log(v).
    """
    dynamics = sliding_period(parameters)
    n = parameters.mesh.n_x
    state = sliding_state(dynamics, SEED * np.cos(2.0 * np.pi / n * np.arange(n)))
    rung = dynamics.scheme.steady_rung(STEP * parameters.memory_time)
    amplitudes = []
    while state.time < DURATION * parameters.memory_time:
        state, report = dynamics.advance(state, rung)
        log_rate = np.log(report.interface.slip_rate[1:])
        amplitudes.append(np.conj(np.fft.rfft(log_rate)[1]) * 2.0 / n)
    return dynamics.scheme.steady_step(rung) * INTERVAL, np.array(amplitudes[SKIPPED::INTERVAL])


def fitted_rates(interval: float, amplitude: ComplexArray) -> ComplexArray:
    """The two growth rates (1/s) in equidistant samples of a sum of two exponentials.

    Such samples obey ``A[n+2] = p A[n+1] + q A[n]`` (Prony); p and q follow by least squares
    and the rates from the roots of ``z^2 = p z + q``. The faster growing rate comes first.
    """
    past = np.stack([amplitude[1:-1], amplitude[:-2]], axis=1)
    (p, q), *_ = np.linalg.lstsq(past, amplitude[2:], rcond=None)
    rates = np.log(np.roots([1.0, -p, -q])) / interval
    return rates[np.argsort(-rates.real)]


def measured_rates(
    parameters: Parameters, height: float, wavenumber: float, nodes: int = NODES
) -> ComplexArray:
    """Both growth rates (1/s) of a wavenumber (1/m) as the time integration shows them."""
    return fitted_rates(*follow_mode(one_wavelength(parameters, height, wavenumber, nodes)))


def by_direction(rates: ArrayLike) -> ComplexArray:
    """Rates ordered along the last axis by falling frequency."""
    rates = np.asarray(rates, dtype=complex)
    return np.take_along_axis(rates, np.argsort(-rates.imag, axis=-1), axis=-1)


def heights_for(parameters: Parameters) -> list[float]:
    """:data:`HEIGHTS` (m), to three digits in the same ratio to L_c of a high block as there."""
    own, papers = (
        critical_length(math.inf, p.material, interface_state(p))
        for p in (parameters, Parameters())
    )
    return [float(f"{height * float(own / papers):.3g}") for height in HEIGHTS]


def dispersion_dataset(
    parameters: Parameters, heights: ArrayLike = HEIGHTS, modes: ArrayLike = MODES
) -> xr.Dataset:
    """Growth rates and frequencies of Eq. (5) and of the time integration.

    :data:`MODES_OF_SLIDING` on (height, mode, branch), the theory's curves on (height, curve,
    branch). The branch of the larger frequency, which travels along +x (the direction of sliding),
    comes first.

    Parameters
    ----------
    parameters : material, friction and loading of the block.
    heights : block heights (m), shape (height,).
    modes : wavenumbers over the critical one of each height, shape (mode,).
    """
    heights = np.asarray(heights, dtype=float)
    interface = interface_state(parameters)
    bodies = [Body(parameters.material, float(h), "traction") for h in heights]
    critical = np.array([critical_wavenumber(b, RIGID, interface).wavenumber for b in bodies])
    mode_k, curve_k = critical[:, None] * np.asarray(modes, float), critical[:, None] * CURVE
    measured = by_direction(
        [[measured_rates(parameters, h, k) for k in ks]
         for h, ks in zip(heights, mode_k, strict=True)]
    )  # fmt: skip
    pairs = list(zip(bodies, mode_k, curve_k, strict=True))
    theory = by_direction([growth_rates(k, b, RIGID, interface).T for b, k, _ in pairs])
    curves = by_direction([growth_rates(k, b, RIGID, interface).T for b, _, k in pairs])
    rates = {"measured": measured, "theory": theory, "curve": curves}
    columns: dict[str, Any] = {
        "mode_wavenumber": (("height", "mode"), mode_k),
        "curve_wavenumber": (("height", "curve"), curve_k),
        "critical_wavenumber": ("height", critical),
        "memory_time": parameters.memory_time,
    }
    for name, values in rates.items():
        along = "height", "curve" if name == "curve" else "mode", "branch"
        columns |= {
            f"{name}_growth": (along, values.real),
            f"{name}_frequency": (along, values.imag),
        }
    found = xr.Dataset(columns, {"height": heights})
    return annotate(found.assign(disagreement=disagreement(found)), MODES_OF_SLIDING)


def disagreement(dataset: xr.Dataset) -> xr.DataArray:
    """``|Lambda - Lambda_theory| / |Lambda_theory|`` on (height, mode, branch)."""
    growth = dataset["measured_growth"] - dataset["theory_growth"]
    frequency = dataset["measured_frequency"] - dataset["theory_frequency"]
    return np.hypot(growth, frequency) / np.hypot(  # type: ignore[return-value]
        dataset["theory_growth"], dataset["theory_frequency"]
    )


def to_csv(dataset: xr.Dataset) -> str:
    """Measured and theoretical rates of every mode as comma-separated text."""
    rates = [name for name in MODES_OF_SLIDING if name.startswith(("measured", "theory"))]
    ratio = dataset["mode_wavenumber"] / dataset["critical_wavenumber"]
    columns = ["mode_wavenumber", *rates, "disagreement"]
    table = dataset[columns].assign(wavenumber_over_critical=ratio).to_dataframe().reset_index()
    order = ["height", "wavenumber_over_critical", "branch", *columns]
    return table[order].to_csv(index=False, float_format="%.8g")


def files(material: Material, friction: Friction, loading: Loading) -> dict[str, Any]:
    """The step ``dispersion``: :func:`dispersion_dataset`, with its CSV."""
    parameters = Parameters(material=material, friction=friction, loading=loading)
    found = dispersion_dataset(parameters, heights_for(parameters))
    return {".nc": found, ".csv": to_csv(found)}
