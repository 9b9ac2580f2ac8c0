"""Physical quantities as dataclass fields: unit, allowed range and description in one place.

Every parameter of the project is declared once, with :func:`quantity`. From that single
declaration come the checks of the library's dataclasses, the JSON schema of the configuration
and the attributes of the datasets.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any


class ParameterError(ValueError):
    """A parameter is outside its allowed range; the message names key, value, unit and range."""


@dataclasses.dataclass(frozen=True)
class Quantity:
    """Declaration of one parameter: unit, open or closed range, description, paper symbol."""

    description: str
    unit: str = "1"
    low: float = -math.inf
    high: float = math.inf
    closed: str = ""  # which ends belong to the range: "low", "high", "both" or ""
    symbol: str = ""
    choices: tuple[str, ...] = ()

    def allows(self, value: Any) -> bool:
        """Whether `value` lies in the allowed range (never for NaN, bool or a string number)."""
        if self.choices:
            return value in self.choices
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            return False
        above = value > self.low or (self.closed in ("low", "both") and value == self.low)
        below = value < self.high or (self.closed in ("high", "both") and value == self.high)
        return above and below

    def range_text(self) -> str:
        """The allowed range as text, such as ``(0, 0.5)`` or ``one of aging, slip``."""
        if self.choices:
            return "one of " + ", ".join(self.choices)
        left = "[" if self.closed in ("low", "both") else "("
        right = "]" if self.closed in ("high", "both") else ")"
        return f"{left}{self.low:g}, {self.high:g}{right}"


def quantity(description: str, *, default: Any = dataclasses.MISSING, **declaration: Any) -> Any:
    """A dataclass field that carries its :class:`Quantity` as metadata."""
    entry = Quantity(description, **declaration)
    return dataclasses.field(default=default, metadata={"quantity": entry})


def declarations(cls: type) -> dict[str, Quantity]:
    """The declared quantities of a dataclass, by field name."""
    return {
        f.name: f.metadata["quantity"] for f in dataclasses.fields(cls) if "quantity" in f.metadata
    }


class Checked:
    """Mixin: a dataclass whose declared quantities are checked when it is made.

    Raises
    ------
    ParameterError
        Naming the class and key, the value, its unit and the allowed range.
    """

    def __post_init__(self) -> None:
        for name, entry in declarations(type(self)).items():
            check(f"{type(self).__name__}.{name}", getattr(self, name), entry)


def check(key: str, value: Any, entry: Quantity) -> None:
    """Raise a :class:`ParameterError` unless `entry` allows `value`."""
    if not entry.allows(value):
        unit = "" if entry.unit == "1" or entry.choices else f" {entry.unit}"
        raise ParameterError(
            f"{key} = {value!r}{unit} is not allowed: "
            f"{entry.description} must lie in {entry.range_text()}{unit}"
            if not entry.choices
            else f"{key} = {value!r} is not allowed: "
            f"{entry.description} must be {entry.range_text()}"
        )
