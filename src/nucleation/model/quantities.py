"""Physical quantities: unit, allowed range and meaning of a parameter in one place.

Every parameter is declared once. Checks, help texts, the configuration's schema and the attributes
of datasets follow from its declaration.
"""

import dataclasses
import math
import numbers
import re
from collections.abc import Collection
from functools import cache
from typing import Any

_RANGE = re.compile(r"([\[(])(.+), (.+)([\])]) ?(.*)")


class ParameterError(ValueError):
    """A parameter is outside its allowed range; the message names key, value, unit and range.

    Examples
    --------
    >>> from nucleation.api import PAPER
    >>> try:
    ...     PAPER.replace(height=-1.0)
    ... except ParameterError as error:
    ...     print(error)
    height = -1.0 m is not allowed: height of the body (inf: half-space) must lie in [1e-12, inf] m
    """


@dataclasses.dataclass(frozen=True)
class Quantity:
    """Declaration of one parameter: meaning, unit, range with its brackets, symbol of the paper."""

    description: str
    unit: str = "1"
    low: float = -math.inf
    high: float = math.inf
    closed: str = "()"  # brackets of the range; a square one includes its end
    symbol: str = ""
    choices: Collection[str] = ()
    kind: str = "float"  # the field's annotation: "float", "int", "str" or "tuple[float, ...]"
    optional: bool = False  # whether None is allowed, with the meaning that the description gives
    name: str = ""  # in files, options and messages; that of the field if empty

    @property
    def worded(self) -> bool:
        """Whether the parameter is a word, not a number."""
        return bool(self.choices) or self.kind == "str"

    @property
    def many(self) -> bool:
        """Whether the parameter is a non-empty tuple of numbers, each in the range."""
        return self.kind.startswith("tuple")

    @property
    def element(self) -> "Quantity":
        """The declaration of one number of a tuple; of a single value, the declaration itself."""
        return dataclasses.replace(self, kind="float", optional=False) if self.many else self

    @property
    def unit_suffix(self) -> str:
        """The unit after a space, for messages; empty for pure numbers and words."""
        return "" if self.unit == "1" or self.worded else f" {self.unit}"

    @property
    def bounds(self) -> str:
        """The allowed range with its unit, ``(0, 1e+06] m``, or ``one of aging, slip``."""
        if self.choices:
            return "one of " + ", ".join(self.choices)
        if self.kind == "str":
            return "a non-empty text"
        return f"{self.closed[0]}{self.low:g}, {self.high:g}{self.closed[1]}{self.unit_suffix}"

    def inside(self, values: Any) -> Any:
        """Whether each number, in the declared unit, is in the range (never for NaN)."""
        low = values >= self.low if self.closed[0] == "[" else values > self.low
        high = values <= self.high if self.closed[1] == "]" else values < self.high
        return low & high

    def allows(self, value: Any) -> bool:
        """Whether a value has the declared type and range; no bool and no text is a number."""
        if isinstance(value, float) and self.kind == "float" and not self.choices:
            return bool(self.inside(value))
        if value is None:
            return self.optional
        if self.many:
            own = self.element
            return isinstance(value, tuple) and bool(value) and all(map(own.allows, value))
        if self.choices:
            return value in self.choices
        if self.kind == "str":
            return isinstance(value, str) and value != ""
        numeric = numbers.Integral if self.kind == "int" else numbers.Real
        if isinstance(value, bool) or not isinstance(value, numeric):
            return False
        return bool(self.inside(value))


def declared(description: str, allowed: str = "(-inf, inf)", **more: Any) -> Quantity:
    """A declaration whose range and unit are a text, ``(0.0, 1e6] m``; `more` are other fields.

    >>> height = declared("block height", "(0.0, 1e6] m", symbol="H")
    >>> height.low, height.high, height.closed, height.unit
    (0.0, 1000000.0, '(]', 'm')
    """
    ends = _RANGE.fullmatch(allowed)
    if ends is None:
        raise ValueError(f"{allowed!r} is no range: write it as [0.0, 1e6) m")
    left, low, high, right, unit = ends.groups()
    # a whole number stays one, since floats have no 2^63 - 1
    first, last = (int(end) if end.isdigit() else float(end) for end in (low, high))
    return Quantity(description, unit or "1", first, last, left + right, **more)


def quantity(
    description: str,
    allowed: str = "(-inf, inf)",
    *,
    default: Any = dataclasses.MISSING,
    **more: Any,
) -> Any:
    """A dataclass field with its declaration as of :func:`declared`, and its default (SI units)."""
    entry = declared(description, allowed, **more)
    return dataclasses.field(default=default, metadata={"quantity": entry})


def declarations(cls: Any) -> dict[str, Quantity]:
    """The declared quantities of a dataclass, by field name, with the kind of each field."""
    return _declarations(cls)


@cache  # a study of thousands of runs needs each group of each run
def _declarations(cls: Any) -> dict[str, Quantity]:
    found = {}
    for field in dataclasses.fields(cls):
        if "quantity" in field.metadata:
            entry: Quantity = field.metadata["quantity"]
            annotation = getattr(field.type, "__name__", str(field.type))
            kind = annotation.removesuffix(" | None")
            found[field.name] = dataclasses.replace(
                entry, kind=kind, optional=kind != annotation, name=entry.name or field.name
            )
    return found


def check(key: str, value: object, entry: Quantity) -> None:
    """Raise a ParameterError if a declaration does not allow the value (SI units) of a key."""
    if not entry.allows(value):
        raise ParameterError(refusal(key, value, entry))


def refusal(key: str, value: object, entry: Quantity) -> str:
    """The message for a value that is not allowed: key, value, unit, meaning and range."""
    rule = "must be" if entry.worded else "must lie in"
    if entry.kind == "int":
        rule = "must be an integer in"
    shown = f"{key} = {value!r}{entry.unit_suffix}"
    return f"{shown} is not allowed: {entry.description} {rule} {entry.bounds}"
