"""The simulation: steps of a controlled size, one after the other, and their record.

:func:`instants` yields one state after another; :func:`simulate` records them into a dataset. Both
can resume from stored arrays, and give the same result to the last bit as if they had never
stopped.
"""

import dataclasses
import resource
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
import xarray as xr

from ..model.settings import FIRST_STEP, Stepping
from ..run.run import Run
from ..types import Arrays
from .event import Outcome
from .interface import NewtonFailure
from .recording import Recorder
from .start import at_rest, composed
from .step import Dynamics, State, StepReport
from .stepping import Scheme, rung_below, rung_value

SAFETY = 0.85  # of the step size against the estimated error
PEAK_UNITS = 1e6 if sys.platform == "darwin" else 1e3  # of the largest resident memory, per MB
SMALLEST_SHRINKING = 0.2  # of the step size after a rejection
RESOLVED = 16.0  # shortest step over the round-off of the time


class SimulationFailure(RuntimeError):
    """The time integration cannot continue after a state."""

    def __init__(self, outcome: Outcome, state: State, reason: str) -> None:
        super().__init__(f"{outcome} at t = {state.time:.9g} s ({reason})")
        self.outcome = outcome


@dataclasses.dataclass(frozen=True)
class _Control:
    """Memory of the step-size control between accepted steps."""

    wanted: float  # leading coefficient beta (s) of the next step
    steps: int = 0  # accepted so far
    rejected: int = 0  # so far


@dataclasses.dataclass(frozen=True)
class Instant:
    """One accepted step of a run."""

    state: State
    report: StepReport
    control: _Control


def accepted_step(
    dynamics: Dynamics, stepping: Stepping, state: State, control: _Control, longest: float
) -> Instant:
    """Make the next step, so short that its error is within the tolerance.

    `longest` is the largest leading coefficient beta (s). Raises SimulationFailure if the step
    would have to be shorter than ``stepping.shortest_step``.
    """
    scheme = dynamics.scheme
    wanted = control.wanted
    rejected = control.rejected
    growth = scheme.largest_growth
    cause: NewtonFailure | None = None  # of the last rejection, if it was not the error estimate
    shortest = max(stepping.shortest_step, RESOLVED * float(np.spacing(state.time)))
    while True:
        rung = rung_below(min(wanted, longest))
        beta = rung_value(rung)
        if beta < shortest:
            outcome = Outcome.STEP_UNDERFLOW if cause is None else cause.outcome
            raise SimulationFailure(outcome, state, f"step {beta:.3g} s; {cause}")
        try:
            new, report = dynamics.advance(state, rung)
        except NewtonFailure as failure:
            cause = failure
            rejected += 1
            wanted = 0.5 * beta
            growth = 1.0  # the next step does not return to a size at which Newton's method failed
            continue
        factor = _step_factor(report.error / stepping.tolerance, scheme)
        if report.error > stepping.tolerance and np.isfinite(report.error):
            cause = None
            rejected += 1
            wanted = beta * min(factor, 0.9)
            continue
        step = new.last_step * min(factor, growth)
        wanted = scheme.leading_coefficient(step, new.last_step)
        return Instant(new, report, _Control(wanted, control.steps + 1, rejected))


def _step_factor(error: float, scheme: Scheme) -> float:
    """Factor on the step size for a local error given over the tolerance."""
    if not np.isfinite(error):
        return 1.0  # the first step has no estimate
    ideal = SAFETY * max(error, 1e-9) ** (-1.0 / scheme.error_order)
    return min(scheme.largest_growth, max(SMALLEST_SHRINKING, ideal))


def instants(
    run: Run, start: tuple[State, _Control] | None = None, dynamics: Dynamics | None = None
) -> Iterator[Instant]:
    """Integrate in time, yielding the initial state and then every accepted step, without end.

    `start` is an instant of an earlier run with the same parameters: the steps that followed it
    there are yielded, the same to the last bit. `dynamics` are by default :func:`composed`. Raises
    SimulationFailure if the step size fell below ``stepping.shortest_step``, also if every longer
    step ends in tension.

    >>> from nucleation.api import PAPER, Run
    >>> run = Run.sized(PAPER, block_length=0.9, n_x=16, n_y=2, end_time=0.02)
    >>> steps = instants(run)
    >>> first, second = next(steps), next(steps)
    >>> float(first.state.past_times[0]), bool(second.state.past_times[0] > 0.0)
    (0.0, True)
    """
    dynamics = composed(run) if dynamics is None else dynamics
    longest_step = run.longest_step
    longest = dynamics.scheme.leading_coefficient(longest_step, longest_step)
    if start is None:
        state, report = at_rest(dynamics, run)
        control = _Control(min(FIRST_STEP * run.memory_time, longest))
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
        The run.
    progress : callable
        Called with every accepted step.
    start : dict
        Arrays of `keep`: the run resumes there, with the same bits as if it had never stopped.
    keep : callable
        Called after every step with a function that returns all arrays of the run at this instant,
        to be stored (:mod:`nucleation.simulation.checkpoints`).

    The record has the interface's fields on (time, x), the driving force and the step sizes on
    (step), see :data:`nucleation.simulation.recorded.RECORDED`. Its attribute ``status`` says how
    the run ended and, after semicolons, why its event is doubtful. A run that fails has everything
    recorded until then.
    """
    began = time.perf_counter()
    earlier = 0.0
    dynamics = composed(run)
    recorder = Recorder(run, dynamics)
    control = _Control(0.0)
    position = None
    if start is not None:
        recorder.restore(start)
        control = _Control(float(start["wanted"]), recorder.steps, int(start["rejected"]))
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
        "status": "; ".join([outcome, *recorder.remarks()]),
        "completed": int(outcome.startswith("completed")),
        "steps": recorder.steps,
        "rejected_steps": control.rejected,
        "wall_seconds": earlier + time.perf_counter() - began,
        "peak_megabytes": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / PEAK_UNITS,
    }
    return dataset


def _arrays(instant: Instant, recorder: Recorder, seconds: float) -> Arrays:
    """All arrays of a run after a step, from which it can resume."""
    control = {
        "wanted": np.array(instant.control.wanted),
        "rejected": np.array(instant.control.rejected),
        "wall_seconds": np.array(seconds),
    }
    return control | instant.state.to_arrays() | recorder.to_arrays()
