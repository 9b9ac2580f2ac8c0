"""Dataclasses whose declared quantities are read and checked when they are made."""

from .quantities import check, declarations
from .units import parse


class Checked:
    """Mixin: what is declared is checked; a text with a unit, "5mm", becomes SI units.

    Raises
    ------
    ParameterError
        Naming the class and key, the value, its unit and the allowed range.
    """

    def __post_init__(self) -> None:
        for name, entry in declarations(type(self)).items():
            value, key = getattr(self, name), self._key(name)
            if isinstance(value, str) and not entry.worded:
                object.__setattr__(self, name, parse(key, value, entry))
            else:
                check(key, value, entry)

    @classmethod
    def _key(cls, name: str) -> str:
        """What an error calls a field."""
        return f"{cls.__name__}.{name}"
