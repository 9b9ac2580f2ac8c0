"""Dataclasses that read and check their declared quantities at construction."""

import re

from .quantities import check, declarations
from .units import parse


class Checked:
    """Mixin that checks declared quantities and converts texts with a unit, "5mm", to SI units.

    Raises
    ------
    ParameterError
        If a value is not allowed; the message names group and key, value, unit and range.
    """

    def __post_init__(self) -> None:
        cls = type(self)
        group = _group_name(cls)
        for name, entry in declarations(cls).items():
            value = getattr(self, name)
            key = f"{group}.{name}"
            if isinstance(value, str) and not entry.worded:
                parsed = parse(key, value, entry)
                object.__setattr__(self, name, parsed)  # the dataclass is frozen
            else:
                check(key, value, entry)


def _group_name(cls: type) -> str:
    """The name of a group in messages: ``second_body`` for SecondBody and its subclasses."""
    ancestors = cls.__mro__
    position = ancestors.index(Checked)
    name = ancestors[position - 1].__name__
    words = re.sub("(?<=[a-z])(?=[A-Z])", "_", name)
    return words.lower()
