"""Quantiles of the lengths of a fault with uncertain parameters, for ``nucleation length``."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from ..answers.answer import Answer
from ..answers.lengths import TITLES
from ..fault import Fault
from ..lengths.draws import QUANTILES, Draws, errors_of_quantiles, quantiles, with_never
from ..theory.status import BEYOND, STABLE
from . import DONE
from . import STABLE as CODE_OF_STABLE
from .given import system_of_fault
from .text import Row, show, table, wrapped

_HEAD = ("quantiles (m)", *(f"{share:.0%}" for share in QUANTILES), "share")
_REASONS = 3  # of those why draws lack a length, that are named


def print_quantiles(
    fault: Fault,
    names: Collection[str],
    drawn: Draws,
    paper: bool,
    with_literature: bool,
    as_json: bool,
    **options: Any,
) -> int:
    """Print the quantiles of all lengths of the draws of a fault; returns the exit code."""
    found = fault.lengths(**options)
    shown = found | found.literature if with_literature else found
    size = max(np.size(x) for x in drawn.values.values())
    answers = {
        key: Answer(*(np.broadcast_to(x, (size,)) for x in answer)) for key, answer in shown.items()
    }
    medians = {name: float(np.median(x)) for name, x in dict(fault).items() if np.ndim(x)}
    system = system_of_fault(fault.replace(**medians), names, paper)
    statuses = {key: answer.status for key, answer in answers.items()}
    counts = {
        "draws": drawn.total,
        "invalid": drawn.total - statuses["critical_length"].size,
        "outside": ", ".join(drawn.invalid),
        "stable": int(np.sum(statuses["critical_length"] == STABLE)),
        "beyond": int(np.sum(statuses["stability_length"] == BEYOND)),
    }
    lengths = [_described(key, answer) for key, answer in answers.items()]
    everything = {
        "system": system,
        "uncertain": list(drawn.uncertain),
        **counts,
        "lengths": lengths,
    }
    show(as_json, everything, _lines(everything))
    return DONE if counts["stable"] < size else CODE_OF_STABLE


def _described(key: str, answer: Answer) -> dict[str, Any]:
    """The quantiles of a length and the share of the draws that have it, for JSON, in SI units."""
    counted = with_never(answer.value, answer.status)
    there = np.isfinite(answer.value)
    reasons = dict.fromkeys(str(reason) for reason in answer.reason[~there])
    labels = [f"{share:g}" for share in QUANTILES]
    return {
        "key": key,
        "title": TITLES[key],
        "quantiles": dict(zip(labels, quantiles(counted).tolist(), strict=True)),
        "errors": dict(zip(labels, errors_of_quantiles(counted).tolist(), strict=True)),
        "share": float(there.mean()),
        "why_not": "; ".join(list(reasons)[:_REASONS]),
        "units": "m",
    }


def _lines(found: Mapping[str, Any]) -> list[str]:
    """The quantiles as a table."""
    text = f"{found['draws']} draws of {', '.join(found['uncertain'])}: {found['invalid']} left out"
    if found["invalid"]:
        text += f" ({found['outside']} not allowed)"
    text += f", {found['stable']} of the others stable, without L_c"
    if found["beyond"]:
        text += f", {found['beyond']} with an L_s beyond 3 L_c"
    rows: list[Row] = [_HEAD]
    nowhere = []
    for length in found["lengths"]:
        if not length["share"]:
            nowhere.append(length["title"])
            continue
        pairs = zip(length["quantiles"].values(), length["errors"].values(), strict=True)
        numbers = [as_sure(value, error) for value, error in pairs]
        rows.append([length["title"], *numbers, f"{length['share']:.1%}"])
    lines = [*wrapped(*found["system"], "", text, ""), *table(rows, range(1, len(_HEAD)))]
    if nowhere:
        lines += wrapped("", f"without a value in any draw: {'; '.join(nowhere)}")
    remark = (
        "stable: no patch nucleates in the range of the search, which counts as an infinite "
        "length; digits by the number of draws. share: of the draws with this length; full lengths"
    )
    return [*lines, *wrapped("", remark)]


def as_sure(value: float, error: float) -> str:
    """A quantile with the digits that its standard error leaves, at most four.

    >>> as_sure(2.8083, 0.04), as_sure(8.09, 0.6), as_sure(4.89012, 1e-5), as_sure(12.3, 20.0)
    ('2.81', '8.1', '4.89', '10')
    """
    if math.isinf(value):
        return "stable"
    digits = 4 if error == 0.0 else 1
    if value > 0.0 and 0.0 < error < math.inf:
        certain = math.floor(math.log10(value)) - math.floor(math.log10(error)) + 1
        digits = min(max(certain, 1), 4)
    return f"{float(f'{value:.{digits}g}'):g}"
