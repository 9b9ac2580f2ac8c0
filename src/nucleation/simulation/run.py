"""The simulation: physics, finite elements and stepping put together.

:func:`run` yields one state after another; :func:`simulate` records them into a dataset. Both can
go on from arrays stored earlier, to the last bit as if they had never stopped.
"""

import resource
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..fem.bodies import body_of
from ..fem.grid import Grid
from ..model.parameters import FIRST_STEP, Parameters
from ..types import Array
from .control import Control, Instant, SimulationFailure, accepted_step
from .drive import drive_of
from .event import Outcome
from .interface import Interface
from .recording import Recorder
from .start import at_rest
from .state import State
from .step import Dynamics
from .stepping import BDF

NEWTON = 1e-3
"""Of Newton's tolerance over the step's, at most; nor is it above a perturbation's strength."""


def composed(parameters: Parameters) -> Dynamics:
    """The dynamics that parameters ask for: here a further drive or scheme is chosen."""
    body = body_of(parameters)
    interface, drive = interface_of(parameters, body.grid), drive_of(parameters, body)
    return Dynamics(body, interface, drive, BDF(body.crossing_time))


def interface_of(parameters: Parameters, grid: Grid) -> Interface:
    """The frictional interface with what varies along it."""
    varied, loading = parameters.heterogeneity, parameters.loading
    friction, tolerance = parameters.friction, Interface.tolerance  # quiet runs live on round-off
    extra: Array | float = 0.0
    if parameters.perturbation.acts:
        declared = min(NEWTON * parameters.stepping.tolerance, parameters.perturbation.strength)
        tolerance = max(tolerance, declared)
    if varied.varies != "none":
        factor = varied.factor(grid.x, grid.length, grid.periodic)
        friction = varied.friction(friction, loading.velocity, factor)
        if varied.varies == "normal_stress":
            extra = loading.normal_stress * (factor - 1.0) * grid.nodal_lengths
    return Interface(friction, tolerance, extra_normal=extra)


Arrays = dict[str, NDArray]


def run(
    parameters: Parameters,
    start: tuple[State, Control] | None = None,
    dynamics: Dynamics | None = None,
) -> Iterator[Instant]:
    """Integrate in time, yielding the initial state and then every accepted step, without end.

    Parameters
    ----------
    parameters : everything the result depends on.
    start : state and control of an instant of an earlier run with the same parameters: yields
        what follows it there, to the last bit.
    dynamics : what is to step, by default the usual composition for the parameters.

    Raises
    ------
    SimulationFailure
        The step size fell below ``stepping.shortest_step``, for its own sake or because every
        longer step ends in tension.
    """
    dynamics = composed(parameters) if dynamics is None else dynamics
    longest_step = parameters.longest_step
    longest = dynamics.scheme.coefficient(longest_step, longest_step)
    if start is None:
        state, report = at_rest(dynamics, parameters.loading)
        start = state, Control(min(FIRST_STEP * parameters.memory_time, longest))
        yield Instant(state, report, start[1])
    state, control = start
    while True:
        instant = accepted_step(dynamics, parameters.stepping, state, control, longest)
        state, control = instant.state, instant.control
        yield instant


def simulate(
    parameters: Parameters,
    *,
    progress: Callable[[Instant], None] | None = None,
    start: Arrays | None = None,
    keep: Callable[[Callable[[], Arrays]], None] | None = None,
) -> xr.Dataset:
    """Run one simulation to its end and return its record.

    It has the interface's fields on (time, x), the driving force and the step sizes on (step), some
    fields of the bulk on (snapshot, y, x), of :data:`nucleation.simulation.recorded.RECORDED`, and
    the outcome as attributes. ``status`` says how the run ended and, after semicolons, what makes
    its event doubtful (:mod:`.remarks`). A run that fails has what it recorded.

    Parameters
    ----------
    parameters : everything the result depends on.
    progress : called with every accepted step.
    start : arrays that `keep` was offered by an earlier run with the same parameters; the run goes
        on from there, to the last bit as if it had never stopped.
    keep : called after every step with a function that returns all that the run is made of at this
        instant, to be stored for `start` (:class:`nucleation.simulation.checkpoints.Checkpoint`).
    """
    began = time.perf_counter()
    dynamics = composed(parameters)
    recorder = Recorder(parameters, dynamics)
    control, position, earlier = Control(0.0), None, 0.0
    if start is not None:
        recorder.restore(start)
        control = Control(float(start["wanted"]), recorder.steps, int(start["rejected"]))
        position = State.from_arrays(start), control
        earlier = float(start["wall_seconds"])
    outcome = Outcome.END_TIME
    try:
        for instant in run(parameters, position, dynamics):
            control = instant.control
            recorder.record(instant.state, instant.report)
            if progress is not None:
                progress(instant)
            if recorder.covers_event:
                outcome = Outcome.AFTER_EVENT
                break
            if instant.state.time >= parameters.stepping.end_time:
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


def _arrays(instant: Instant, recorder: Recorder, seconds: float) -> Arrays:
    """All that a run is made of after a step, from which it can go on."""
    control = {
        "wanted": np.array(instant.control.wanted),
        "rejected": np.array(instant.control.rejected),
        "wall_seconds": np.array(seconds),
    }
    return control | instant.state.to_arrays() | recorder.to_arrays()


def peak_megabytes() -> float:
    """Largest resident memory of this process so far (MB)."""
    kilobytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return kilobytes / (1e6 if sys.platform == "darwin" else 1e3)
