"""L_c, L_s and the length at the drop over one or two parameters of a fault, for a picture."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from nucleation.drop.drop_quantiles import TITLES, drop_quantiles
from nucleation.drop.expected_drop import expected_drop
from nucleation.model.parameters import Parameters
from nucleation.theory.status import NoLength
from nucleation.types import Array

if TYPE_CHECKING:
    import xarray as xr

BAND = (0.05, 0.5, 0.95)
"""Quantiles of uncertain parameters: low, middle and high."""

DOUBTS = 2  # that are named of all reasons not to rely on drops


def lengths_over(
    axes: Sequence[xr.DataArray],
    cases: Callable[[tuple[int, ...]], Sequence[Parameters]],
    lengths: Collection[str] = tuple(TITLES),
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Lengths at every point of one or two parameters.

    Parameters
    ----------
    axes : sequence of DataArray
        The parameters that vary, one or two: name, values in the unit in which they are shown, and
        the attributes ``long_name`` and ``units``.
    cases : callable
        Called with the indices of a point; returns the runs of that point, one, or one for each
        draw of uncertain parameters, or none where the fault is not valid.
    lengths : collection of str
        Keys of the lengths: ``critical_length``, ``stability_length``, ``expected_length``.
    progress : callable, optional
        Called with the number of points that are done and that of all.

    Returns
    -------
    Dataset
        ``length`` (m) over ``key``, ``end`` (low, middle, high) and the parameters: of one run its
        length, and of its drop the range in which it is expected; of several runs the quantiles of
        5, 50 and 95 %. NaN where there is none and infinite where a quantile of the draws is
        stable. ``doubtful`` over the parameters is the share of drops not to be relied upon, and
        ``why_not(key, ...)`` the reason where a length is missing. The attribute ``doubts`` has
        reasons not to rely on drops.
    """
    import xarray as xr

    shape = tuple(axis.values.size for axis in axes)
    keys = [key for key in TITLES if key in lengths]
    found = np.full((len(keys), len(BAND), *shape), np.nan)
    doubtful = np.zeros(shape)
    doubts: list[str] = []
    why = np.full((len(keys), *shape), "", dtype=object)
    for done, point in enumerate(np.ndindex(shape)):
        runs = cases(point)
        if runs:
            values, doubtful[point], doubt, reasons = _at(runs, keys)
            doubts += [doubt] if doubt else []
            found[(slice(None), slice(None), *point)] = values
            why[(slice(None), *point)] = reasons
        if progress is not None:
            progress(done + 1, doubtful.size)
    names = [str(axis.name) for axis in axes]
    coordinates: dict[str, Any] = {
        name: (name, axis.values, axis.attrs) for name, axis in zip(names, axes, strict=True)
    }
    return xr.Dataset(
        {
            "length": (("key", "end", *names), found, {"units": "m", "long_name": "length"}),
            "doubtful": (names, doubtful, {"units": "1", "long_name": "share of doubtful drops"}),
            "why_not": (("key", *names), why, {"long_name": "why the length is missing"}),
        },
        coords={"key": keys, "end": ["low", "middle", "high"], **coordinates},
        attrs={"doubts": "; ".join(list(dict.fromkeys(doubts))[:DOUBTS])},
    )


def _at(runs: Sequence[Parameters], keys: Sequence[str]) -> tuple[Array, float, str, list[str]]:
    """Lengths (m) of shape (key, end) at a point; share of doubtful drops, doubts, reasons."""
    others = [key for key in keys if key != "expected_length" or len(runs) > 1]
    rows: list[Any] = []
    reasons: list[str] = []
    doubtful, doubt = 0.0, ""
    if others:
        table = drop_quantiles(runs, lengths=others)
        rows += list(table["value"].sel(quantile=list(BAND)).values)
        reasons += [str(text) for text in table["why_not"].values]
        doubtful, doubt = table.attrs["doubtful"] / len(runs), table.attrs["doubts"]
    if len(others) < len(keys):
        try:
            drop = expected_drop(runs[0])
        except NoLength as none:
            rows.append([np.nan] * len(BAND))
            reasons.append(str(none))
        else:
            rows.append([drop.low, drop.length, drop.high])
            reasons.append("")
            doubtful, doubt = float(bool(drop.doubt)), drop.doubt
    return np.array(rows, dtype=float), doubtful, doubt, reasons
