"""Eqs. (6) to (9) and Figure 2 against simulations of two deformable bodies.

The paper has these as theory alone. Lengths come from the table of pairs
(:func:`replication.tables.pairs.gather_pairs`), at the declared strength in its columns. Eqs.
(7) and (8) are also compared with the elastic response that simulated modes between two sliding
layers have (:mod:`replication.tables.pair_modes`). The verdicts have their own table, so that
the paper's own claims need not wait for these simulations. A length is the mean of a fault's
realisations, with their range.
"""

import numpy as np
import xarray as xr

from nucleation.types import Array

from ...tables.pair_modes import DEEP, measured_response
from ..claim import Computation, Result
from ..expected import Estimate, Missing
from ..independent import printed
from ..pair_evidence import (
    Tables,
    both_senses,
    faults,
    half_spaces,
    over_effective_modulus,
    required,
    settled,
    weakenings,
)

_STRONG = 0.05  # f beta from which on two materials differ
_SLIDING = f"Homogeneous sliding of two layers {DEEP:g} wavelengths high, integrated in time."
_CAUSE = (
    "The push changes the normal stress under the patch, down or up; in homogeneous sliding it is "
    "uniform (results: Which side is stiff decides whether contrast shortens the patch)."
)


def pairs_half_spaces(evidence: Tables) -> Result:
    high = half_spaces(faults(evidence, "pairs_identical"))
    required(high, "No identical blocks are as high as half-spaces")
    note = _note(high) + _eta(high)
    return Result(_lengths(high), note=note)


def _lengths(rows: xr.Dataset, unit: Array | float = 1.0) -> list[Estimate]:
    """The lengths at the drop in some unit, each with its realisations' range."""
    values = rows["length_ratio"].values * unit
    lows = rows["length_ratio_low"].values * unit
    highs = rows["length_ratio_high"].values * unit
    lengths = zip(values, lows, highs, strict=True)
    return [Estimate.between(*length) for length in lengths]


def _note(rows: xr.Dataset) -> str:
    strength = float(rows["strength"].max())
    kind = str(rows["kind"].values[0])
    number = int(rows["realisations"].min())
    return f"At a declared perturbation {kind} of {strength:g}, {number} realisations each."


def _eta(rows: xr.Dataset) -> str:
    """A sentence with the lengths of instability and of the drop, as eta."""
    nu = rows["poisson_ratio"].values
    eta = np.pi / (1.0 - nu)
    unstable = eta * rows["stability_ratio"].values
    drop = eta * rows["length_ratio"].values
    return (
        rf" As $\eta$ of Eq. (3) the patch turns unstable at {unstable.min():.1f} and the force "
        rf"drops at {drop.min():.1f}, above the literature's $2/\pi$ to 4/3."
    )


def _response(evidence: Tables, component: int) -> Result:
    """The measured G1 (component 0) or G2 (component 1) of half-spaces over Eq. (7)."""
    modes = evidence["modes"]
    names = modes["id"].values.astype(str)
    are_high = np.char.startswith(names, "half-spaces")
    high = modes.isel(run=are_high)
    required(high, "No modes between half-spaces were simulated")
    ratio = high["second_shear_modulus"] / high["shear_modulus"]
    pairs = zip(
        ratio.values,
        high["poisson_ratio"].values,
        high["second_poisson_ratio"].values,
        strict=True,
    )
    expected = [printed.bimaterial_transfer(*pair)[component] for pair in pairs]
    measured = measured_response(high)[component]
    ours = (measured.T / expected).T
    return Result(ours, note=_SLIDING)


def pairs_modulus(evidence: Tables) -> Result:
    rows, left_out = settled(evidence)
    ratios = {}
    for senses in both_senses(rows):
        mean = (senses.below + senses.above) / 2.0
        ratios[senses.weakening] = mean / senses.identical
    return _over_weakenings(ratios, _note(rows) + left_out)


def pairs_contrast(evidence: Tables) -> Result:
    rows, left_out = settled(evidence)
    ratios = {}
    for senses in both_senses(rows):
        difference = senses.below - senses.above
        total = senses.below + senses.above
        effect = difference / total / senses.contrast
        if effect.size < 2:
            raise Missing(rf"$\zeta/a = {senses.weakening:g}$ has no two contrasts")
        ratios[senses.weakening] = effect[1:] / effect[0]
    return _over_weakenings(ratios, _note(rows) + left_out)


def _over_weakenings(ratios: dict[float, Array], note: str) -> Result:
    """The ratios of all zeta/a; the note has that of each which is furthest from one."""
    furthest = []
    for weakening, values in ratios.items():
        worst = max(values, key=lambda value: abs(value - 1.0))
        furthest.append(rf"{worst:.3g} for $\zeta/a = {weakening:g}$")
    ours = np.concatenate(list(ratios.values()))
    note += f" The furthest: {', '.join(furthest)}."
    return Result(ours, note=note)


def pairs_bimaterial(evidence: Tables) -> Result:
    rows, left_out = settled(evidence)
    relative = rows["length"] / rows["height"]
    longest = relative.values.max()
    note = f" The longest patch at the drop is {longest:.2g} of the height of its block."
    note = _note(rows) + note + left_out
    return Result(_lengths(rows), note=note)


def pairs_smaller(evidence: Tables) -> Result:
    rows, left_out = settled(evidence)
    contrast = np.abs(rows["f_beta"].values)
    strong = rows.isel(run=contrast > _STRONG)
    ours = _lengths(strong, unit=strong["half_space_ratio"].values)
    ratio = over_effective_modulus(strong)
    note = _note(rows) + _each_sense(strong, ratio) + left_out
    return Result(ours, note=note)


def _each_sense(rows: xr.Dataset, values: Array) -> str:
    """Sentences with the largest value with the stiffer body above, and below."""
    contrast = rows["f_beta"].values
    above = values[contrast < -_STRONG]
    below = values[contrast > _STRONG]
    if not above.size or not below.size:
        return ""
    return (
        f" With the stiffer body above it is at most {above.max():.3g}, below {below.max():.3g}. "
        f"{_CAUSE}"
    )


def pairs_decreasing(evidence: Tables) -> Result:
    rows, left_out = settled(evidence)
    slopes, ends = _slopes(rows)
    if not slopes:
        raise Missing("The study has no two contrasts of one sense")
    upper = rows.isel(run=ends)
    note = _note(rows) + _each_sense(upper, np.array(slopes)) + left_out
    return Result(slopes, note=note)


def _slopes(rows: xr.Dataset) -> tuple[list[float], list[int]]:
    """Slopes of the length over L_c^M against ``|f beta|``, for each zeta/a and sense.

    Second are the rows at the upper ends of the slopes.
    """
    lengths = over_effective_modulus(rows)
    weakening = weakenings(rows)
    f_beta = rows["f_beta"].values
    contrast = np.abs(f_beta)
    slopes: list[float] = []
    ends: list[int] = []
    for value in np.unique(weakening):
        for sign in (1.0, -1.0):
            same_sense = sign * f_beta >= -1e-9
            own = np.flatnonzero(same_sense & (weakening == value))
            own = own[np.argsort(contrast[own])]
            rise = np.diff(lengths[own])
            slope = rise / np.diff(contrast[own])
            slopes += slope.tolist()
            ends += own[1:].tolist()
    return slopes, ends


SHORT: dict[str, Computation] = {
    "pairs-g1": lambda evidence: _response(evidence, 0),
    "pairs-g2": lambda evidence: _response(evidence, 1),
}
