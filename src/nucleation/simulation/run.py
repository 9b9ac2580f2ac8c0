"""The simulation: physics, finite elements and stepping put together.

:func:`instants` yields one state after another; :func:`simulate` records them into a dataset. Both
can resume from stored arrays, and give the same result to the last bit as if they had never
stopped.
"""

import resource
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
import xarray as xr

from ..fem.grid import Grid
from ..model.settings import FIRST_STEP
from ..run.run import Run
from ..types import Array, Arrays
from .bodies import body_of
from .control import Control, Instant, SimulationFailure, accepted_step
from .drive import drive_of
from .event import Outcome
from .interface import Interface
from .recording import Recorder
from .start import at_rest
from .step import Dynamics, State
from .stepping import BDF

NEWTON = 1e-3
"""Largest tolerance of Newton's method over that of the step, if the run is perturbed."""


def composed(run: Run) -> Dynamics:
    """The dynamics of a run: a further drive or scheme is chosen here."""
    body = body_of(run)
    interface = interface_of(run, body.grid)
    drive = drive_of(run, body)
    return Dynamics(body, interface, drive, BDF(body.crossing_time))


def interface_of(run: Run, grid: Grid) -> Interface:
    """The frictional interface of a run, with its heterogeneity.

    Parameters
    ----------
    run : Run
    grid : Grid
        The mesh of its body.

    Returns
    -------
    Interface
    """
    varied = run.heterogeneity
    friction = run.law
    tolerance = Interface.tolerance  # an unperturbed run is perturbed by round-off alone
    if run.perturbation.acts:
        coarse = NEWTON * run.stepping.tolerance
        tolerance = max(tolerance, min(coarse, run.perturbation.strength))
    if varied.varies == "none":
        return Interface(friction, tolerance)
    factor = varied.factor(grid.x, grid.length, grid.periodic)
    friction = varied.friction(friction, run.fault.velocity, factor)
    extra: Array | float = 0.0
    if varied.varies == "normal_stress":
        extra = run.fault.normal_stress * (factor - 1.0) * grid.nodal_lengths
    return Interface(friction, tolerance, extra_normal=extra)


def instants(
    run: Run,
    start: tuple[State, Control] | None = None,
    dynamics: Dynamics | None = None,
) -> Iterator[Instant]:
    """Integrate in time, yielding the initial state and then every accepted step, without end.

    Parameters
    ----------
    run : Run
    start : tuple of State and Control, optional
        State and control of an instant of an earlier run with the same parameters. The steps that
        followed it there are yielded, the same to the last bit.
    dynamics : Dynamics, optional
        By default :func:`composed` from the parameters.

    Yields
    ------
    Instant

    Raises
    ------
    SimulationFailure
        If the step size fell below ``stepping.shortest_step``, also if every longer step ends in
        tension.

    Examples
    --------
    >>> from nucleation.api import PAPER, Run
    >>> run = Run(PAPER, block_length=0.9, n_x=16, n_y=2, end_time=0.02)
    >>> steps = instants(run)
    >>> first, second = next(steps), next(steps)
    >>> float(first.state.past_times[0]), bool(second.state.past_times[0] > 0.0)
    (0.0, True)
    """
    dynamics = composed(run) if dynamics is None else dynamics
    longest_step = run.longest_step
    longest = dynamics.scheme.coefficient(longest_step, longest_step)
    if start is None:
        state, report = at_rest(dynamics, run)
        control = Control(min(FIRST_STEP * run.memory_time, longest))
        yield Instant(state, report, control)
    else:
        state, control = start
    while True:
        instant = accepted_step(dynamics, run.stepping, state, control, longest)
        state = instant.state
        control = instant.control
        yield instant


def simulate(
    run: Run,
    *,
    progress: Callable[[Instant], None] | None = None,
    start: Arrays | None = None,
    keep: Callable[[Callable[[], Arrays]], None] | None = None,
) -> xr.Dataset:
    """Run one simulation to its end and return its record.

    Parameters
    ----------
    run : Run
    progress : callable, optional
        Called with every accepted step.
    start : dict of ndarray, optional
        Arrays that `keep` received from an earlier run with the same parameters. The run resumes
        there, with the same result to the last bit as if it had never stopped.
    keep : callable, optional
        Called after every step with a function that returns all arrays of the run at this instant,
        to be stored for `start` (:class:`nucleation.simulation.checkpoints.Checkpoint`).

    Returns
    -------
    Dataset
        The interface's fields on (time, x), the driving force and the step sizes on (step), see
        :data:`nucleation.simulation.recorded.RECORDED`. The attribute ``status`` says how the run
        ended and, after semicolons, why its event is doubtful (:mod:`.remarks`). A run that fails
        has everything recorded until then.
    """
    began = time.perf_counter()
    earlier = 0.0
    dynamics = composed(run)
    recorder = Recorder(run, dynamics)
    control = Control(0.0)
    position = None
    if start is not None:
        recorder.restore(start)
        control = Control(
            float(start["wanted"]),
            recorder.steps,
            int(start["rejected"]),
        )
        position = State.from_arrays(start), control
        earlier = float(start["wall_seconds"])
    outcome = Outcome.END_TIME
    try:
        for instant in instants(run, position, dynamics):
            control = instant.control
            recorder.record(instant.state, instant.report)
            if progress is not None:
                progress(instant)
            if recorder.covers_event:
                outcome = Outcome.AFTER_EVENT
                break
            if instant.state.time >= run.stepping.end_time:
                break
            if keep is not None:
                seconds = earlier + time.perf_counter() - began
                keep(partial(_arrays, instant, recorder, seconds))
    except SimulationFailure as failure:
        outcome = failure.outcome
    dataset = recorder.dataset()
    if not all(np.isfinite(values).all() for values in dataset.variables.values()):
        outcome = Outcome.NOT_FINITE
    dataset.attrs |= {
        "status": "; ".join([outcome.value, *recorder.remarks()]),
        "completed": int(outcome.completed),
        "steps": recorder.steps,
        "rejected_steps": control.rejected,
        "wall_seconds": earlier + time.perf_counter() - began,
        "peak_megabytes": peak_megabytes(),
    }
    return dataset


def _arrays(
    instant: Instant,
    recorder: Recorder,
    seconds: float,
) -> Arrays:
    """All arrays of a run after a step, from which it can resume."""
    control = {
        "wanted": np.array(instant.control.wanted),
        "rejected": np.array(instant.control.rejected),
        "wall_seconds": np.array(seconds),
    }
    return control | instant.state.to_arrays() | recorder.to_arrays()


def peak_megabytes() -> float:
    """Largest resident memory of this process so far (MB)."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    if sys.platform == "darwin":
        return peak / 1e6  # given in bytes there, and in kilobytes elsewhere
    return peak / 1e3
