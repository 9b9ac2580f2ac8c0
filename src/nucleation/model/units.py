"""Values as people write them, "30 GPa" or 5um, and arrays that carry a unit, in SI units."""

import re
from decimal import Decimal
from functools import cache
from typing import Any

import numpy as np

from .quantities import ParameterError, Quantity, check

_DIGITS = r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
NUMBER = re.compile(rf"\s*([+-]?(?:{_DIGITS}|inf(?:inity)?))\s*(?:/\s*({_DIGITS}))?\s*(.*?)\s*")
WITH_COMMA = re.compile(r"[+-]?[\d.]*,[\d.,]*\d")
UNIT = re.compile(r"[A-Za-zµμ_%*/^0-9 ().\-⁰¹²³⁴⁵⁶⁷⁸⁹⁻·⋅]{1,60}")
COMMON_UNITS = (
    *("Pa", "kPa", "MPa", "GPa", "m", "km", "cm", "mm", "um", "nm", "s", "ms", "min", "h", "yr"),
    *("m/s", "mm/yr", "mm/s", "um/s", "kg/m^3", "Pa/s", "MPa/s"),
)
"""Units that a wrong one is compared with, in small letters."""


@cache
def registry() -> Any:
    """The units library's registry; made when a unit is first read, since that takes a while.

    It reckons in decimal numbers: 5 um is exactly the number that 5e-6 m is.
    """
    import pint

    return pint.UnitRegistry(non_int_type=Decimal)


def parse(key: str, text: str, entry: Quantity) -> Any:
    """The value in SI units that a text means.

    Parameters
    ----------
    key : str
        Name of the parameter, for messages.
    text : str
        A number with or without a unit; a choice or an integer where the declaration says so.
    entry : Quantity
        The declaration.

    Raises
    ------
    ParameterError
        Naming key, value, unit and range, if it is no number, has another dimension or lies
        outside the range.
    """
    value: Any = text
    try:
        if entry.kind == "int":
            value = int(text) if re.fullmatch(r"\s*[+-]?\d{1,18}\s*", text) else text
        elif not entry.worded:
            value = _number(text, entry)
    except ValueError as error:
        rule = f"{entry.description} must lie in {bounds(entry)}"
        raise ParameterError(f"{key} = {text!r} is not allowed: {rule}; {error}") from None
    check(key, value, entry)
    return value


def _number(text: str, entry: Quantity) -> float:
    """The number that a text means: a decimal or a fraction, with or without a unit."""
    comma = WITH_COMMA.match(text.strip())
    if comma:
        written = comma[0]
        if "." in written or written.count(",") > 1:
            raise ValueError("write it without separators of thousands")
        point = re.sub(r"^([+-]?),", r"\g<1>0.", written).replace(",", ".")
        raise ValueError(f"write a decimal point, {point} in place of {written}")
    parts = NUMBER.fullmatch(text)
    if not parts or (parts[2] and not float(parts[2])):
        raise ValueError("it is no number with a unit")
    number = Decimal(parts[1]) / Decimal(parts[2] or 1)
    return float(_quantity(number, parts[3], entry) if parts[3] else number)


def _quantity(number: Decimal, unit: str, entry: Quantity) -> Decimal:
    """A number of some unit in the declared unit; raises ValueError with the reason."""
    import pint

    units = registry()
    try:
        if not UNIT.fullmatch(unit):
            raise ValueError
        plain = re.sub(r"(?<=[A-Za-zµμ])(-?\d+)", r"**\1", unit.replace("⋅", "*"))  # kg⋅m-3
        given = units.Quantity(number, units.parse_units(plain))
    except Exception:  # the library raises errors of many kinds for units it can't read
        close = next((u for u in COMMON_UNITS if u.lower() == unit.lower()), "")
        hint = f"; did you mean {close}?" if close else ""
        raise ValueError(f"{unit} is not a known unit{hint}") from None
    try:
        return given.to("dimensionless" if entry.unit == "1" else entry.unit).magnitude
    except pint.DimensionalityError:
        wanted = "it has no dimension" if entry.unit == "1" else f"{entry.unit} is needed"
        raise ValueError(f"{unit} is a unit of {_dimension(given)}, but {wanted}") from None


def magnitude(key: str, value: Any, entry: Quantity) -> Any:
    """The numbers of an array in the declared unit, if it carries one; others as they are.

    Parameters
    ----------
    key : str
        Name of the parameter, for messages.
    value : array_like, text, pint.Quantity or DataArray
        A text is read by :func:`parse`. A DataArray (or anything else with ``attrs``) states its
        unit as the attribute ``units``, in the style of CF (``"MPa"``, ``"m s-1"``), or holds a
        pint quantity. Lists may hold texts and pint quantities.
    entry : Quantity
        The declaration.

    Raises
    ------
    ParameterError
        If the unit is unknown or of another dimension, or if the object is a quantity of another
        library, whose unit would be lost.
    """
    if isinstance(value, (list, tuple)) and any(map(_carries_unit, value)):
        return [magnitude(f"{key}[{i}]", item, entry) for i, item in enumerate(value)]
    if isinstance(value, str):
        return parse(key, value, entry)
    if np.ma.is_masked(getattr(value, "magnitude", value)):
        raise ParameterError(
            f"{key} is not allowed: some of its values are masked; give {entry.description} "
            "everywhere"
        )
    if is_quantity(value):
        return rescaled(key, value.magnitude, f"{value.units:D}", entry)
    attributes = getattr(value, "attrs", None)
    if isinstance(attributes, dict):
        if is_quantity(getattr(value, "data", None)):
            return value.copy(data=magnitude(key, value.data, entry))
        if "units" in attributes:
            return rescaled(key, value, attributes["units"], entry)
    if _carries_unit(value):
        raise ParameterError(
            f"{key}: quantities of {type(value).__module__.partition('.')[0]} are not known here; "
            f"give the numbers in {entry.unit}, or a pint quantity"
        )
    return value


def is_quantity(value: Any) -> bool:
    """Whether it is a quantity of the units library, of any registry."""
    return hasattr(value, "magnitude") and hasattr(value, "units")


def _carries_unit(value: Any) -> bool:
    other = hasattr(value, "unit") and hasattr(value, "value")  # of another library
    return isinstance(value, str) or is_quantity(value) or other


def rescaled(key: str, values: Any, unit: Any, entry: Quantity) -> Any:
    """The values (of a unit) in the declared unit."""
    try:
        if not isinstance(unit, str):
            raise ValueError(f"its unit is {unit!r}, which is no text")
        factor = _quantity(Decimal(1), unit if unit.strip() not in ("", "1") else "dimensionless",
                           entry)  # fmt: skip
    except ValueError as error:
        raise ParameterError(
            f"{key} is not allowed: {entry.description} must lie in {bounds(entry)}; {error}"
        ) from None
    # a division by a whole number rounds but once
    numbers = values if hasattr(values, "attrs") else np.asarray(values, dtype=float)
    found = numbers * float(factor) if factor >= 1 else numbers / float(1 / factor)
    return found.assign_attrs(units=entry.unit) if hasattr(found, "assign_attrs") else found


def _dimension(given: Any) -> str:
    """The dimension of a quantity in words, ``length`` or ``mass / length ** 3``."""
    text = str(given.dimensionality).replace("[", "").replace("]", "")
    names = {
        "mass / length / time ** 2": "stress", "length / time": "velocity",
        "mass / length ** 3": "density", "dimensionless": "a pure number",
    }  # fmt: skip
    return names.get(text, text)


def bounds(entry: Quantity) -> str:
    """The range and its unit."""
    unit = "" if entry.unit == "1" or entry.choices else f" {entry.unit}"
    return entry.range_text() + unit
