"""Dataclasses whose declared quantities are read and checked when they are made."""

import re

from .quantities import check, declarations
from .units import parse


class Checked:
    """Mixin: what is declared is checked; a text with a unit, "5mm", becomes SI units.

    Raises
    ------
    ParameterError
        Naming the group and key, the value, its unit and the allowed range.
    """

    def __post_init__(self) -> None:
        group = _group(type(self))
        for name, entry in declarations(type(self)).items():
            value, key = getattr(self, name), f"{group}.{name}"
            if isinstance(value, str) and not entry.worded:
                object.__setattr__(self, name, parse(key, value, entry))
            else:
                check(key, value, entry)


def _group(cls: type) -> str:
    """What errors call a group of parameters: ``second_body`` for SecondBody and its subclasses."""
    name = cls.__mro__[cls.__mro__.index(Checked) - 1].__name__
    return re.sub("(?<=[a-z])(?=[A-Z])", "_", name).lower()
