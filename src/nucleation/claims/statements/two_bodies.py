"""Eqs. (6), (9) and Figure 2 against simulations of two deformable bodies.

The paper has these as theory alone. The verdicts stand on the table of pairs
(:func:`nucleation.patch.pairs.gather`), at the declared strength that it states, and are a table of
their own: the paper's own claims do not wait for these simulations.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

from ..claim import Claim, Result, claim
from ..said import Missing, Ours, below, words

CLAIMS: list[Claim] = []

HALF_SPACE = 1.0  # least height of a half-space over the theory's length
STRONG = 0.05  # f beta from which on two materials differ


def rows_of(table: xr.Dataset, study: str) -> xr.Dataset:
    """The rows of a study; raises Missing without any."""
    rows = table.isel(run=np.flatnonzero(table["study"].values == study))
    if not rows.sizes["run"]:
        raise Missing(f"The table of pairs has no runs of the study {study}")
    return rows


def half_spaces(table: xr.Dataset) -> xr.Dataset:
    """Identical blocks as high as half-spaces; raises Missing without any."""
    rows = rows_of(table, "pairs_identical")
    high = rows.isel(run=np.flatnonzero(rows["height"] >= HALF_SPACE * rows["theory_length"]))
    if not high.sizes["run"]:
        raise Missing("No identical blocks are as high as half-spaces")
    return high


def _note(table: xr.Dataset) -> str:
    strength, kind = float(table["strength"].max()), str(table["kind"].values[0])
    return f"At a declared perturbation {kind} of {strength:g}."


@claim(
    CLAIMS, id="pairs-half-spaces", where="Eq. (6)",
    statement="L_c = pi mu ell/((1 - nu) zeta sigma0) for identical half-spaces.",
    quotation=r"L_c",
    method="length at the drop of identical blocks higher than L_c, over Eq. (6); the paper's "
    "words for its simulations of finite height", said=words("reasonably good"),
)  # fmt: skip
def pairs_half_spaces(table: xr.Dataset) -> Result:
    return Result(Ours.worst(half_spaces(table)["length_ratio"].values, 1.0), note=_note(table))


@claim(
    CLAIMS, id="pairs-bimaterial", where="Eq. (9), Fig. 2",
    statement="Eq. (9) is L_c of two different half-spaces.", quotation=r"L_c",
    method="length at the drop over the theory of the same blocks, all contrasts and zeta/a in "
    "either sense; the one furthest from one", said=words("reasonably good"),
)  # fmt: skip
def pairs_bimaterial(table: xr.Dataset) -> Result:
    rows = rows_of(table, "figure_2_simulated")
    return Result(Ours.worst(rows["length_ratio"].values, 1.0), note=_note(table))


@claim(
    CLAIMS, id="pairs-smaller", where="Sect. 4 and Fig. 2",
    statement="L_c of bimaterial interfaces is smaller than L_c^M.",
    quotation=r"is generically {\em smaller} than the conventional estimate $L_c^{\cal M}$",
    method="largest length at the drop over L_c^M, of all pairs with f beta > 0.05 in either sense",
    said=below(1.0),
)  # fmt: skip
def pairs_smaller(table: xr.Dataset) -> Result:
    rows = rows_of(table, "figure_2_simulated")
    ratio = (rows["length_ratio"] * rows["half_space_ratio"]).values
    return Result(Ours.worst(ratio[np.abs(rows["f_beta"].values) > STRONG]), note=_note(table))


@claim(
    CLAIMS, id="pairs-decreasing", where="Sect. 4 and Fig. 2",
    statement="L_c decreases with increasing bimaterial contrast.",
    quotation=r"one expects $L_c$ to decrease with increasing bimaterial contrast",
    method="largest slope of the length at the drop over L_c^M against |f beta|, each zeta/a and "
    "sense", said=below(0.0),
)  # fmt: skip
def pairs_decreasing(table: xr.Dataset) -> Result:
    rows, slopes = rows_of(table, "figure_2_simulated"), []
    ratio = (rows["length_ratio"] * rows["half_space_ratio"]).values
    contrast, weakening = rows["f_beta"].values, np.round(rows["zeta_over_a"].values, 3)
    for value in np.unique(weakening):
        for sign in (1.0, -1.0):
            own = np.flatnonzero((weakening == value) & (sign * contrast >= -1e-9))
            own = own[np.argsort(np.abs(contrast[own]))]
            slopes += (np.diff(ratio[own]) / np.diff(np.abs(contrast[own]))).tolist()
    if not slopes:
        raise Missing("The study has no two contrasts of one sense")
    return Result(Ours.between(max(slopes), min(slopes), max(slopes)), note=_note(table))
