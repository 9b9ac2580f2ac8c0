"""Physical quantities as dataclass fields: unit, allowed range and description in one place.

Every parameter of the project is declared once, with :func:`quantity`. From that single
declaration come the checks of the library's dataclasses, the JSON schema of the configuration
and the attributes of the datasets.
"""

import dataclasses
import math
import numbers
from collections.abc import Collection
from functools import cache
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
    choices: Collection[str] = ()
    kind: str = "float"  # the field's annotation: "float", "int", "str" or "tuple[float, ...]"
    optional: bool = False  # whether it may be left out, None, for what its description says

    @property
    def worded(self) -> bool:
        """Whether the parameter is a word, no number."""
        return bool(self.choices) or self.kind == "str"

    @property
    def many(self) -> bool:
        """Whether the parameter is a non-empty tuple of numbers, each in the range."""
        return self.kind.startswith("tuple")

    def allows(self, value: Any) -> bool:
        """Whether `value` lies in the allowed range (never for NaN, bool or a string number)."""
        if value is None:
            return self.optional
        if self.many:
            return isinstance(value, tuple) and value != () and all(map(self._allows_one, value))
        return self._allows_one(value)

    def _allows_one(self, value: Any) -> bool:
        if self.choices:
            return value in self.choices
        if self.kind == "str":
            return isinstance(value, str) and value != ""
        number = numbers.Integral if self.kind == "int" else numbers.Real
        if isinstance(value, bool) or not isinstance(value, number):
            return False
        above = value > self.low or (self.closed in ("low", "both") and value == self.low)  # type: ignore[operator]
        below = value < self.high or (self.closed in ("high", "both") and value == self.high)
        return above and below

    def range_text(self) -> str:
        """The allowed range as text, such as ``(0, 0.5)`` or ``one of aging, slip``."""
        if self.choices:
            return "one of " + ", ".join(self.choices)
        if self.kind == "str":
            return "a non-empty text"
        left = "[" if self.closed in ("low", "both") else "("
        right = "]" if self.closed in ("high", "both") else ")"
        return f"{left}{self.low:g}, {self.high:g}{right}"


def quantity(description: str, *, default: Any = dataclasses.MISSING, **declaration: Any) -> Any:
    """A dataclass field that carries its :class:`Quantity` as metadata."""
    entry = Quantity(description, **declaration)
    return dataclasses.field(default=default, metadata={"quantity": entry})


def declarations(cls: type) -> dict[str, Quantity]:
    """The declared quantities of a dataclass, by field name, with the kind of each field."""
    return dict(_declarations(cls))


@cache  # a study of thousands of runs asks for each group of each run
def _declarations(cls: Any) -> dict[str, Quantity]:
    found = {}
    for field in dataclasses.fields(cls):
        if "quantity" in field.metadata:
            annotation = getattr(field.type, "__name__", str(field.type))
            kind = annotation.removesuffix(" | None")
            entry = field.metadata["quantity"]
            found[field.name] = dataclasses.replace(entry, kind=kind, optional=kind != annotation)
    return found


def plain(group: Any) -> dict[str, Any]:
    """The fields of a dataclass of plain values, which need none of ``asdict`` and its copies."""
    return {field.name: getattr(group, field.name) for field in dataclasses.fields(group)}


def check(key: str, value: Any, entry: Quantity) -> None:
    """Raise a :class:`ParameterError` unless `entry` allows `value`."""
    if not entry.allows(value):
        raise ParameterError(refusal(key, value, entry))


def refusal(key: str, value: Any, entry: Quantity) -> str:
    """The message that refuses a value: key, value, unit, meaning, and allowed range."""
    unit = "" if entry.unit == "1" or entry.worded else f" {entry.unit}"
    if entry.worded:
        rule = f"must be {entry.range_text()}"
    else:
        number = "be an integer in" if entry.kind == "int" else "lie in"
        rule = f"must {number} {entry.range_text()}{unit}"
    return f"{key} = {value!r}{unit} is not allowed: {entry.description} {rule}"
