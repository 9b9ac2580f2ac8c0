"""Physical quantities as dataclass fields: unit, allowed range and description in one place.

Every parameter of the project is declared once, with :func:`quantity`. The checks of the
library's dataclasses, the JSON schema of the configuration and the attributes of the datasets
follow from that declaration.
"""

import dataclasses
import math
import numbers
import re
from collections.abc import Collection
from functools import cache
from typing import Any, cast

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
    """Declaration of one parameter: unit, open or closed range, description, paper symbol."""

    description: str
    unit: str = "1"
    low: float = -math.inf
    high: float = math.inf
    closed: str = ""  # which ends belong to the range: "low", "high", "both" or ""
    symbol: str = ""
    choices: Collection[str] = ()
    kind: str = "float"  # the field's annotation: "float", "int", "str" or "tuple[float, ...]"
    optional: bool = False  # whether None is allowed, with the meaning that the description gives

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
        return dataclasses.replace(self, kind="float") if self.many else self

    @property
    def includes_low(self) -> bool:
        """Whether the lower end belongs to the range."""
        return self.closed in ("low", "both")

    @property
    def includes_high(self) -> bool:
        """Whether the upper end belongs to the range."""
        return self.closed in ("high", "both")

    @property
    def unit_suffix(self) -> str:
        """The unit after a space, for messages; empty for pure numbers and words."""
        return "" if self.unit == "1" or self.worded else f" {self.unit}"

    def allows(self, value: object) -> bool:
        """Whether `value` is in the allowed range (never for NaN, bool or a string number)."""
        if value is None:
            return self.optional
        if not self.many:
            return self._allows_one(value)
        if not isinstance(value, tuple) or not value:
            return False
        return all(map(self._allows_one, value))

    def _allows_one(self, value: object) -> bool:
        if self.choices:
            return value in self.choices
        if self.kind == "str":
            return isinstance(value, str) and value != ""
        numeric = numbers.Integral if self.kind == "int" else numbers.Real
        if isinstance(value, bool) or not isinstance(value, numeric):
            return False
        number = cast(float, value)
        if number == self.low:
            return self.includes_low
        if number == self.high:
            return self.includes_high
        return self.low < number < self.high

    def range_text(self) -> str:
        """The allowed range as text, such as ``(0, 0.5)`` or ``one of aging, slip``."""
        if self.choices:
            return "one of " + ", ".join(self.choices)
        if self.kind == "str":
            return "a non-empty text"
        left = "[" if self.includes_low else "("
        right = "]" if self.includes_high else ")"
        return f"{left}{self.low:g}, {self.high:g}{right}"


def declared(description: str, allowed: str = "(-inf, inf)", **more: Any) -> Quantity:
    """A declaration with the allowed range and the unit as a text.

    Parameters
    ----------
    description : str
        Meaning of the parameter, as messages and help texts print it.
    allowed : str
        The range, with a square bracket at an end that belongs to it, and the unit:
        ``(0.0, 1e6] m``.
    **more
        Other fields of :class:`Quantity`: symbol, choices or kind.

    Examples
    --------
    >>> height = declared("block height", "(0.0, 1e6] m", symbol="H")
    >>> height.low, height.high, height.closed, height.unit
    (0.0, 1000000.0, 'high', 'm')
    """
    ends = _RANGE.fullmatch(allowed)
    if ends is None:
        raise ValueError(f"{allowed!r} is no range: write it as [0.0, 1e6) m")
    left, low, high, right, unit = ends.groups()
    closed = {"[)": "low", "(]": "high", "[]": "both", "()": ""}[left + right]
    return Quantity(
        description,
        unit or "1",
        _end(low),
        _end(high),
        closed,
        **more,
    )


def _end(text: str) -> float:
    """An end of a range; a whole number stays one, since floats have no 2^63 - 1."""
    return int(text) if text.isdigit() else float(text)


def quantity(
    description: str,
    allowed: str = "(-inf, inf)",
    *,
    default: Any = dataclasses.MISSING,
    **more: Any,
) -> Any:
    """A dataclass field that carries its :class:`Quantity` as metadata.

    Parameters
    ----------
    description, allowed, **more
        As in :func:`declared`. The kind follows from the field's annotation.
    default : object
        The field's default, in SI units.

    Returns
    -------
    dataclasses.Field
    """
    entry = declared(description, allowed, **more)
    return dataclasses.field(default=default, metadata={"quantity": entry})


def declarations(cls: type) -> dict[str, Quantity]:
    """The declared quantities of a dataclass, by field name, with the kind of each field."""
    return dict(_declarations(cls))


@cache  # a study of thousands of runs needs each group of each run
def _declarations(cls: Any) -> dict[str, Quantity]:
    found = {}
    for field in dataclasses.fields(cls):
        if "quantity" not in field.metadata:
            continue
        text = str(field.type)
        annotation = getattr(field.type, "__name__", text)
        kind = annotation.removesuffix(" | None")
        found[field.name] = dataclasses.replace(
            field.metadata["quantity"],
            kind=kind,
            optional=kind != annotation,
        )
    return found


def plain(group: Any) -> dict[str, Any]:
    """The fields of a dataclass of plain values; faster than ``asdict``, which copies each."""
    names = [field.name for field in dataclasses.fields(group)]
    return {name: getattr(group, name) for name in names}


def check(key: str, value: object, entry: Quantity) -> None:
    """Check a value against its declaration.

    Parameters
    ----------
    key : str
        Name of the parameter, for the message.
    value : object
        The value in SI units.
    entry : Quantity
        The declaration.

    Raises
    ------
    ParameterError
        If `entry` does not allow the value.
    """
    if not entry.allows(value):
        raise ParameterError(refusal(key, value, entry))


def refusal(key: str, value: object, entry: Quantity) -> str:
    """The error message for a value that is not allowed.

    Parameters
    ----------
    key : str
        Name of the parameter.
    value : object
        The value in SI units.
    entry : Quantity
        The declaration.

    Returns
    -------
    str
        Key, value, unit, meaning and allowed range.
    """
    unit = entry.unit_suffix
    if entry.worded:
        rule = f"must be {entry.range_text()}"
    elif entry.kind == "int":
        rule = f"must be an integer in {entry.range_text()}{unit}"
    else:
        rule = f"must lie in {entry.range_text()}{unit}"
    return f"{key} = {value!r}{unit} is not allowed: {entry.description} {rule}"
