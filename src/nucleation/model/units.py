"""Values with units, such as "30 GPa" or 5um, as numbers in SI units; arrays that carry a unit."""

from __future__ import annotations

import math
import re
from decimal import Decimal
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from .quantities import ParameterError, Quantity, check

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

_COMMON_UNITS = (
    *("Pa", "kPa", "MPa", "GPa"),
    *("m", "km", "cm", "mm", "um", "nm"),
    *("s", "ms", "min", "h", "yr"),
    *("m/s", "mm/yr", "mm/s", "um/s"),
    "kg/m^3",
    *("Pa/s", "MPa/s"),
)
"""Suggestions for an unknown unit; upper and lower case are not distinguished."""

_DIMENSIONS = {
    "mass / length / time ** 2": "stress",
    "length / time": "velocity",
    "mass / length ** 3": "density",
    "dimensionless": "a pure number",
}
"""Names for the dimensions that the units library writes as products."""


@cache
def registry() -> pint.UnitRegistry:
    """The registry of the units library; made at the first unit, because its import is slow.

    The registry computes in decimal numbers, so that 5 um is exactly the number 5e-6 m.
    """
    import pint

    return pint.UnitRegistry(non_int_type=Decimal)


def parse(
    key: str,
    text: str,
    entry: Quantity,
) -> Any:
    """Read a value from text and convert it to SI units.

    Parameters
    ----------
    key : str
        Name of the parameter, for messages.
    text : str
        A number with or without a unit; a choice or an integer if the declaration requires one.
    entry : Quantity
        The declaration.

    Returns
    -------
    float, int or str
        The checked value in SI units.

    Raises
    ------
    ParameterError
        If the text is not a number, has another dimension or is outside the range; the message
        names key, value, unit and range.
    """
    value: float | str = text
    try:
        if entry.kind == "int":
            if _INTEGER.fullmatch(text):
                value = int(text)
        elif not entry.worded:
            value = _number(text, entry)
    except ValueError as error:
        rule = f"{entry.description} must lie in {bounds(entry)}"
        raise ParameterError(f"{key} = {text!r} is not allowed: {rule}; {error}") from None
    check(key, value, entry)
    return value


def _number(text: str, entry: Quantity) -> float:
    """A decimal number or a fraction, with or without a unit, in the declared unit."""
    comma = _WITH_COMMA.match(text.strip())
    if comma:
        written = comma[0]
        if "." in written or written.count(",") > 1:
            raise ValueError("write it without separators of thousands")
        point = re.sub(r"^([+-]?),", r"\g<1>0.", written).replace(",", ".")
        raise ValueError(f"write a decimal point, {point} in place of {written}")
    fortran = _FORTRAN.fullmatch(text.strip())
    if fortran:
        raise ValueError(f"write the exponent with e, {fortran[1]}e{fortran[2]}{fortran[3]}")
    parts = NUMBER.fullmatch(text)
    if parts is None:
        raise ValueError("it is no number with a unit")
    numerator, denominator, unit = parts.groups()
    if denominator and not float(denominator):
        raise ValueError("it is no number with a unit")
    number = Decimal(numerator) / Decimal(denominator or 1)
    if unit.startswith("*"):
        raise ValueError(f"write the unit without *, {numerator} {unit.lstrip('* ')}")
    if unit:
        number = _converted(number, unit, entry)
    return float(number)


def _converted(
    number: Decimal,
    unit: str,
    entry: Quantity,
) -> Decimal:
    """A number of a unit, converted to the declared unit; the ValueError gives the reason."""
    import pint

    try:
        given = registry().Quantity(number, _parsed_unit(unit))
    except Exception:  # the library raises errors of many kinds for units that it can't read
        raise ValueError(f"{unit} is not a known unit{_suggestion(unit)}") from None
    pure = entry.unit == "1"
    wanted = "dimensionless" if pure else entry.unit
    try:
        return given.to(wanted).magnitude
    except pint.DimensionalityError:
        needed = "it has no dimension" if pure else f"{entry.unit} is needed"
        dimension = _dimension(given)
        raise ValueError(f"{unit} is a unit of {dimension}, but {needed}") from None


def _dimension(given: pint.Quantity) -> str:
    """The dimension of a quantity in words, ``length`` or ``mass / length ** 3``."""
    text = str(given.dimensionality)
    text = text.replace("[", "").replace("]", "")
    return _DIMENSIONS.get(text, text)


def _suggestion(unit: str) -> str:
    """A hint at a common unit that differs only in upper and lower case."""
    for known in _COMMON_UNITS:
        if known.lower() == unit.lower():
            return f"; did you mean {known}?"
    return ""


def _parsed_unit(unit: str) -> pint.Unit:
    """A unit as the library represents it; also one such as kg⋅m-3."""
    if not _UNIT.fullmatch(unit):
        raise ValueError
    product = unit.replace("⋅", "*")
    text = _EXPONENT.sub(r"**\1", product)
    return registry().parse_units(text)


def magnitude(
    key: str,
    value: Any,
    entry: Quantity,
) -> Any:
    """Convert an array that carries a unit to the declared unit; leave other values unchanged.

    Parameters
    ----------
    key : str
        Name of the parameter, for messages.
    value : array_like, text, pint.Quantity or DataArray
        A text is read by :func:`parse`. A DataArray (or another object with ``attrs``) has its
        unit in the attribute ``units``, in the style of CF (``"MPa"``, ``"m s-1"``), or contains a
        pint quantity. Lists may contain texts and pint quantities.
    entry : Quantity
        The declaration.

    Returns
    -------
    array_like or DataArray
        The numbers in the declared unit, of the same shape as `value`.

    Raises
    ------
    ParameterError
        If the unit is unknown or of another dimension, if values are masked, or if the object is a
        quantity of another library: its unit would be lost.
    """
    listed = isinstance(value, (list, tuple))
    if listed and any(map(_carries_unit, value)):
        return [
            magnitude(f"{key}[{i}]", item, entry)  # with its place
            for i, item in enumerate(value)
        ]
    if isinstance(value, str):
        return parse(key, value, entry)
    if isinstance(value, (Decimal, Fraction)):
        return float(value)
    data = getattr(value, "magnitude", value)
    if np.ma.is_masked(data):
        raise ParameterError(
            f"{key} is not allowed: some of its values are masked; give {entry.description} "
            "everywhere"
        )
    if is_quantity(value):
        return _of_quantity(key, value, entry)
    attributes = getattr(value, "attrs", None)
    if isinstance(attributes, dict):
        if is_quantity(getattr(value, "data", None)):
            data = magnitude(key, value.data, entry)
            return value.copy(data=data)
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
    try:
        own = float(value._REGISTRY.Quantity(1.0, value.units).to(wanted).magnitude)
    except Exception:  # of kinds of the user's library; ours words the error
        return rescaled(key, value.magnitude, unit, entry)
    try:
        ours = float(_converted(Decimal(1), unit or "dimensionless", entry))
    except ValueError:  # a unit of the user's own
        ours = math.nan
    if abs(ours / own - 1.0) < 1e-9:
        return rescaled(key, value.magnitude, unit, entry)  # without round-off
    return np.asarray(value.magnitude, dtype=float) * own


def is_quantity(value: object) -> bool:
    """Whether a value is a quantity of the units library, of any registry."""
    return hasattr(value, "magnitude") and hasattr(value, "units")


def _carries_unit(value: object) -> bool:
    if isinstance(value, str) or is_quantity(value):
        return True
    return hasattr(value, "unit") and hasattr(value, "value")  # of another library


def rescaled(
    key: str,
    values: Any,
    unit: object,
    entry: Quantity,
) -> Any:
    """Convert numbers from a unit to the declared unit.

    Parameters
    ----------
    key : str
        Name of the parameter, for messages.
    values : array_like or DataArray
        The numbers, in `unit`.
    unit : str
        Their unit; empty or ``"1"`` for pure numbers.
    entry : Quantity
        The declaration.

    Returns
    -------
    ndarray or DataArray
        The numbers in the declared unit, of the same shape; a DataArray has it as ``units``.

    Raises
    ------
    ParameterError
        If the unit is not a text, unknown or of another dimension.
    """
    try:
        if not isinstance(unit, str):
            raise ValueError(f"its unit is {unit!r}, which is no text")
        if unit.strip() in ("", "1"):
            unit = "dimensionless"
        factor = _converted(Decimal(1), unit, entry)
    except ValueError as error:
        raise ParameterError(
            f"{key} is not allowed: {entry.description} must lie in {bounds(entry)}; {error}"
        ) from None
    numbers = values
    if not hasattr(values, "attrs"):
        numbers = np.asarray(values, dtype=float)
    # the inverse of a factor below 1 is a whole number, so that only the division rounds
    found = numbers * float(factor) if factor >= 1 else numbers / float(1 / factor)
    if hasattr(found, "assign_attrs"):
        return found.assign_attrs(units=entry.unit)
    return found


def bounds(entry: Quantity) -> str:
    """The allowed range with its unit."""
    return entry.range_text() + entry.unit_suffix
