"""Quantiles of the lengths of a fault with uncertain parameters, for ``nucleation length``."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..fault import Fault
from ..lengths.answer import TITLES, Answer
from ..lengths.draws import QUANTILES, Draws, errors_of_quantiles, quantiles, with_never
from ..theory.status import BEYOND, STABLE
from ..theory.values import arrays_of
from ..types import Array
from . import DONE
from . import STABLE as CODE_OF_STABLE
from .faults import GivenFault
from .progress import progress_of
from .system_text import system_of_fault
from .text import Row, show, table, wrapped

_HEAD = ("quantiles (m)", *(f"{share:.0%}" for share in QUANTILES), "share")
_AT_ONCE = 10
"""Number of draws that are computed between two reports of progress."""

_REASONS = 3  # of those why draws lack a length, that are named


class _Quantiles(NamedTuple):
    key: str
    values: Array  # m
    errors: Array
    share: float  # of the draws with the length
    statuses: Array
    why_not: str  # some draws lack it


def print_quantiles(
    given: GivenFault,
    perturbed: Mapping[str, Any],
    weakening_rate: Any,
    as_json: bool,
) -> int:
    """Print the quantiles of all lengths of an uncertain fault; returns the exit code."""
    drawn = given.drawn
    assert drawn is not None
    found = [
        _quantiles(key, x)
        for key, x in _answers(
            given,
            perturbed,
            weakening_rate,
        ).items()
    ]
    middle = median_fault(given.fault)
    system = system_of_fault(middle, given.names, given.papers)
    counts = _counts(drawn, found)
    show(
        as_json,
        _described(
            system,
            drawn,
            counts,
            found,
        ),
        _lines(
            system,
            drawn,
            counts,
            found,
        ),
    )
    return DONE if found[0].share > 0.0 else CODE_OF_STABLE


def _answers(
    given: GivenFault, perturbed: Mapping[str, Any], weakening_rate: Any
) -> dict[str, Answer]:
    """The lengths of all draws, computed in parts that progress reports."""
    arrays = arrays_of(given.fault)
    size = drawn_size(given)
    report = progress_of("draws")
    options = dict(perturbed) or {"perturbation": "none"}
    parts: dict[str, list[Answer]] = {}
    for start in range(0, size, _AT_ONCE):
        rows = slice(start, min(start + _AT_ONCE, size))
        part = given.fault.replace(**{name: x[rows] for name, x in arrays.items()})
        rate = weakening_rate[rows] if np.ndim(weakening_rate) else weakening_rate
        for key, answer in part.lengths(**options, weakening_rate=rate).items():
            columns = [np.broadcast_to(x, (rows.stop - start,)) for x in answer]
            parts.setdefault(key, []).append(Answer(*columns))
        report(rows.stop, size)
    return {key: Answer(*map(np.concatenate, zip(*own, strict=True))) for key, own in parts.items()}


def drawn_size(given: GivenFault) -> int:
    """The number of valid draws."""
    assert given.drawn is not None
    return max(np.size(x) for x in given.drawn.values.values())


def median_fault(fault: Fault) -> Fault:
    """The fault of the medians of its arrays."""
    return fault.replace(**{name: float(np.median(x)) for name, x in arrays_of(fault).items()})


def _quantiles(key: str, answer: Answer) -> _Quantiles:
    counted = with_never(answer.value, answer.status)
    there = np.isfinite(answer.value)
    reasons = dict.fromkeys(str(reason) for reason in answer.reason[~there])
    values, errors = quantiles(counted), errors_of_quantiles(counted)
    why_not = "; ".join(list(reasons)[:_REASONS])
    return _Quantiles(
        key,
        values,
        errors,
        float(there.mean()),
        answer.status,
        why_not,
    )


def _counts(drawn: Draws, found: Sequence[_Quantiles]) -> dict[str, Any]:
    statuses = {one.key: one.statuses for one in found}
    return {
        "draws": drawn.total,
        "invalid": drawn.total - statuses["critical_length"].size,
        "outside": ", ".join(drawn.invalid),
        "stable": int(np.sum(statuses["critical_length"] == STABLE)),
        "beyond": int(np.sum(statuses["stability_length"] == BEYOND)),
    }


def _described(
    system: list[str],
    drawn: Draws,
    counts: dict[str, Any],
    found: Sequence[_Quantiles],
) -> dict[str, Any]:
    """The quantiles for JSON, in SI units."""
    lengths = []
    for one in found:
        numbers = {"quantiles": one.values, "errors": one.errors}
        by_share = {
            name: {
                f"{q:g}": x
                for q, x in zip(
                    QUANTILES,
                    values.tolist(),
                    strict=True,
                )
            }
            for name, values in numbers.items()
        }
        more = {"share": one.share, "why_not": one.why_not, "units": "m"}
        lengths.append({"key": one.key, "title": TITLES[one.key], **by_share, **more})
    return {"system": system, "uncertain": list(drawn.uncertain), **counts, "lengths": lengths}


def _lines(
    system: list[str],
    drawn: Draws,
    counts: dict[str, Any],
    found: Sequence[_Quantiles],
) -> list[str]:
    """The quantiles as a table."""
    rows: list[Row] = [_HEAD]
    for one in found:
        if one.share > 0.0:
            numbers = [
                as_sure(x, e)
                for x, e in zip(
                    one.values,
                    one.errors,
                    strict=True,
                )
            ]
            rows.append([TITLES[one.key], *numbers, f"{one.share:.1%}"])
    lines = wrapped(*system, "", _counts_in_words(drawn, counts), "")
    lines += table(rows, range(1, len(_HEAD)))
    nowhere = [TITLES[one.key] for one in found if not one.share]
    if nowhere:
        lines += wrapped("", f"without a value in any draw: {'; '.join(nowhere)}")
    remark = (
        "stable: no patch nucleates in the range of the search, which counts as an infinite "
        "length; digits by the number of draws. share: of the draws with this length; full lengths"
    )
    return [*lines, *wrapped("", remark)]


def _counts_in_words(drawn: Draws, counts: Mapping[str, Any]) -> str:
    text = f"{counts['draws']} draws of {', '.join(drawn.uncertain)}: {counts['invalid']} left out"
    if counts["invalid"]:
        text += f" ({counts['outside']} not allowed)"
    text += f", {counts['stable']} of the others stable, without L_c"
    if counts["beyond"]:
        text += f", {counts['beyond']} with an L_s beyond 3 L_c"
    return text


def as_sure(value: float, error: float) -> str:
    """A quantile with the digits that its standard error leaves, at most four.

    >>> as_sure(2.8083, 0.04), as_sure(8.09, 0.6), as_sure(4.89012, 1e-5), as_sure(12.3, 20.0)
    ('2.81', '8.1', '4.890', '10')
    """
    if math.isinf(value):
        return "stable"
    if not (value > 0.0 and math.isfinite(error)):
        return f"{value:.1g}"
    size = math.floor(math.log10(value))
    digits = 4
    if error > 0.0:
        certain = size - math.floor(math.log10(error)) + 1
        digits = min(max(certain, 1), 4)
    if abs(size) > 4:
        return f"{value:.{digits - 1}e}"
    decimals = digits - 1 - size
    return f"{round(value, decimals):.{max(decimals, 0)}f}"
