"""Units of axes that follow the size of the data."""

import math

_PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
_LONG_TIMES = (
    (2.0 * 365.25 * 86400.0, 365.25 * 86400.0, "years"),
    (2.0 * 86400.0, 86400.0, "days"),
    (7200.0, 3600.0, "h"),
)
"""Times (s) from which a unit is used, the unit (s), and its name."""


def prefixed(largest: float, unit: str) -> tuple[float, str]:
    """A unit with the prefix that keeps values between 1 and 1000.

    Parameters
    ----------
    largest : float
        The largest value on the axis, in `unit`.
    unit : str
        Name of the unit.

    Returns
    -------
    float
        Number by which values in `unit` are multiplied.
    str
        Name of the unit with its prefix.
    """
    if not (math.isfinite(largest) and largest > 0.0):
        return 1.0, unit
    exponent = 3 * math.floor(math.log10(largest) / 3.0)
    exponent = min(max(exponent, min(_PREFIXES)), max(_PREFIXES))
    return 10.0**-exponent, _PREFIXES[exponent] + unit


def time_unit(longest: float) -> tuple[float, str]:
    """The unit of a time axis.

    Parameters
    ----------
    longest : float
        The longest time on the axis (s).

    Returns
    -------
    float
        Number by which times in s are multiplied.
    str
        Name of the unit: seconds with a prefix up to one, else s, h, days or years.
    """
    if longest < 1.0:
        return prefixed(longest, "s")
    for least, unit, name in _LONG_TIMES:
        if longest >= least:
            return 1.0 / unit, name
    return 1.0, "s"
