"""Eqs. (6) to (9) and Figure 2 against simulations of two deformable bodies.

The paper has these as theory alone. Lengths come from the table of pairs, at the declared strength
in its columns; a length is the mean of a fault's realisations, with their range. Eqs. (7) and (8)
are also compared with the elastic response that simulated modes between two sliding layers have.
"""

from collections.abc import Mapping

import numpy as np
import pandas as pd
import xarray as xr

from nucleation.types import Array

from ..tables.ratios import pairs_over_realisations
from . import printed
from .verdicts import Computation, Estimate, Missing, between

Tables = Mapping[str, xr.Dataset]
"""The table of ``pairs`` (:mod:`replication.tables.ratios`) and that of their ``modes``."""

_LEAST_HEIGHT = 1.0  # of a block that counts as a half-space, over the theory's length
_HEIGHT_TOLERANCE = 0.10  # up to which lengths do not depend on the height of the blocks
_STRONG = 0.05  # f beta from which on two materials differ


def _some(rows: pd.DataFrame, missing: str) -> pd.DataFrame:
    """The same rows; raises Missing with a message if there are none."""
    if rows.empty:
        raise Missing(missing)
    return rows


def _faults(evidence: Tables) -> tuple[pd.DataFrame, pd.DataFrame]:
    """The faults of all studies, and those between identical blocks as high as half-spaces.

    Each is the mean of its realisations. zeta/a and f beta are rounded so that equal values can be
    compared; lengths are also over L_c^M, the length with the modulus M and no contrast.
    """
    faults = pairs_over_realisations(evidence["pairs"]).to_dataframe()
    faults = faults.assign(
        weakening=faults["zeta_over_a"].round(3),
        contrast=faults["f_beta"].round(12),
        over_modulus=faults["length_ratio"] * faults["half_space_ratio"],
    )
    high = faults["height"] >= _LEAST_HEIGHT * faults["critical_length"]
    identical = faults[high & (faults["contrast"] == 0.0)].sort_values(["weakening", "height"])
    return faults, _some(identical, "No identical blocks are as high as half-spaces")


def _settled(evidence: Tables) -> pd.DataFrame:
    """The pairs of Figure 2, without each zeta/a whose lengths depend on the blocks' height."""
    faults, identical = _faults(evidence)
    rows = faults[faults["role"] == "pairs_contrast"]
    _some(rows, "The table of pairs has no runs with the role pairs_contrast")
    lengths = identical.groupby("weakening")["length_ratio"]
    varies = lengths.max() - lengths.min() > _HEIGHT_TOLERANCE * lengths.min()
    depend = varies.index[varies]
    rows = rows[~rows["weakening"].isin(depend)]
    return _some(rows, "All lengths depend on the height of the blocks")


def _both_senses(rows: pd.DataFrame) -> tuple[Array, Array, Array, Array]:
    """The contrasts, and lengths over L_c^M, (weakening, contrast).

    Lengths are of identical bodies, and with the stiffer body below, and above. Raises Missing
    without one of them.
    """
    lengths = rows.pivot(index="weakening", columns="contrast", values="over_modulus")
    positive = np.array([contrast for contrast in lengths.columns if contrast > 0.0])
    wanted = lengths.reindex(columns=[0.0, *positive, *-positive])
    if not positive.size or wanted.isna().any(axis=None):
        raise Missing(r"A $\zeta/a$ lacks a sense of a contrast, or identical bodies")
    identical, below, above = np.split(wanted.to_numpy(), [1, 1 + positive.size], axis=1)
    return positive, identical, below, above


def _lengths(rows: pd.DataFrame, unit: pd.Series | float = 1.0) -> list[Estimate]:
    """The lengths at the drop over the theory's, in a unit, each with its realisations' range."""
    ratios = (rows[f"length_ratio{end}"] * unit for end in ("", "_low", "_high"))
    return [between(*row) for row in zip(*ratios, strict=True)]


def _response(evidence: Tables, component: int) -> Array:
    """The measured G1 (component 0) or G2 (component 1) of half-spaces over Eq. (7)."""
    modes = evidence["modes"]
    high = modes.isel(run=np.char.startswith(modes["id"].values.astype(str), "half-spaces"))
    if not high.sizes["run"]:
        raise Missing("No modes between half-spaces were simulated")
    ratio = high["second_shear_modulus"] / high["shear_modulus"]
    columns = ratio, high["poisson_ratio"], high["second_poisson_ratio"]
    pairs = np.stack([column.values for column in columns], axis=1)
    expected = np.array([printed.bimaterial_transfer(*pair)[component] for pair in pairs])
    return measured_response(high)[component] / expected[:, None]


def measured_response(modes: xr.Dataset) -> tuple[Array, Array]:
    """G1 and G2 of the bodies by the measured rates of simulated modes, (run, branch)."""
    rates = modes["measured_growth"] + 1j * modes["measured_frequency"]
    a, zeta, ell, v = (modes[name] for name in ("a", "zeta", "slip_distance", "velocity"))
    weakening = rates * (a * rates * ell - zeta * v) / (v * (v + rates * ell))
    load = modes["shear_modulus"] * modes["mode_wavenumber"]
    response = -modes["normal_stress"] * weakening / load
    response = response.transpose("run", "branch")
    return response.real.values, (-response.imag / modes["friction"]).values


def _modulus(evidence: Tables) -> Array:
    """The mean length of both senses over that of identical bodies."""
    _, identical, below, above = _both_senses(_settled(evidence))
    return (below + above) / 2.0 / identical


def _contrast(evidence: Tables) -> Array:
    """The effect of each sense per contrast, over that of the smallest contrast."""
    contrast, _, below, above = _both_senses(_settled(evidence))
    if contrast.size < 2:
        raise Missing("There are no two contrasts")
    effect = (below - above) / (below + above) / contrast
    return effect[:, 1:] / effect[:, :1]


def _smaller(evidence: Tables) -> list[Estimate]:
    """Lengths over L_c^M of all pairs with a strong contrast."""
    rows = _settled(evidence)
    strong = rows[rows["contrast"].abs() > _STRONG]
    return _lengths(_some(strong, "No contrast is strong"), strong["half_space_ratio"])


def _decreasing(evidence: Tables) -> Array:
    """Slopes of the length over L_c^M against ``|f beta|``, for each zeta/a and sense."""
    contrast, identical, *senses = _both_senses(_settled(evidence))
    steps = np.diff(contrast, prepend=0.0)
    return np.stack([np.diff(lengths, prepend=identical) / steps for lengths in senses])


NUMBERS: dict[str, Computation] = {
    "pairs-half-spaces": lambda evidence: _lengths(_faults(evidence)[1]),
    "pairs-g1": lambda evidence: _response(evidence, 0),
    "pairs-g2": lambda evidence: _response(evidence, 1),
    "pairs-modulus": _modulus,
    "pairs-contrast": _contrast,
    "pairs-bimaterial": lambda evidence: _lengths(_settled(evidence)),
    "pairs-smaller": _smaller,
    "pairs-decreasing": _decreasing,
}
"""The function of each claim, by its id."""
