"""Growth of one wavenumber on homogeneous sliding, in the time integration.

The time-dependent, nonlinear solver starts from homogeneous sliding on a periodic block
(:mod:`nucleation.fem.body`) with a small perturbation of the state variable at one wavenumber.
The amplitude of ``exp(-i k x)`` in log(v) then follows ``C1 exp(Lambda1 t) + C2 exp(Lambda2 t)``:
its samples at equal intervals obey a linear recurrence, which gives both rates without any guess.
"""

import math

import numpy as np

from nucleation.fem.operator import Operator
from nucleation.run.run import Run
from nucleation.simulation.drive import Steady
from nucleation.simulation.interface import Interface
from nucleation.simulation.start import layers_of
from nucleation.simulation.step import Dynamics, State
from nucleation.simulation.stepping import BDF
from nucleation.types import Array, ComplexArray

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
    drive = Steady(fault.velocity, load)
    return Dynamics(body, interface, drive, BDF(body.crossing_time))


def sliding_state(dynamics: Dynamics, perturbation: Array) -> State:
    """Homogeneous steady sliding; the perturbation is added to log(phi) at the nodes, (n_x,)."""
    body = dynamics.body
    friction = dynamics.interface.friction
    n = dynamics.grid.n_x
    velocity = dynamics.drive.velocity
    load = dynamics.drive.load(0.0)
    operator = Operator(body, 0.0)
    response = operator.respond(load, np.zeros(n))
    displacement = operator.balance(response, response.w).displacement
    # the driving traction moves the block at V: seen from there it is at rest
    motion = body.at_rest(displacement, 0.0)
    rates = np.full(n + 1, velocity)
    steady = float(np.log(friction.steady_state(velocity)))
    log_state = steady + np.append(0.0, perturbation)
    return State((motion,), np.zeros(1), rates[None], log_state[None], response.w[None])


def one_wavelength(
    run: Run,
    height: float,
    wavenumber: float,
    nodes: int = NODES,
) -> Run:
    """The block one wavelength ``2 pi / k`` long and H (m) high; elements about as high as long."""
    length = 2.0 * math.pi / wavenumber
    rows, grading = _mesh(height, length, nodes)
    changes = {
        "height": height,
        "block_length": length,
        "n_x": nodes,
        "n_y": rows,
        "grading": grading,
    }
    if run.below is not None:
        second = run.below.height
        changes["second_height"] = second
        changes["second_n_y"], changes["second_grading"] = _mesh(second, length, nodes)
    return run.replaced(**changes)


def _mesh(height: float, length: float, nodes: int) -> tuple[int, float]:
    """Number of elements along y and grading of a layer (m), one wavelength long."""
    fewest, most = ROWS
    rows = round(min(max(height * nodes / length, fewest), most))
    return rows, GRADING if height > GRADED * length else 1.0


def _follow_mode(run: Run) -> tuple[float, ComplexArray]:
    """Integrate homogeneous sliding of one period with its first mode seeded in log(phi).

    Returns the time between samples (s) and the samples of the complex amplitude of
    ``exp(-i k x)`` in log(v).
    """
    dynamics = sliding_period(run)
    n = run.block.n_x
    phase = 2.0 * np.pi / n * np.arange(n)
    state = sliding_state(dynamics, SEED * np.cos(phase))
    rung = dynamics.scheme.steady_rung(STEP * run.memory_time)
    amplitudes = []
    while state.time < DURATION * run.memory_time:
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
    last = amplitude[1:-1]
    before = amplitude[:-2]
    past = np.stack([last, before], axis=1)
    (p, q), *_ = np.linalg.lstsq(
        past,
        amplitude[2:],
        rcond=None,
    )
    growth = np.roots([1.0, -p, -q])
    rates = np.log(growth) / interval
    return rates[np.argsort(-rates.real)]


def measured_rates(
    run: Run,
    height: float,
    wavenumber: float,
    nodes: int = NODES,
) -> ComplexArray:
    """Both growth rates (1/s) of a wavenumber (1/m) at H (m), the faster growing one first."""
    period = one_wavelength(run, height, wavenumber, nodes)
    interval, amplitude = _follow_mode(period)
    return _fitted_rates(interval, amplitude)
