"""Values with their units in the output of commands, as engineers write them."""

import math
from typing import Any

from ..model.quantities import Quantity

_ENGINEERING_UNITS = {
    "m": {"nm": 1e-9, "um": 1e-6, "mm": 1e-3, "m": 1.0, "km": 1e3},
    "s": {"ps": 1e-12, "ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0},
    "m/s": {
        "mm/yr": 1e-3 / (365.25 * 86400.0),
        "nm/s": 1e-9,
        "um/s": 1e-6,
        "mm/s": 1e-3,
        "m/s": 1.0,
    },
    "Pa": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
    "Pa/s": {"Pa/s": 1.0, "kPa/s": 1e3, "MPa/s": 1e6, "GPa/s": 1e9},
    "Pa/m": {"Pa/m": 1.0, "kPa/m": 1e3, "MPa/m": 1e6, "GPa/m": 1e9},
}
"""Engineering units by SI unit, each with its size in that unit, the smallest first."""


def with_unit(
    value: Any,
    entry: Quantity,
) -> str:
    """A value as text with its unit.

    Parameters
    ----------
    value : float, int or str
        In SI units.
    entry : Quantity
        Declaration of the parameter.

    Returns
    -------
    str
    """
    if isinstance(value, float):
        return in_unit(value, entry.unit, digits=6)
    return f"{value}{entry.unit_suffix}"


def in_unit(
    value: float,
    unit: str,
    digits: int = 4,
) -> str:
    """A number in an engineering unit.

    Parameters
    ----------
    value : float
        In SI units.
    unit : str
        The SI unit, "1" for pure numbers.
    digits : int
        Number of significant digits.

    Returns
    -------
    str

    Examples
    --------
    >>> in_unit(3.1e9, "Pa"), in_unit(5e-7, "m"), in_unit(0.2, "1")
    ('3.1 GPa', '500 nm', '0.2')
    """
    number = float(value)
    shown_unit, size = engineering_unit(number, unit)
    text = f"{number / size:.{digits}g}"
    return text if unit == "1" else f"{text} {shown_unit}"


def engineering_unit(value: float, unit: str) -> tuple[str, float]:
    """The engineering unit for a number, and its size.

    Parameters
    ----------
    value : float
        In SI units.
    unit : str
        The SI unit.

    Returns
    -------
    name : str
    size : float
        In the SI unit.
    """
    units = _ENGINEERING_UNITS.get(unit, {})
    found = (unit, 1.0)
    if math.isinf(value):
        return found
    for name, size in units.items():
        if abs(value) >= size * (1.0 - 1e-9):
            found = (name, size)
    return found
