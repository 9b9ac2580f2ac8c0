"""A length as an answer: its value and range, or why it has none."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ..theory.values import Numbers, labelled


class Answer(NamedTuple):
    """A length of one or many faults; numbers, arrays or DataArrays of equal shape."""

    value: Any
    """In metres, NaN where there is none."""
    low: Any
    """Lower end of its range (m)."""
    high: Any
    """Upper end of its range (m)."""
    status: Any
    """``value``; else ``between``, ``stable``, ``beyond`` or ``unknown``."""
    reason: Any
    """Why there is no value; empty where there is one."""
    doubt: Any = ""
    """Why the value is uncertain beyond its range; empty if it is not."""
    basis: Any = ""
    """On what the value depends, beside the fault; empty if on nothing else."""

    @property
    def exists(self) -> bool:
        """Whether a single fault has the length."""
        return bool(np.isfinite(self.value))

    @classmethod
    def none(cls, status: str, reason: str) -> Answer:
        """No length of a single fault, for a reason."""
        return cls(math.nan, math.nan, math.nan, status, reason)

    @classmethod
    def of_rows(cls, rows: Any) -> Answer:
        """An answer from its fields as rows of objects."""
        value, low, high = rows[:3].astype(float)
        return cls(value, low, high, *rows[3:])


FIELDS = len(Answer._fields)


def elementwise(function: Callable[..., str], *arrays: Numbers) -> Any:
    """The texts that a function of numbers returns at every point of arrays or DataArrays."""
    at_each = np.vectorize(function, otypes=[object])
    if not any(map(labelled, arrays)):
        return at_each(*arrays)[()]
    import xarray as xr

    return xr.apply_ufunc(at_each, *arrays)


def short(strength: float) -> str:
    """A relative strength as people write it.

    >>> short(1e-4), short(0.03)
    ('1e-4', '3e-2')
    """
    digits, power = f"{strength:.15e}".split("e")
    return f"{float(digits):g}e{int(power)}"
