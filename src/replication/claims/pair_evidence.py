"""The evidence of the claims on two bodies: the table of pairs and modes, and rows of the table.

A row of the table of pairs is a run; the functions here return one row for each fault, the mean of
its realisations.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from nucleation.types import Array

from ..tables.pairs import over_realisations
from .expected import Missing

_LEAST_HEIGHT = 1.0
"""Least height of a block that counts as a half-space, over the theory's length."""

_HEIGHT_TOLERANCE = 0.10
"""Relative difference up to which lengths do not depend on the height of the blocks."""


Tables = Mapping[str, xr.Dataset]
"""The tables that the claims on two bodies are judged by: ``pairs``, of
:func:`replication.tables.pairs.gather_pairs`, and ``modes``, of
:func:`replication.tables.pair_modes.pair_modes`."""


class _Senses(NamedTuple):
    """Lengths at the drop over L_c^M for one zeta/a, in both senses of each contrast.

    Attributes
    ----------
    weakening : float
        zeta/a.
    contrast : array, shape (contrasts,)
        ``|f beta|``.
    below, above : array, shape (contrasts,)
        Lengths with the stiffer body below and above.
    identical : float
        Length of identical half-spaces.
    """

    weakening: float
    contrast: Array
    below: Array
    above: Array
    identical: float


def required(
    rows: xr.Dataset,
    missing: str,
) -> xr.Dataset:
    """The same rows, unless there are none.

    Parameters
    ----------
    rows : Dataset
        Rows on the dimension ``run``.
    missing : str
        Message if there are none.

    Raises
    ------
    Missing
        If there are none.
    """
    if not rows.sizes["run"]:
        raise Missing(missing)
    return rows


def faults(
    evidence: Tables,
    role: str,
) -> xr.Dataset:
    """The faults with a role.

    Parameters
    ----------
    evidence : mapping
        The tables.
    role : str
        Role of a study.

    Raises
    ------
    Missing
        If there are none.
    """
    pairs = evidence["pairs"]
    rows = pairs.isel(run=pairs["role"].values == role)
    required(rows, f"The table of pairs has no runs with the role {role}")
    return over_realisations(rows)


def half_spaces(rows: xr.Dataset) -> xr.Dataset:
    """The rows with blocks as high as half-spaces."""
    return rows.isel(run=_are_high(rows))


def _are_high(rows: xr.Dataset) -> np.ndarray:
    least = _LEAST_HEIGHT * rows["critical_length"]
    return (rows["height"] >= least).values


def weakenings(rows: xr.Dataset) -> Array:
    """zeta/a of each row, rounded so that equal values can be compared."""
    return np.round(rows["zeta_over_a"].values, 3)


def over_effective_modulus(rows: xr.Dataset) -> Array:
    """Lengths at the drop over L_c^M, the length with the modulus M and no contrast."""
    return (rows["length_ratio"] * rows["half_space_ratio"]).values


def settled(evidence: Tables) -> tuple[xr.Dataset, str]:
    """The pairs of Figure 2, without each zeta/a with lengths that depend on the blocks' height.

    Returns
    -------
    rows : Dataset
        One for each fault.
    left_out : str
        Sentences on the zeta/a that are left out.

    Raises
    ------
    Missing
        If there are no such pairs.
    """
    rows = faults(evidence, "figure_2_simulated")
    unsettled = _depending_on_height(evidence)
    weakening = weakenings(rows)
    left_out = ""
    for value in np.intersect1d(weakening, list(unsettled)):
        identical = unsettled[float(value)]
        heights = identical["height"].values
        lengths = identical["length_ratio"].values
        by_height = sorted(zip(heights, lengths, strict=True))
        each = " and ".join(f"{length:.2f} at {height:g} m" for height, length in by_height)
        left_out += (
            rf" $\zeta/a = {value:g}$ is left out: between identical blocks the length over $L_c$ "
            f"depends on their height, {each}."
        )
    rows = rows.isel(run=~np.isin(weakening, list(unsettled)))
    return required(rows, "All lengths depend on the height of the blocks"), left_out


def _depending_on_height(evidence: Tables) -> dict[float, xr.Dataset]:
    """Rows of identical half-spaces with lengths that depend on the blocks' height, by zeta/a."""
    rows = over_realisations(evidence["pairs"])
    identical = np.abs(rows["f_beta"].values) < 1e-9
    rows = rows.isel(run=identical & _are_high(rows))
    weakening = weakenings(rows)
    found = {}
    for value in np.unique(weakening):
        own = rows.isel(run=weakening == value)
        lengths = own["length_ratio"].values
        if np.ptp(lengths) > _HEIGHT_TOLERANCE * lengths.min():
            found[float(value)] = own
    return found


def both_senses(rows: xr.Dataset) -> list[_Senses]:
    """The lengths in both senses of each contrast, for each zeta/a.

    Raises
    ------
    Missing
        If a contrast was simulated in one sense alone, or there are no identical bodies.
    """
    weakening = weakenings(rows)
    lengths = over_effective_modulus(rows)
    contrasts = np.round(rows["f_beta"].values, 6)
    found = []
    for value in np.unique(weakening):
        at = weakening == value
        length = dict(zip(contrasts[at], lengths[at], strict=True))
        different = sorted(contrast for contrast in length if contrast > 0.0)
        complete = all(-contrast in length for contrast in different)
        if not different or not complete or 0.0 not in length:
            raise Missing(
                rf"$\zeta/a = {value:g}$ lacks a sense of a contrast, or identical bodies"
            )
        senses = _Senses(
            weakening=float(value),
            contrast=np.array(different),
            below=np.array([length[contrast] for contrast in different]),
            above=np.array([length[-contrast] for contrast in different]),
            identical=float(length[0.0]),
        )
        found.append(senses)
    return found
