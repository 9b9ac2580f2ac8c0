"""Friction with its state at the end of a step, compiled for a run's law and state evolution.

Both are defined once, in NumPy, for arrays of any shape (:mod:`nucleation.model.friction`). numba
compiles the same functions into one pass over the nodes of the interface for each of their lines.
"""

from collections.abc import Callable
from functools import cache
from inspect import getmembers, getsource, isfunction
from sys import modules

import numpy as np
from numba.extending import register_jitable

from ..fem.compiling import compiled
from ..model.friction import Friction, evolutions
from ..types import Array

CompiledFriction = Callable[..., tuple[Array, Array, Array]]
"""Function of slip rates (m/s), the past part of log(phi), beta (s), v0 (m/s), D (m) and the law's
constants. It returns psi, f and df/dv (s/m) at the end of a step, see :func:`friction`."""


def friction(law: Friction) -> CompiledFriction:
    """Compile ``psi = past + beta dpsi/dt`` at the end of a step, f, and its total slope df/dv."""
    return _compiled(type(law).formula, law.evolution_law.implicit_log_state)


@cache
def _compiled(
    formula: Callable[..., tuple[Array, Array, Array]],
    implicit_log_state: Callable[..., tuple[Array, Array]],
) -> CompiledFriction:
    """The compiled function for a law's formula and a state evolution."""
    own = [
        modules[formula.__module__],
        modules[implicit_log_state.__module__],
        evolutions,
    ]
    for module in own:
        for _, function in getmembers(module, isfunction):
            if function.__module__ == module.__name__:
                register_jitable(function)
    register_jitable(formula)

    def _at_end(  # type: ignore[no-untyped-def]
        v,
        past,
        beta,
        v0,
        distance,
        constants,
    ):
        speed = np.sqrt(v * v + v0 * v0)
        psi, psi_by_rate = implicit_log_state(past, beta, speed / distance)
        coefficient, by_rate, by_log_state = formula(v, psi, constants)
        slope = by_rate + by_log_state * psi_by_rate * v / (speed * distance)
        return psi, coefficient, slope

    # numba finds compiled code by its name; processes share it, so the name has to be unique
    names = [module.__name__.rpartition(".")[2] for module in own]
    _at_end.__qualname__ = "_".join(names)
    content = "".join(map(getsource, own))
    return compiled(_at_end, content=content)
