"""The arguments of a recipe's function, from values as JSON keeps them."""

import inspect
from collections.abc import Callable, Mapping
from dataclasses import is_dataclass
from typing import Any


def arguments(function: Callable[..., Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """Values for a function, converted to dataclasses where it is annotated with them.

    Parameters
    ----------
    function : callable
        The function.
    values : mapping
        Values by argument. ``origin`` is dropped if the function has no such argument.

    Returns
    -------
    dict
        Arguments by name.
    """
    wanted = inspect.signature(function).parameters
    found = {}
    for name, value in values.items():
        if name not in wanted:
            if name != "origin":
                found[name] = value
            continue
        kind = wanted[name].annotation
        if isinstance(kind, str):
            kind = function.__globals__.get(kind)
        found[name] = _converted(kind, value)
    return found


def _converted(kind: Any, value: Any) -> Any:
    if not (isinstance(kind, type) and is_dataclass(kind) and isinstance(value, Mapping)):
        return value
    if hasattr(kind, "from_dict"):
        return kind.from_dict(value)
    values = {}
    for name, own in value.items():
        values[name] = tuple(own) if isinstance(own, list) else own  # JSON has no tuples
    return kind(**values)
