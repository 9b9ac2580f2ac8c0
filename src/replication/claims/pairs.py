"""Eqs. (6) to (9) and Figure 2 against simulations of two deformable bodies.

The paper has these as theory alone. Lengths come from the table of pairs, at the declared strength
in its columns; a length is the mean of a fault's realisations, with their range. Eqs. (7) and (8)
are also compared with the elastic response that simulated modes between two sliding layers have.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from nucleation.types import Array

from ..tables.pair_modes import DEEP, measured_response
from ..tables.pairs import over_realisations
from . import printed
from .expected import Computation, Estimate, Missing, Result, between
from .phrases import span

Tables = Mapping[str, xr.Dataset]
"""The table of ``pairs`` (:mod:`replication.tables.pairs`) and that of their ``modes``."""

_LEAST_HEIGHT = 1.0  # of a block that counts as a half-space, over the theory's length
_HEIGHT_TOLERANCE = 0.10  # up to which lengths do not depend on the height of the blocks
_STRONG = 0.05  # f beta from which on two materials differ
_SLIDING = f"Homogeneous sliding of two layers {DEEP:g} wavelengths high, integrated in time."
_CAUSE = (
    "The push changes the normal stress under the patch, down or up; in homogeneous sliding it is "
    "uniform (results: Which side is stiff decides whether contrast shortens the patch)."
)


class _Senses(NamedTuple):
    """Lengths over L_c^M, (weakening, contrast), with the stiffer body below and above."""

    weakening: Array
    contrast: Array
    identical: Array
    below: Array
    above: Array


# -- rows of the table --------------------------------------------------------------------------


def _faults(evidence: Tables) -> pd.DataFrame:
    """The faults of all studies, each the mean of its realisations.

    zeta/a and f beta are rounded so that equal values can be compared; lengths are also over L_c^M,
    the length with the modulus M and no contrast.
    """
    faults = over_realisations(evidence["pairs"]).to_dataframe()
    return faults.assign(
        weakening=faults["zeta_over_a"].round(3),
        contrast=faults["f_beta"].round(12),
        over_modulus=faults["length_ratio"] * faults["half_space_ratio"],
    )


def _some(rows: pd.DataFrame, missing: str) -> pd.DataFrame:
    """The same rows; raises Missing with a message if there are none."""
    if rows.empty:
        raise Missing(missing)
    return rows


def _identical(faults: pd.DataFrame) -> pd.DataFrame:
    """Faults between identical blocks as high as half-spaces, of all studies, by zeta/a."""
    high = faults["height"] >= _LEAST_HEIGHT * faults["critical_length"]
    found = faults[high & (faults["contrast"] == 0.0)].sort_values(["weakening", "height"])
    return _some(found, "No identical blocks are as high as half-spaces")


def _settled(evidence: Tables) -> tuple[pd.DataFrame, str]:
    """The pairs of Figure 2, and sentences on whether lengths depend on the blocks' height.

    Each zeta/a with lengths that do, between identical blocks, is left out.
    """
    faults = _faults(evidence)
    rows = faults[faults["role"] == "figure_2_simulated"]
    _some(rows, "The table of pairs has no runs with the role figure_2_simulated")
    untested = []
    notes = ""
    for value, own in _identical(faults).groupby("weakening"):
        lengths = own["length_ratio"]
        if value not in rows["weakening"].values:
            continue
        if lengths.size < 2:
            untested.append(f"{value:g}")
        elif np.ptp(lengths) > _HEIGHT_TOLERANCE * lengths.min():
            rows = rows[rows["weakening"] != value]
            notes += (
                rf" $\zeta/a = {value:g}$ is left out: between identical blocks the length over "
                f"$L_c$ depends on their height, {_at_heights(own)}."
            )
    if untested:
        notes += (
            rf" Whether it depends on the height for $\zeta/a$ = {' and '.join(untested)} was not "
            "tested: each has blocks of one height."
        )
    return _some(rows, "All lengths depend on the height of the blocks"), notes


def _at_heights(rows: pd.DataFrame) -> str:
    pairs = zip(
        rows["length_ratio"],
        rows["height"],
        strict=True,
    )
    return " and ".join(f"{length:.2f} at {height:g} m" for length, height in pairs)


def _both_senses(rows: pd.DataFrame) -> _Senses:
    """The lengths in both senses of each contrast; raises Missing without one of them."""
    lengths = rows.pivot(
        index="weakening",
        columns="contrast",
        values="over_modulus",
    )
    positive = np.array([contrast for contrast in lengths.columns if contrast > 0.0])
    wanted = lengths.reindex(columns=[0.0, *positive, *-positive])
    if not positive.size or wanted.isna().any(axis=None):
        raise Missing(r"A $\zeta/a$ lacks a sense of a contrast, or identical bodies")
    parts = np.split(
        wanted.to_numpy(),
        [1, 1 + positive.size],
        axis=1,
    )
    return _Senses(
        lengths.index.to_numpy(),
        positive,
        *parts,
    )


def _lengths(rows: pd.DataFrame, unit: str = "") -> list[Estimate]:
    """The lengths at the drop in the unit of a column, each with its realisations' range."""
    columns = rows[
        [
            "length_ratio",
            "length_ratio_low",
            "length_ratio_high",
        ]
    ]
    scaled = columns.mul(rows[unit], axis=0) if unit else columns
    return [between(*row) for row in scaled.to_numpy()]


def _note(rows: pd.DataFrame) -> str:
    return (
        f"At a declared perturbation {rows['kind'].iloc[0]} of {rows['strength'].max():g}, "
        f"{rows['realisations'].min():.0f} realisations each."
    )


# -- claims -------------------------------------------------------------------------------------


def _half_spaces(evidence: Tables) -> Result:
    rows = _identical(_faults(evidence))
    each = [
        rf"{_at_heights(own)} for $\zeta/a = {value:.3g}$"
        for value, own in rows.groupby("weakening")
    ]
    note = f"{_note(rows)} It is {', '.join(each)}."
    papers = rows[rows["role"] == "pairs_identical"]
    if len(papers):
        eta = np.pi / (1.0 - papers["poisson_ratio"])
        unstable, drop = (
            span(eta * papers[f"{name}_ratio"], ".1f") for name in ("stability", "length")
        )
        note += (
            rf" As $\eta$ of Eq. (3) the patch of the paper's friction turns unstable at "
            f"{unstable} and the force drops at {drop}, above the $2/\\pi$ to 4/3 that the "
            "paper has for the conventional approach."
        )
    return Result(_lengths(rows), note=note)


def _response(evidence: Tables, component: int) -> Result:
    """The measured G1 (component 0) or G2 (component 1) of half-spaces over Eq. (7)."""
    modes = evidence["modes"]
    high = modes.isel(run=np.char.startswith(modes["id"].values.astype(str), "half-spaces"))
    if not high.sizes["run"]:
        raise Missing("No modes between half-spaces were simulated")
    ratio = high["second_shear_modulus"] / high["shear_modulus"]
    columns = ratio, high["poisson_ratio"], high["second_poisson_ratio"]
    pairs = np.stack([column.values for column in columns], axis=1)
    expected = np.array([printed.bimaterial_transfer(*pair)[component] for pair in pairs])
    return Result(measured_response(high)[component] / expected[:, None], note=_SLIDING)


def _modulus(evidence: Tables) -> Result:
    rows, notes = _settled(evidence)
    senses = _both_senses(rows)
    mean = (senses.below + senses.above) / 2.0
    return _over_weakenings(
        senses,
        mean / senses.identical,
        _note(rows) + notes,
    )


def _contrast(evidence: Tables) -> Result:
    rows, notes = _settled(evidence)
    senses = _both_senses(rows)
    difference = senses.below - senses.above
    effect = difference / (senses.below + senses.above) / senses.contrast
    if senses.contrast.size < 2:
        raise Missing("There are no two contrasts")
    return _over_weakenings(
        senses,
        effect[:, 1:] / effect[:, :1],
        _note(rows) + notes,
    )


def _over_weakenings(
    senses: _Senses,
    ratios: Array,
    note: str,
) -> Result:
    """The ratios of all zeta/a; the note has that of each which is furthest from one."""
    worst = [max(row, key=lambda value: abs(value - 1.0)) for row in ratios]
    pairs = zip(worst, senses.weakening, strict=True)
    furthest = [rf"{value:.3g} for $\zeta/a = {weakening:g}$" for value, weakening in pairs]
    return Result(ratios, note=f"{note} The furthest: {', '.join(furthest)}.")


def _bimaterial(evidence: Tables) -> Result:
    rows, notes = _settled(evidence)
    longest = (rows["length"] / rows["height"]).max()
    note = f" The longest patch at the drop is {longest:.2g} of the height of its block."
    without = span(rows["length_ratio"][rows["contrast"] == 0.0], ".3f")
    if without:
        note += f" Without contrast the ratio is {without} already."
    return Result(_lengths(rows), note=_note(rows) + note + notes)


def _smaller(evidence: Tables) -> Result:
    rows, notes = _settled(evidence)
    strong = rows[rows["contrast"].abs() > _STRONG]
    senses = _both_senses(rows)
    are_strong = senses.contrast > _STRONG
    note = _note(rows) + _each_sense(senses.above[:, are_strong], senses.below[:, are_strong])
    return Result(_lengths(strong, "half_space_ratio"), note=note + notes)


def _each_sense(above: Array, below: Array) -> str:
    """Sentences with the largest value with the stiffer body above, and below."""
    return (
        f" With the stiffer body above it is at most {above.max():.3g}, below {below.max():.3g}. "
        f"{_CAUSE}"
    )


def _decreasing(evidence: Tables) -> Result:
    """Slopes of the length over L_c^M against ``|f beta|``, for each zeta/a and sense."""
    rows, notes = _settled(evidence)
    senses = _both_senses(rows)
    steps = np.diff(senses.contrast, prepend=0.0)
    above, below = (
        np.diff(lengths, prepend=senses.identical) / steps
        for lengths in (senses.above, senses.below)
    )
    note = _note(rows) + _each_sense(above, below) + notes
    return Result(np.stack([above, below]), note=note)


NUMBERS: dict[str, Computation] = {
    "pairs-half-spaces": _half_spaces,
    "pairs-g1": lambda evidence: _response(evidence, 0),
    "pairs-g2": lambda evidence: _response(evidence, 1),
    "pairs-modulus": _modulus,
    "pairs-contrast": _contrast,
    "pairs-bimaterial": _bimaterial,
    "pairs-smaller": _smaller,
    "pairs-decreasing": _decreasing,
}
"""The function of each claim, by its id."""
