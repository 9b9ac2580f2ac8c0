"""Changes of the evidence by which a verdict is tried (docs/claims.md#what-would-change-it).

A claim that simulations decide names the part of its evidence that decides it. That part is changed
until the verdict does; a verdict that no reasonable change reaches is a number alone.
"""

import dataclasses
import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import xarray as xr

from ..tables.rows import Row
from .evidence import MEASURED_STABILITY, Evidence
from .pairs import Tables
from .simulations import LENGTHS

FORMULA = "formula"
"""What decides a claim without runs: the library's formula, or the paper's."""

_ENDS = ("", "_low", "_high")
_TRIED = (1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2, 1.0)  # parts of the reasonable amount, in turn
_PRECISION = 1e-3  # of the amount that flips a verdict

# What is reasonable: for lengths, onsets and L_s more than other definitions of the edge move them,
# 37 %; for slip rates and durations of a run an order of magnitude; for parts of a patch,
# deviations from a theory and the effect of a contrast a factor of two; for exponents of a height
# those between the thin limit and a constant.
_FEW = math.log(1.5)
_MANY = math.log(10.0)
_TWICE = math.log(2.0)
_EXPONENT = 0.5


@dataclasses.dataclass(frozen=True)
class Change:
    """A change of one part of the evidence by an amount of either sign; zero changes nothing.

    `what` has the part in words, `reasonable` the largest amount that is, `changed` the evidence
    after a change by an amount, and `said` that amount in words.
    """

    what: str
    reasonable: float
    changed: Callable[[Any, float], Any]
    said: Callable[[float], str]

    def text(self, amount: float) -> str:
        """The change by an amount in words."""
        return f"{self.what} {self.said(amount)}"


def least_change(change: Change, held: Callable[[Any], bool | None], evidence: Any) -> float | None:
    """The least reasonable amount by which a verdict changes; None without one.

    `held` says of some evidence whether the statement holds. The amount is the one after which it
    differs, found to a thousandth of itself.
    """
    now = held(evidence)

    def flipped(amount: float) -> bool:
        return held(change.changed(evidence, amount)) is (not now)

    more = _flip(flipped, change.reasonable)
    less = _flip(lambda amount: flipped(-amount), change.reasonable)
    found = [amount for amount in (more, None if less is None else -less) if amount is not None]
    return min(found, key=abs, default=None)


def _flip(flipped: Callable[[float], bool], reasonable: float) -> float | None:
    """The least amount up to the reasonable one that makes a verdict another, by bisection."""
    below = 0.0
    for part in _TRIED:
        above = part * reasonable
        if flipped(above):
            break
        below = above
    else:
        return None
    while above - below > _PRECISION * above:
        middle = 0.5 * (below + above)
        below, above = (below, middle) if flipped(middle) else (middle, above)
    return above


# -- runs of the paper's set --------------------------------------------------------------------


def _times(amount: float) -> str:
    return f"multiplied by {math.exp(amount):.4g}"


def _of_rows(
    columns: Iterable[str], factor: Callable[[Row, float], float]
) -> Callable[[Evidence, float], Evidence]:
    """Columns of the runs' table times a factor of the row and the amount."""
    names = tuple(columns)

    def changed(evidence: Evidence, amount: float) -> Evidence:
        def of_row(row: Row) -> Row:
            return {
                **row,
                **{name: row[name] * factor(row, amount) for name in names if name in row},
            }

        return evidence.with_rows(of_row)

    return changed


def _scaled(
    what: str,
    columns: Iterable[str],
    reasonable: float,
    where: Callable[[Row], bool] = lambda row: True,
) -> Change:
    """Columns of some rows times exp(amount)."""
    factor = _of_rows(columns, lambda row, x: math.exp(x) if where(row) else 1.0)
    return Change(what, reasonable, factor, _times)


def _tilted(what: str, symbol: str, columns: Iterable[str], by: str) -> Change:
    """Columns times a power of another column."""
    factor = _of_rows(columns, lambda row, x: row[by] ** x)
    return Change(
        what, _EXPONENT, factor, lambda x: f"multiplied by {symbol} to the power of {x:.3g}"
    )


def _measure(what: str, column: str, reasonable: float = _MANY) -> Change:
    """One measure of each run, with its range."""
    return _scaled(what, [f"{column}{end}" for end in _ENDS], reasonable)


def _stress(evidence: Evidence, amount: float) -> Evidence:
    """Largest normal stresses, raised by an amount of sigma0."""
    name, unit = "largest_normal_stress_ever", evidence.base.fault.normal_stress
    return evidence.with_rows(lambda row: {**row, name: row[name] + amount * unit})


def _dataset(part: str, name: str) -> Callable[[Evidence, float], Evidence]:
    """A variable of a dataset of the evidence times exp(amount)."""

    def changed(evidence: Evidence, amount: float) -> Evidence:
        data = getattr(evidence, part)
        other = data.assign({name: data[name] * math.exp(amount)})
        return dataclasses.replace(evidence, **{part: other})

    return changed


def _is_varied(row: Row) -> bool:
    """Whether a run has another law or initial age than most."""
    return row["evolution"] != "aging" or row["initial_state"] != 1.0


_PATCH = [MEASURED_STABILITY]
_LENGTHS = (*LENGTHS, "length_low", "length_high")

_OF_PAPER = {
    "lengths": _scaled("lengths", _LENGTHS, _FEW),
    "lengths by height": _tilted("lengths", "$H$", _LENGTHS, "height"),
    "lengths of other laws": _scaled(
        "lengths with the slip law or the old interface", _LENGTHS, _FEW, _is_varied
    ),
    "lengths by block": _tilted("lengths", "the block's length", _LENGTHS, "block_length"),
    "onsets": _measure("onset times", "onset_time", _FEW),
    "L_s": _scaled("$L_s$ of the patches", _PATCH, _FEW),
    "L_s of other laws": _scaled(
        "$L_s$ with the slip law or the old interface", _PATCH, _FEW, _is_varied
    ),
    "rates at the onset": _measure("largest slip rates at the onset", "onset_rate"),
    "regular share": _measure("that part of the patch", "regular_share", _TWICE),
    "approximated share": _measure(
        "that part of the patch", "state_rate_share_patch", math.log(2.0)
    ),
    "largest rates": _measure("largest slip rates", "largest_rate"),
    "growth times": _measure("times of the creep's growth", "growth_time"),
    "drop times": _measure("durations of the drop", "drop_time"),
    "rupture times": _measure("durations of the rupture", "rupture_time"),
    "front speeds": _measure("speeds of the patch's edge", "front_speed"),
    "patch rates": _measure("median slip rates in the patch", "patch_rate"),
    "normal stress": Change(
        "largest normal stresses", 1.0, _stress, lambda x: rf"{x:+.3g} $\sigma_0$"
    ),
    "elements along x": _measure("elements along x", "n_x"),
    "elements along y": _measure("elements along y", "n_y"),
    "usual steps": _measure("median time steps", "usual_step"),
    "shortest steps": _measure("shortest time steps", "shortest_step"),
    "growth of modes": Change(
        "measured growth rates", _FEW, _dataset("dispersion", "measured_growth"), _times
    ),
    "wavenumbers of modes": Change(
        "wavenumbers of the modes", _FEW, _dataset("dispersion", "wavenumber_over_critical"), _times
    ),
}


# -- pairs of deformable bodies -----------------------------------------------------------------


def _of_pairs(factor: Callable[[xr.Dataset, float], Any]) -> Callable[[Tables, float], Tables]:
    """Lengths of pairs, also those over the theory's, times a factor."""

    def changed(tables: Tables, amount: float) -> Tables:
        pairs = tables["pairs"]
        by = factor(pairs, amount)
        other = {name: pairs[name] * by for name in ("length", "length_ratio")}
        return {**tables, "pairs": pairs.assign(other)}

    return changed


def _deviation(pairs: xr.Dataset, amount: float) -> Any:
    """log(length/theory) times exp(amount)."""
    return pairs["length_ratio"] ** (math.exp(amount) - 1.0)


def _contrasted(pairs: xr.Dataset, amount: float) -> Any:
    return xr.where(pairs["f_beta"] != 0.0, math.exp(amount), 1.0)


def _most_contrasted(pairs: xr.Dataset, amount: float) -> Any:
    """Of the largest contrast alone, in one sense."""
    largest = np.isclose(pairs["f_beta"], pairs["f_beta"].max())
    return np.where(largest, math.exp(amount), 1.0)


def _by_contrast(pairs: xr.Dataset, amount: float) -> Any:
    """exp(amount) at the largest contrast, in either sense."""
    size = np.abs(pairs["f_beta"])
    return np.exp(amount * size / size.max())


def _growth_of_pairs(tables: Tables, amount: float) -> Tables:
    modes = tables["modes"]
    growth = modes["measured_growth"] * math.exp(amount)
    return {**tables, "modes": modes.assign(measured_growth=growth)}


_OF_PAIRS = {
    "lengths of pairs": Change("lengths", _FEW, _of_pairs(lambda pairs, x: math.exp(x)), _times),
    "deviations of pairs": Change(
        "logarithms of length over theory", _TWICE, _of_pairs(_deviation), _times
    ),
    "lengths of contrasts": Change(
        "lengths between different bodies", _FEW, _of_pairs(_contrasted), _times
    ),
    "length of the largest contrast": Change(
        "lengths at the largest contrast, the stiffer body below",
        _FEW,
        _of_pairs(_most_contrasted),
        _times,
    ),
    "lengths by contrast": Change(
        r"lengths, in proportion to $\lvert f \beta\rvert$, at the largest",
        _TWICE,
        _of_pairs(_by_contrast),
        _times,
    ),
    "growth of pairs' modes": Change("measured growth rates", _FEW, _growth_of_pairs, _times),
}

CHANGES: dict[str, Change] = {**_OF_PAPER, **_OF_PAIRS}
"""The parts of the evidence that decide claims, by the name that a claim gives."""
