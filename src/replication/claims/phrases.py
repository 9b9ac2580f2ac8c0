"""Phrases that depend on the configuration's runs: their mesh, and ranges of numbers."""

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

PAPERS = "the paper's mesh"
_ELEMENTS = (400, 150)  # of the paper, along x and y


def mesh(rows: Iterable[Mapping[str, Any]]) -> str:
    """The mesh of runs: the paper's, or its numbers of elements.

    Examples
    --------
    >>> mesh([{"n_x": 400, "n_y": 150}])
    "the paper's mesh"
    >>> mesh([{"n_x": 80, "n_y": 10}])
    'a mesh of 80 x 10 elements'
    """
    elements = sorted({(int(row["n_x"]), int(row["n_y"])) for row in rows})
    if elements in ([], [_ELEMENTS]):
        return PAPERS
    shown = [f"{along} x {across}" for along, across in elements]
    if len(shown) == 1:
        return f"a mesh of {shown[0]} elements"
    return f"meshes of {shown[0]} to {shown[-1]} elements"


def span(values: Iterable[float], form: str | Callable[[float], str]) -> str:
    """The smallest and the largest finite number, or one if both look the same.

    Parameters
    ----------
    values : iterable of float
        Numbers of one unit.
    form : str or callable
        Format of each, or a function that formats one.

    Returns
    -------
    str
        Empty without a finite number.

    Examples
    --------
    >>> span([0.5, 0.75], ".2f"), span([0.541, 0.542], ".2f")
    ('0.50 to 0.75', '0.54')
    """
    known = [value for value in values if math.isfinite(value)]
    if not known:
        return ""
    ends = min(known), max(known)
    low, high = (form(end) if callable(form) else format(end, form) for end in ends)
    return low if low == high else f"{low} to {high}"


def caution(rows: Iterable[Mapping[str, Any]]) -> str:
    """Why numbers of coarse runs are no results; empty where none is coarser than the paper's."""
    own = list(rows)
    along, across = _ELEMENTS
    if all(row["n_x"] >= along and row["n_y"] >= across for row in own):
        return ""
    return (
        f"The runs that stand for the paper's have {mesh(own)}, the paper's {along} x {across}. "
        "They test the workflow: their numbers are no results."
    )
