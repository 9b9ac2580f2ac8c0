"""Values of a configuration with their unit, ``30 GPa`` or ``1/3``, as numbers in SI units."""

from typing import Any

from ..model.quantities import ParameterError
from ..model.units import parse
from . import schema


def read_units(value: Any, path: tuple[Any, ...] = ()) -> Any:
    """A configuration as read from YAML, copied, with numbers in place of texts that are such.

    So is ``1e-8``, which YAML takes for text. What is no allowed number stays, to be refused.

    Parameters
    ----------
    value : nested dictionaries and lists, or a part of them.
    path : the place of the part.
    """
    if isinstance(value, dict):
        return {key: read_units(own, (*path, key)) for key, own in value.items()}
    if isinstance(value, list):
        return [read_units(own, (*path, number)) for number, own in enumerate(value)]
    entry = schema.entry_at(path) if isinstance(value, str) else None
    try:
        return parse("", value, entry) if entry else value
    except ParameterError:
        return value
