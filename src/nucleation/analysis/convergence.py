"""Refinement of mesh and steps: how far onset and critical length still move.

Runs that differ in one numerical parameter alone are a sequence, ordered from coarse to fine. Each
run is compared with the next coarser one of its sequence, and three in a row give an order.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from typing import Any

import xarray as xr

REFINED = {"n_x": False, "n_y": False, "longest_step": True, "tolerance": True}
"""Parameters that are refined, and whether a smaller value is the finer one."""

FIXED = (*REFINED, "grading", "height", "law", "phi0", "kind", "strength", "seed")
"""What the runs of a sequence have in common, the refined parameter apart."""

FEWEST = 3  # runs that make a sequence

COLUMNS = (
    "refinement", "id", "law", "height", "phi0", "kind", "strength", "seed", "n_x", "n_y",
    "grading", "longest_step", "tolerance", "length",
    "length_change", "theory_length", "length_over_theory", "onset_time", "onset_time_high",
    "drop_time_change", "observed_order", "steps", "wall_seconds",
)  # fmt: skip

Row = dict[str, Any]


def sequences(rows: Sequence[Row], refined: str) -> list[list[Row]]:
    """Rows that differ in `refined` alone, three at least, each sequence from coarse to fine."""
    groups: dict[tuple[Any, ...], list[Row]] = defaultdict(list)
    for row in rows:
        groups[tuple(row[name] for name in FIXED if name != refined)].append(row)
    ordered = (
        sorted(group, key=lambda row: row[refined], reverse=REFINED[refined])
        for group in groups.values()
    )
    return [group for group in ordered if len(group) >= FEWEST]


def observed_order(values: Sequence[float], sizes: Sequence[float]) -> float:
    """Order p of an error ``size^p`` from three values, coarse to fine; NaN if they alternate.

    For sizes in one ratio ``q > 1`` it is ``log(d1 / d2) / log(q)``, with the differences d1 and
    d2 of successive values. NaN also for sizes that are not in one ratio.
    """
    first, second = values[1] - values[0], values[2] - values[1]
    ratio = sizes[0] / sizes[1]
    if not math.isclose(ratio, sizes[1] / sizes[2], rel_tol=1e-6) or first * second <= 0.0:
        return math.nan
    return math.log(first / second) / math.log(ratio)


def refinement_table(lengths: xr.Dataset) -> xr.Dataset:
    """The sequences found in a table of lengths, each run beside the next coarser one.

    Parameters
    ----------
    lengths : Dataset
        From :func:`nucleation.analysis.lengths.gather`, on ``run``.

    Returns
    -------
    Dataset
        On ``run``, :data:`COLUMNS`: ``refinement`` names the refined parameter, and a run has a
        row in each of its sequences. ``length_change`` is relative to the next coarser run,
        ``drop_time_change`` (s) and ``observed_order`` are those of the time at which the drop is
        complete, which is defined more sharply than its start.
    """
    rows = [
        {name: lengths[name].values[i].item() for name in map(str, lengths.data_vars)}
        for i in range(lengths.sizes["run"])
    ]
    found = [
        {"refinement": refined} | row
        for refined in REFINED
        for sequence in sequences(rows, refined)
        for row in _compared(sequence, refined)
    ]
    return xr.Dataset({name: ("run", [row[name] for row in found]) for name in COLUMNS})


def _compared(sequence: list[Row], refined: str) -> list[Row]:
    """The rows of a sequence with what each changes against the coarser ones."""
    sizes = [row[refined] if REFINED[refined] else 1.0 / row[refined] for row in sequence]
    drops = [row["onset_time_high"] for row in sequence]
    compared = []
    for i, row in enumerate(sequence):
        coarser = sequence[i - 1] if i else None
        changes = {
            "length_over_theory": row["length"] / row["theory_length"],
            "length_change": row["length"] / coarser["length"] - 1.0 if coarser else math.nan,
            "drop_time_change": drops[i] - drops[i - 1] if coarser else math.nan,
            "observed_order": (
                observed_order(drops[i - 2 : i + 1], sizes[i - 2 : i + 1]) if i > 1 else math.nan
            ),
        }
        compared.append(row | changes)
    return compared
