"""Eqs. (6) to (9) and Figure 2 against simulations of two deformable bodies.

The paper has these as theory alone. Lengths come from the table of pairs, at the declared strength
in its columns; a length is the mean of a fault's realisations, with their range. Eqs. (7) and (8)
are also compared with the elastic response that simulated modes between two sliding layers have.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

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
    """Lengths over L_c^M for one zeta/a, with the stiffer body below and above each contrast."""

    weakening: float
    contrast: Array
    below: Array
    above: Array
    identical: float


# -- rows of the table --------------------------------------------------------------------------


def _where(rows: xr.Dataset, mask: NDArray[np.bool], missing: str) -> xr.Dataset:
    """The rows of a mask; raises Missing with a message if there are none."""
    if not mask.any():
        raise Missing(missing)
    return rows.isel(run=mask)


def _weakenings(rows: xr.Dataset) -> Array:
    """zeta/a of each row, rounded so that equal values can be compared."""
    return np.round(rows["zeta_over_a"].values, 3)


def _identical(evidence: Tables) -> xr.Dataset:
    """Faults between identical blocks as high as half-spaces, of all studies, by zeta/a."""
    rows = over_realisations(evidence["pairs"])
    high = rows["height"].values >= _LEAST_HEIGHT * rows["critical_length"].values
    equal = np.abs(rows["f_beta"].values) < 1e-9
    found = _where(rows, high & equal, "No identical blocks are as high as half-spaces")
    return found.isel(run=np.lexsort((found["height"].values, _weakenings(found))))


def _settled(evidence: Tables) -> tuple[xr.Dataset, str]:
    """The pairs of Figure 2, and sentences on whether lengths depend on the blocks' height.

    Each zeta/a with lengths that do, between identical blocks, is left out.
    """
    rows = over_realisations(evidence["pairs"])
    role = rows["role"].values == "figure_2_simulated"
    rows = _where(rows, role, "The table of pairs has no runs with the role figure_2_simulated")
    weakening = _weakenings(rows)
    identical = _identical(evidence)
    settled = np.ones(weakening.size, bool)
    untested = []
    notes = ""
    for value in np.unique(weakening):
        own = identical.isel(run=_weakenings(identical) == value)
        lengths = own["length_ratio"].values
        if lengths.size < 2:
            untested.append(f"{value:g}")
        elif np.ptp(lengths) > _HEIGHT_TOLERANCE * lengths.min():
            settled &= weakening != value
            notes += (
                rf" $\zeta/a = {value:g}$ is left out: between identical blocks the length over "
                f"$L_c$ depends on their height, {_at_heights(own)}."
            )
    if untested:
        notes += (
            rf" Whether it depends on the height for $\zeta/a$ = {' and '.join(untested)} was not "
            "tested: each has blocks of one height."
        )
    return _where(rows, settled, "All lengths depend on the height of the blocks"), notes


def _at_heights(rows: xr.Dataset) -> str:
    pairs = zip(rows["length_ratio"].values, rows["height"].values, strict=True)
    return " and ".join(f"{length:.2f} at {height:g} m" for length, height in pairs)


def _both_senses(rows: xr.Dataset) -> list[_Senses]:
    """The lengths in both senses of each contrast, for each zeta/a; Missing without one."""
    weakening = _weakenings(rows)
    lengths = _over_modulus(rows)
    contrasts = np.round(rows["f_beta"].values, 6)
    found = []
    for value in np.unique(weakening):
        at = weakening == value
        length = dict(zip(contrasts[at], lengths[at], strict=True))
        different = sorted(contrast for contrast in length if contrast > 0.0)
        if not different or 0.0 not in length or any(-one not in length for one in different):
            raise Missing(
                rf"$\zeta/a = {value:g}$ lacks a sense of a contrast, or identical bodies"
            )
        below, above = (np.array([length[s * one] for one in different]) for s in (1.0, -1.0))
        found.append(_Senses(value, np.array(different), below, above, length[0.0]))
    return found


def _over_modulus(rows: xr.Dataset) -> Array:
    """Lengths at the drop over L_c^M, the length with the modulus M and no contrast."""
    return (rows["length_ratio"] * rows["half_space_ratio"]).values


def _lengths(rows: xr.Dataset, unit: Array | float = 1.0) -> list[Estimate]:
    """The lengths at the drop in some unit, each with its realisations' range."""
    columns = ("length_ratio", "length_ratio_low", "length_ratio_high")
    return [between(*row) for row in zip(*(rows[c].values * unit for c in columns), strict=True)]


def _note(rows: xr.Dataset) -> str:
    strength = float(rows["strength"].max())
    kind = str(rows["kind"].values[0])
    number = int(rows["realisations"].min())
    return f"At a declared perturbation {kind} of {strength:g}, {number} realisations each."


# -- claims -------------------------------------------------------------------------------------


def _half_spaces(evidence: Tables) -> Result:
    rows = _identical(evidence)
    weakening = _weakenings(rows)
    each = [
        rf"{_at_heights(rows.isel(run=weakening == value))} for $\zeta/a = {value:.3g}$"
        for value in np.unique(weakening)
    ]
    note = f"{_note(rows)} It is {', '.join(each)}."
    papers = rows.isel(run=rows["role"].values == "pairs_identical")
    if papers.sizes["run"]:
        note += _eta(papers)
    return Result(_lengths(rows), note=note)


def _eta(rows: xr.Dataset) -> str:
    """A sentence with the lengths of instability and of the drop, as eta."""
    eta = np.pi / (1.0 - rows["poisson_ratio"].values)
    unstable, drop = (
        span(eta * rows[f"{name}_ratio"].values, ".1f") for name in ("stability", "length")
    )
    return (
        rf" As $\eta$ of Eq. (3) the patch of the paper's friction turns unstable at {unstable} "
        f"and the force drops at {drop}, above the $2/\\pi$ to 4/3 that the paper has for the "
        "conventional approach."
    )


def _response(evidence: Tables, component: int) -> Result:
    """The measured G1 (component 0) or G2 (component 1) of half-spaces over Eq. (7)."""
    modes = evidence["modes"]
    are_high = np.char.startswith(modes["id"].values.astype(str), "half-spaces")
    high = _where(modes, are_high, "No modes between half-spaces were simulated")
    ratio = (high["second_shear_modulus"] / high["shear_modulus"]).values
    poisson = high["poisson_ratio"].values, high["second_poisson_ratio"].values
    expected = [printed.bimaterial_transfer(*pair) for pair in zip(ratio, *poisson, strict=True)]
    measured = measured_response(high)[component]
    return Result((measured.T / np.array(expected)[:, component]).T, note=_SLIDING)


def _modulus(evidence: Tables) -> Result:
    rows, notes = _settled(evidence)
    ratios = {
        senses.weakening: (senses.below + senses.above) / 2.0 / senses.identical
        for senses in _both_senses(rows)
    }
    return _over_weakenings(ratios, _note(rows) + notes)


def _contrast(evidence: Tables) -> Result:
    rows, notes = _settled(evidence)
    ratios = {}
    for senses in _both_senses(rows):
        difference = senses.below - senses.above
        effect = difference / (senses.below + senses.above) / senses.contrast
        if effect.size < 2:
            raise Missing(rf"$\zeta/a = {senses.weakening:g}$ has no two contrasts")
        ratios[senses.weakening] = effect[1:] / effect[0]
    return _over_weakenings(ratios, _note(rows) + notes)


def _over_weakenings(ratios: dict[float, Array], note: str) -> Result:
    """The ratios of all zeta/a; the note has that of each which is furthest from one."""
    furthest = []
    for weakening, values in ratios.items():
        worst = max(values, key=lambda value: abs(value - 1.0))
        furthest.append(rf"{worst:.3g} for $\zeta/a = {weakening:g}$")
    note += f" The furthest: {', '.join(furthest)}."
    return Result(np.concatenate(list(ratios.values())), note=note)


def _bimaterial(evidence: Tables) -> Result:
    rows, notes = _settled(evidence)
    longest = float((rows["length"] / rows["height"]).max())
    note = f" The longest patch at the drop is {longest:.2g} of the height of its block."
    without = rows.isel(run=np.abs(rows["f_beta"].values) < 1e-9)["length_ratio"].values
    if without.size:
        note += f" Without contrast the ratio is {span(without, '.3f')} already."
    return Result(_lengths(rows), note=_note(rows) + note + notes)


def _smaller(evidence: Tables) -> Result:
    rows, notes = _settled(evidence)
    strong = rows.isel(run=np.abs(rows["f_beta"].values) > _STRONG)
    note = _note(rows) + _each_sense(strong, _over_modulus(strong)) + notes
    return Result(_lengths(strong, strong["half_space_ratio"].values), note=note)


def _each_sense(rows: xr.Dataset, values: Array) -> str:
    """Sentences with the largest value with the stiffer body above, and below."""
    contrast = rows["f_beta"].values
    above, below = values[contrast < -_STRONG], values[contrast > _STRONG]
    if not above.size or not below.size:
        return ""
    return (
        f" With the stiffer body above it is at most {above.max():.3g}, below {below.max():.3g}. "
        f"{_CAUSE}"
    )


def _decreasing(evidence: Tables) -> Result:
    """Slopes of the length over L_c^M against ``|f beta|``, for each zeta/a and sense."""
    rows, notes = _settled(evidence)
    lengths, weakening, f_beta = _over_modulus(rows), _weakenings(rows), rows["f_beta"].values
    slopes: list[float] = []
    ends: list[int] = []
    for value in np.unique(weakening):
        for sign in (1.0, -1.0):
            own = np.flatnonzero((sign * f_beta >= -1e-9) & (weakening == value))
            own = own[np.argsort(np.abs(f_beta[own]))]
            slopes += (np.diff(lengths[own]) / np.diff(np.abs(f_beta[own]))).tolist()
            ends += own[1:].tolist()
    if not slopes:
        raise Missing("The study has no two contrasts of one sense")
    note = _note(rows) + _each_sense(rows.isel(run=ends), np.array(slopes)) + notes
    return Result(slopes, note=note)


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
