"""Times of tasks that take turns, and a simulation in the middle of its creep to time."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from ...model.parameters import Parameters
from ...simulation.composition import composed
from ...simulation.run import run
from ...simulation.state import State
from ...simulation.step import Dynamics

CREEP_TIME = 1.0  # s, at which steps are timed
BLOCKS, STEPS = 8, 40  # of timed steps


def fastest(*tasks: Callable[[], Any], blocks: int | None = None) -> list[float]:
    """Wall time (s) of each task's fastest execution, the tasks taking turns."""
    best = [np.inf] * len(tasks)
    for _ in range(blocks or BLOCKS):
        for i, task in enumerate(tasks):
            start = time.perf_counter()
            task()
            best[i] = min(best[i], time.perf_counter() - start)
    return best


def creeping(parameters: Parameters) -> tuple[Dynamics, State, int]:
    """A simulation in the middle of its creep, and the rung of its longest step."""
    stepping = dataclasses.replace(parameters.stepping, tolerance=0.1, longest_step=0.4)
    for instant in run(dataclasses.replace(parameters, stepping=stepping)):
        if instant.state.time > CREEP_TIME:
            break
    dynamics, state = composed(parameters), instant.state
    longest = parameters.stepping.longest_step * parameters.memory_time
    rung = dynamics.scheme.steady_rung(longest)
    for _ in range(10):
        state, _ = dynamics.advance(state, rung)
    return dynamics, state, rung


def timed_steps(parameters: Parameters) -> Callable[[], None]:
    """A task that goes on by :data:`STEPS` steps of equal length."""
    dynamics, state, rung = creeping(parameters)

    def task() -> None:
        nonlocal state
        for _ in range(STEPS):
            state, _ = dynamics.advance(state, rung)

    return task


def with_mesh(parameters: Parameters, n_x: int, n_y: int) -> Parameters:
    """The same simulation on another mesh."""
    mesh = dataclasses.replace(parameters.mesh, n_x=n_x, n_y=n_y)
    return dataclasses.replace(parameters, mesh=mesh)
