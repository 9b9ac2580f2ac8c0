"""Control of the step size, from one accepted step to the next."""

import dataclasses

import numpy as np

from ..model.settings import Stepping
from .event import Outcome
from .interface import NewtonFailure
from .step import Dynamics, State, StepReport
from .stepping import BDF, rung_below, rung_value

SAFETY = 0.85  # of the step size against the estimated error
SMALLEST_SHRINKING = 0.2  # of the step size after a rejection
RESOLVED = 16.0  # shortest step over the round-off of the time


class SimulationFailure(RuntimeError):
    """The time integration cannot continue after a state."""

    def __init__(
        self,
        outcome: Outcome,
        state: State,
        reason: str,
    ) -> None:
        super().__init__(f"{outcome.value} at t = {state.time:.9g} s ({reason})")
        self.outcome = outcome


@dataclasses.dataclass(frozen=True)
class Control:
    """Memory of the step-size control between accepted steps."""

    wanted: float  # leading coefficient beta (s) of the next step
    steps: int = 0  # accepted so far
    rejected: int = 0  # so far


@dataclasses.dataclass(frozen=True)
class Instant:
    """One accepted step of a run."""

    state: State
    report: StepReport
    control: Control


def accepted_step(
    dynamics: Dynamics,
    stepping: Stepping,
    state: State,
    control: Control,
    longest: float,
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
        wanted = scheme.coefficient(step, new.last_step)
        return Instant(new, report, Control(wanted, control.steps + 1, rejected))


def _step_factor(error: float, scheme: BDF) -> float:
    """Factor on the step size for a local error given over the tolerance."""
    if not np.isfinite(error):
        return 1.0  # the first step has no estimate
    ideal = SAFETY * max(error, 1e-9) ** (-1.0 / scheme.error_order)
    return min(scheme.largest_growth, max(SMALLEST_SHRINKING, ideal))
