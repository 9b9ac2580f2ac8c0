"""Values with units, such as "30 GPa" or 5um, as numbers in SI units; arrays that carry a unit."""

from __future__ import annotations

import contextlib
import math
import re
from decimal import Decimal
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from .quantities import ParameterError, Quantity, check, declarations

if TYPE_CHECKING:
    import pint

_DIGITS = r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
NUMBER = re.compile(rf"\s*([+-]?(?:{_DIGITS}|inf(?:inity)?))\s*(?:/\s*({_DIGITS}))?\s*(.*?)\s*")
"""A number or a fraction, and the unit after it."""

_INTEGER = re.compile(r"\s*[+-]?\d{1,18}\s*")
_FORTRAN = re.compile(r"([+-]?[\d.]+)[dD]([+-]?\d+)(.*)")
_WITH_COMMA = re.compile(r"[+-]?[\d.]*,[\d.,]*\d")
_UNIT = re.compile(r"[A-Za-zµμ_%*/^0-9 ().\-⁰¹²³⁴⁵⁶⁷⁸⁹⁻·⋅]{1,60}")
_EXPONENT = re.compile(r"(?<=[A-Za-zµμ])(-?\d+)")  # m-3 in the style of CF

UNITS = {
    "m": {"nm": "1e-9", "um": "1e-6", "mm": "1e-3", "cm": "1e-2", "m": "1", "km": "1e3"},
    "s": {
        "ps": "1e-12",
        "ns": "1e-9",
        "us": "1e-6",
        "ms": "1e-3",
        "s": "1",
        "min": "60",
        "h": "3600",
        "d": "86400",
        "yr": "31557600",
    },
    "m/s": {"mm/yr": "1/31557600000", "nm/s": "1e-9", "um/s": "1e-6", "mm/s": "1e-3", "m/s": "1"},
    "Pa": {"Pa": "1", "kPa": "1e3", "MPa": "1e6", "GPa": "1e9"},
    "Pa/s": {"Pa/s": "1", "kPa/s": "1e3", "MPa/s": "1e6", "GPa/s": "1e9"},
    "N/m": {
        "nN/m": "1e-9",
        "uN/m": "1e-6",
        "mN/m": "1e-3",
        "N/m": "1",
        "kN/m": "1e3",
        "MN/m": "1e6",
        "GN/m": "1e9",
        "TN/m": "1e12",
    },
}
"""Common units by SI unit, each with its exact size in that unit, the smallest first.

They are read without the library for all others, whose import takes longer than an answer.
"""

_NOT_SHOWN = ("cm", "min", "h", "d", "yr")
"""Units that are read, and in which no number is shown."""

_DIMENSIONS = {
    "mass / length / time ** 2": "stress",
    "length / time": "velocity",
    "mass / length ** 3": "density",
    "dimensionless": "a pure number",
}
"""Names for the dimensions that the units library writes as products."""


@cache
def sizes(unit: str) -> dict[str, Fraction]:
    """Sizes of the common units, in their SI unit; empty if there are none."""
    return {name: Fraction(size) for name, size in UNITS.get(unit, {}).items()}


def unit_for(value: float, unit: str) -> str:
    """The largest common unit of which a number (SI unit) is at least one, else the SI unit.

    >>> unit_for(3.1e9, "Pa"), unit_for(0.02, "m"), unit_for(1e-12, "m")
    ('GPa', 'mm', 'm')
    """
    found = unit
    for name, size in sizes(unit).items():
        is_one = abs(value) >= float(size) * (1.0 - 1e-9) and not math.isinf(value)
        if is_one and name not in _NOT_SHOWN:
            found = name
    return found


def in_unit(value: float, unit: str, digits: int = 4) -> str:
    """A number of an SI unit ("1": a pure number) in the common unit of its size.

    >>> in_unit(3.1e9, "Pa"), in_unit(5e-7, "m"), in_unit(0.2, "1")
    ('3.1 GPa', '500 nm', '0.2')
    """
    name = unit_for(float(value), unit)
    size = float(sizes(unit).get(name, 1))
    text = f"{float(value) / size:.{digits}g}"
    return text if unit == "1" else f"{text} {name}"


def in_metres(*lengths: float, form: str = ".4g", joined: str = " to ") -> str:
    """Lengths (m) of a fault as text, all in one unit, so that people can compare them.

    >>> in_metres(4.1602), in_metres(4.0349, 4.5762)
    ('4.16 m', '4.035 to 4.576 m')
    """
    return joined.join(format(float(length), form) for length in lengths) + " m"


class Checked:
    """Mixin of dataclasses that reads texts with a unit, "5mm", and checks declared quantities.

    A bad value is a ParameterError with name, value, unit and range.
    """

    def __post_init__(self) -> None:
        for name, entry in declarations(type(self)).items():
            value = getattr(self, name)
            if not entry.allows(value):
                value = in_si(entry.name, value, entry)
                object.__setattr__(self, name, value)  # the dataclass is frozen


@cache
def registry() -> pint.UnitRegistry:
    """The registry of the units library; made at the first unit, because its import is slow.

    The registry computes in decimal numbers, so that 5 um is exactly the number 5e-6 m.
    """
    import pint

    return pint.UnitRegistry(non_int_type=Decimal)


def in_si(key: str, value: Any, entry: Quantity) -> Any:
    """A value in SI units that the declaration allows, from a number, a word or a text."""
    if isinstance(value, str):
        return parse(key, value, entry)
    check(key, value, entry)
    return value


def parse(key: str, text: str, entry: Quantity) -> Any:
    """The value of a text in SI units: a number with or without a unit, an integer or a choice.

    A ParameterError names key, value, unit and range.
    """
    value: float | str = text
    try:
        if entry.kind == "int":
            if _INTEGER.fullmatch(text):
                value = int(text)
        elif not entry.worded:
            value = _number(text.strip(), entry)
    except ValueError as error:
        rule = f"{entry.description} must lie in {entry.bounds}"
        raise ParameterError(f"{key} = {text!r} is not allowed: {rule}; {error}") from None
    check(key, value, entry)
    return value


def _number(text: str, entry: Quantity) -> float:
    """A decimal number or a fraction, with or without a unit, in the declared unit."""
    comma = _WITH_COMMA.match(text)
    if comma:
        written = comma[0]
        if "." in written or written.count(",") > 1:
            raise ValueError("write it without separators of thousands")
        point = re.sub(r"^([+-]?),", r"\g<1>0.", written).replace(",", ".")
        raise ValueError(f"write a decimal point, {point} in place of {written}")
    fortran = _FORTRAN.fullmatch(text)
    if fortran:
        raise ValueError(f"write the exponent with e, {fortran[1]}e{fortran[2]}{fortran[3]}")
    parts = NUMBER.fullmatch(text)
    if parts is None or not float(parts[2] or 1):
        raise ValueError("it is no number with a unit")
    numerator, denominator, unit = parts.groups()
    if unit.startswith("*"):
        raise ValueError(f"write the unit without *, {numerator} {unit.lstrip('* ')}")
    number = Decimal(numerator) / Decimal(denominator or 1)
    return float(_converted(number, unit, entry) if unit else number)


def _converted(number: Decimal, unit: str, entry: Quantity) -> Decimal:
    """A number of a unit, converted to the declared unit; the ValueError gives the reason."""
    size = sizes(entry.unit).get(unit)
    if size is not None:
        return number * size.numerator / size.denominator
    import pint

    try:
        if not _UNIT.fullmatch(unit):
            raise ValueError
        text = _EXPONENT.sub(r"**\1", unit.replace("⋅", "*"))
        given = registry().Quantity(number, registry().parse_units(text))
    except Exception:  # the library raises errors of many kinds for units that it can't read
        common = [name for names in UNITS.values() for name in names]
        close = [name for name in common if name.lower() == unit.lower()]
        suggestion = f"; did you mean {close[0]}?" if close else ""
        raise ValueError(f"{unit} is not a known unit{suggestion}") from None
    pure = entry.unit == "1"
    try:
        return given.to("dimensionless" if pure else entry.unit).magnitude
    except pint.DimensionalityError:
        needed = "it has no dimension" if pure else f"{entry.unit} is needed"
        dimension = str(given.dimensionality).replace("[", "").replace("]", "")
        dimension = _DIMENSIONS.get(dimension, dimension)
        raise ValueError(f"{unit} is a unit of {dimension}, but {needed}") from None


def magnitude(key: str, value: Any, entry: Quantity) -> Any:
    """The numbers, in the declared unit, of a value that carries a unit; other values unchanged.

    A text is read by :func:`parse`. A DataArray has its unit in the attribute ``units``, in the
    style of CF (``"MPa"``, ``"m s-1"``), or contains a pint quantity. Lists may contain texts and
    quantities. Quantities of other libraries, whose unit would be lost, and masked values are
    refused.
    """
    if isinstance(value, (list, tuple)) and any(map(_carries_unit, value)):
        return [magnitude(f"{key}[{i}]", item, entry) for i, item in enumerate(value)]
    if isinstance(value, str):
        return parse(key, value, entry)
    if isinstance(value, (Decimal, Fraction)):
        return float(value)
    if np.ma.is_masked(getattr(value, "magnitude", value)):
        raise ParameterError(
            f"{key} is not allowed: some of its values are masked; give {entry.description} "
            "everywhere"
        )
    if is_quantity(value):
        return _of_quantity(key, value, entry)
    attributes = getattr(value, "attrs", None)
    if isinstance(attributes, dict):
        if is_quantity(getattr(value, "data", None)):
            return value.copy(data=magnitude(key, value.data, entry))
        if "units" in attributes:
            return rescaled(key, value, attributes["units"], entry)
    if _carries_unit(value):
        library = type(value).__module__.partition(".")[0]
        raise ParameterError(
            f"{key}: quantities of {library} are not known here; "
            f"give the numbers in {entry.unit}, or a pint quantity"
        )
    return value


def _of_quantity(key: str, value: Any, entry: Quantity) -> Any:
    """The numbers of a pint quantity: by its own registry, whose units may be others."""
    wanted = "dimensionless" if entry.unit == "1" else entry.unit
    unit = f"{value.units:D}"
    own = ours = math.nan
    with contextlib.suppress(Exception):  # of kinds of the user's library
        own = float(value._REGISTRY.Quantity(1.0, value.units).to(wanted).magnitude)
        ours = float(_converted(Decimal(1), unit or "dimensionless", entry))  # or it is unknown
    if math.isnan(own) or abs(ours / own - 1.0) < 1e-9:
        return rescaled(key, value.magnitude, unit, entry)  # without round-off, or with our error
    return np.asarray(value.magnitude, dtype=float) * own


def is_quantity(value: object) -> bool:
    """Whether a value is a quantity of the units library, of any registry."""
    return hasattr(value, "magnitude") and hasattr(value, "units")


def _carries_unit(value: object) -> bool:
    of_another_library = hasattr(value, "unit") and hasattr(value, "value")
    return isinstance(value, str) or is_quantity(value) or of_another_library


def rescaled(key: str, values: Any, unit: object, entry: Quantity) -> Any:
    """Numbers of a unit (empty or "1" for pure numbers) in the declared unit, of the same shape."""
    try:
        if not isinstance(unit, str):
            raise ValueError(f"its unit is {unit!r}, which is no text")
        if unit.strip() in ("", "1"):
            unit = "dimensionless"
        factor = _converted(Decimal(1), unit, entry)
    except ValueError as error:
        raise ParameterError(
            f"{key} is not allowed: {entry.description} must lie in {entry.bounds}; {error}"
        ) from None
    numbers = values if hasattr(values, "attrs") else np.asarray(values, dtype=float)
    # the inverse of a factor below 1 is a whole number, so that only the division rounds
    found = numbers * float(factor) if factor >= 1 else numbers / float(1 / factor)
    return found.assign_attrs(units=entry.unit) if hasattr(found, "assign_attrs") else found
