"""Friction with its state at the end of a step, compiled for a run's law and state evolution.

What both are is said once, in NumPy, for arrays of any shape (:mod:`nucleation.model.friction`).
numba makes of the same functions one pass over the interface's nodes for each of their lines.
"""

from collections.abc import Callable
from functools import cache
from inspect import getmembers, getsource, isfunction
from sys import modules
from typing import Any

import numpy as np
from numba.extending import register_jitable

from ..fem.compiling import compiled
from ..model.friction import evolution
from ..model.friction.law import Friction
from ..types import Array


def friction(law: Friction) -> Callable[..., Any]:
    """The function of slip rates (m/s) and past states that a law makes; see :func:`_friction`."""
    return _friction(type(law).formula, law.evolution_law.implicit_log_state)


@cache
def _friction(formula: Callable[..., Any], implicit_log_state: Callable[..., Any]) -> Any:
    """``psi = past + beta dpsi/dt`` at the end of a step, f, and its total slope df/dv (s/m)."""
    own = modules[formula.__module__], modules[implicit_log_state.__module__], evolution
    for module in own:
        for _, function in getmembers(module, isfunction):
            if function.__module__ == module.__name__:
                register_jitable(function)
    register_jitable(formula)

    def at_end(v: Array, past: Array, beta: float, v0: float, distance: Any, constants: Any) -> Any:
        speed = np.sqrt(v * v + v0 * v0)
        psi, psi_by_rate = implicit_log_state(past, beta, speed / distance)
        coefficient, by_rate, by_log_state = formula(v, psi, constants)
        return psi, coefficient, by_rate + by_log_state * psi_by_rate * v / (speed * distance)

    # numba finds compiled code by name, and what two processes have compiled may meet in a third
    at_end.__qualname__ = "_".join(module.__name__.rpartition(".")[2] for module in own)
    return compiled(at_end, content="".join(map(getsource, own)))
