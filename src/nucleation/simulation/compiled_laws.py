"""The friction law and the state evolution of a run, compiled.

What they are is said once, in NumPy, for arrays of any shape (:mod:`nucleation.model.friction`).
numba makes of the same functions one pass over the interface's nodes for each of their lines.
"""

from collections.abc import Callable
from functools import cache
from inspect import getmembers, isfunction
from sys import modules
from types import ModuleType
from typing import Any

from numba.extending import register_jitable

from ..fem.compiling import compiled
from ..model.friction import evolution
from ..model.friction.law import Friction


@cache
def _compiled(function: Callable) -> Callable[..., Any]:
    for module in {evolution, modules[function.__module__]}:
        _let_be_called(module)
    return compiled(function)


@cache
def _let_be_called(module: ModuleType) -> None:
    """Let compiled functions call those of a module."""
    for _, function in getmembers(module, isfunction):
        if function.__module__ == module.__name__:
            register_jitable(function)


def formula(law: Friction) -> Callable[..., Any]:
    """:meth:`Friction.formula` of a law, compiled."""
    return _compiled(type(law).formula)


def implicit_log_state(law: Friction) -> Callable[..., Any]:
    """``implicit_log_state`` of a law's evolution, compiled."""
    return _compiled(law.evolution_law.implicit_log_state)
