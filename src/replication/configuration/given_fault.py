"""The fault that values by their names in studies define."""

import contextlib
import math
from collections.abc import Mapping
from typing import Any

from nucleation.lengths.draws import Range
from nucleation.model.friction.constants import CONSTANTS
from nucleation.model.friction.law import Friction
from nucleation.model.friction.registry import LAWS, law_declarations
from nucleation.model.parameters import Parameters, names
from nucleation.model.quantities import ParameterError
from nucleation.theory.of_runs import fault_of_run
from nucleation.theory.values import OF_THEORY, QUANTITIES

from .single_run import merged_parameters

IN_STUDIES = tuple(name for name in QUANTITIES if name not in OF_THEORY)
"""The parameters of a fault that simulations have too, under the same names."""

_LAW_IN_STUDIES = {names().short(f"friction.{name}") for name in law_declarations()}
_FRICTION = {"velocity", "evolution", *CONSTANTS, *_LAW_IN_STUDIES}
"""Names in studies of the parameters of friction laws, and of their constants at V."""


def fault_from(
    given: Mapping[str, Any],
    base: Parameters | None = None,
    complete: bool = False,
) -> dict[str, Any]:
    """The fault that values define.

    Parameters
    ----------
    given : mapping
        Values by their names in studies, in SI units, with the kind of ``second_body``.
    base : Parameters or None
        The parameters of a run that the values replace.
    complete : bool
        Whether parameters that are not given are the paper's.

    Returns
    -------
    dict
        Keywords of :class:`~nucleation.fault.fault.Fault`, some of which may be missing; with the
        friction law if its constants are known and the patch is pushed at an edge.

    Raises
    ------
    ParameterError
        If values contradict each other.
    """
    if base or complete or sets_law(given):
        return fault_of_run(merged_parameters(base, given))
    found = {name: given[name] for name in IN_STUDIES if name in given}
    if "zeta_over_a" in given and "a" in found:
        if {"zeta", "b"} & found.keys():
            raise ParameterError("zeta_over_a is not allowed together with zeta or b")
        found["zeta"] = given["zeta_over_a"] * found["a"]
    if given["second_body"] == "rigid":
        found["second_shear_modulus"] = math.inf
    law = _law_of(found, given)
    if law is not None and found.get("loading", "edge") == "edge":
        found["friction_law"] = law
    return found


def sets_law(given: Mapping[str, Any]) -> bool:
    """Whether parameters of a friction law are given that a, b and f would determine."""
    return any(given.keys() & Friction(law=law).set_by_expansion for law in LAWS)


def _law_of(
    values: Mapping[str, Any],
    given: Mapping[str, Any],
) -> Friction | None:
    """The friction law of the user's own fault, if its constants are known."""
    for name in ("velocity", "friction", "a", "slip_distance"):
        value = values.get(name)
        if not isinstance(value, float) or isinstance(value, Range):
            return None
    of_friction = {name: value for name, value in given.items() if name in _FRICTION}
    with contextlib.suppress(ParameterError):
        return merged_parameters(None, of_friction).friction
    return None
