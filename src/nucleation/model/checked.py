"""Dataclasses that read and check their declared quantities at construction."""

from collections.abc import Mapping
from typing import ClassVar

from .quantities import check, declarations
from .units import parse


class Checked:
    """Mixin that checks declared quantities and converts texts with a unit, "5mm", to SI units.

    A bad value is a ParameterError with name, value, unit and range.
    """

    called: ClassVar[Mapping[str, str]] = {}
    """Names in studies, files and messages, of the fields with a shorter one."""

    def __post_init__(self) -> None:
        for name, entry in declarations(type(self)).items():
            value = getattr(self, name)
            key = self.called.get(name, name)
            if isinstance(value, str) and not entry.worded:
                parsed = parse(key, value, entry)
                object.__setattr__(self, name, parsed)  # the dataclass is frozen
            else:
                check(key, value, entry)
