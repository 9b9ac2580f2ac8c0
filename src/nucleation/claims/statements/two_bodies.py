"""Eqs. (6) to (9) and Figure 2 against simulations of two deformable bodies.

The paper has these as theory alone. Lengths are those of the table of pairs
(:func:`nucleation.patch.tables.pairs.gather_pairs`), at the declared strength that it states; Eqs.
(7) and (8) are also held against the elastic response that simulated modes between two sliding
layers meet (:mod:`nucleation.verification.pair_modes`). The verdicts are a table of their own: the
paper's own claims do not wait for these simulations. A length is the mean of a fault's
realisations, and its range theirs.
"""

from typing import NamedTuple

import numpy as np
import xarray as xr

from ...patch.tables.pairs import chosen, of_role, over_realisations
from ...types import Array
from ...verification.pair_modes import DEEP, measured_response
from ..claim import Computation, Result
from ..independent import printed
from ..said import Missing, Ours

HALF_SPACE = 1.0  # least height of a half-space over the theory's length
SLIDING = f"Homogeneous sliding of two layers {DEEP:g} wavelengths high, integrated in time."
STRONG = 0.05  # f beta from which on two materials differ
SETTLED = 0.10  # part by which a length may differ between blocks of two heights
CAUSE = (
    "The push changes the normal stress under the patch, down or up; in homogeneous sliding it is "
    "uniform (results: Which side is stiff decides whether contrast shortens the patch)."
)


class PairEvidence(NamedTuple):
    """What the claims on two bodies are judged by."""

    table: xr.Dataset  # of nucleation.patch.tables.pairs.gather_pairs
    modes: xr.Dataset  # of nucleation.verification.pair_modes.pair_modes


def required(rows: xr.Dataset, missing: str) -> xr.Dataset:
    """The same rows; raises Missing if there are none."""
    if not rows.sizes["run"]:
        raise Missing(missing)
    return rows


def rows_of(evidence: PairEvidence, role: str = "figure_2_simulated") -> xr.Dataset:
    """The faults with a role, each the mean of its realisations; raises Missing without any."""
    rows = of_role(evidence.table, role)
    missing = f"The table of pairs has no runs with the role {role}"
    return over_realisations(required(rows, missing))


def grows_with_height(evidence: PairEvidence) -> dict[float, list[tuple[float, float]]]:
    """The zeta/a whose length at the drop depends on the height of half-spaces.

    Of each, the heights (m) of identical blocks and their lengths over that of the theory.
    """
    rows = over_realisations(evidence.table)
    weakening = np.round(rows["zeta_over_a"].values, 3)
    high = (rows["height"] >= HALF_SPACE * rows["theory_length"]).values
    alike = high & (np.abs(rows["f_beta"].values) < 1e-9)
    found = {}
    for value in np.unique(weakening[alike]):
        own = chosen(rows, alike & (weakening == value))
        lengths = own["length_ratio"].values
        if np.ptp(lengths) > SETTLED * lengths.min():
            found[float(value)] = sorted(zip(own["height"].values, lengths, strict=True))
    return found


def decided(evidence: PairEvidence) -> tuple[xr.Dataset, str]:
    """The pairs of Figure 2 with lengths that do not depend on the height, and the others' names.

    Raises Missing without any.
    """
    rows, unsettled = rows_of(evidence), grows_with_height(evidence)
    weakening = np.round(rows["zeta_over_a"].values, 3)
    settled = chosen(rows, ~np.isin(weakening, list(unsettled)))
    left_out = ""
    for value in np.intersect1d(weakening, list(unsettled)):
        lengths = " and ".join(f"{ratio:.2f} at {h:g} m" for h, ratio in unsettled[float(value)])
        left_out += (
            rf" $\zeta/a = {value:g}$ is left out: between identical blocks the length over $L_c$ "
            f"depends on their height, {lengths}."
        )
    return required(settled, "All lengths depend on the height of the blocks"), left_out


def over_effective_modulus(rows: xr.Dataset) -> Array:
    """Lengths at the drop over L_c^M, the length with the modulus M and no contrast."""
    return (rows["length_ratio"] * rows["half_space_ratio"]).values


def senses(rows: xr.Dataset) -> list[tuple[float, Array, Array, float]]:
    """For each zeta/a: it, ``|f beta|`` of the pairs, their lengths over L_c^M with the stiffer
    body below and above, shape (contrast, 2), and that of identical half-spaces.

    Raises Missing where a contrast has been simulated in one sense alone.
    """
    ratio, weakening = over_effective_modulus(rows), np.round(rows["zeta_over_a"].values, 3)
    contrast, found = np.round(rows["f_beta"].values, 6), []
    for value in np.unique(weakening):
        own = dict(zip(contrast[weakening == value], ratio[weakening == value], strict=True))
        differ = sorted(x for x in own if x > 0.0)
        if not differ or 0.0 not in own or not all(-x in own for x in differ):
            raise Missing(
                rf"$\zeta/a = {value:g}$ lacks a sense of a contrast, or identical bodies"
            )
        both = np.array([[own[x], own[-x]] for x in differ])
        found.append((float(value), np.array(differ), both, float(own[0.0])))
    return found


def _note(rows: xr.Dataset) -> str:
    strength, kind = float(rows["strength"].max()), str(rows["kind"].values[0])
    number = int(rows["realisations"].min())
    return f"At a declared perturbation {kind} of {strength:g}, {number} realisations each."


def _eta(rows: xr.Dataset) -> str:
    """What the lengths at which the patch turns unstable and the force drops are as eta."""
    eta = np.pi / (1.0 - rows["poisson_ratio"].values)
    unstable, drop = (eta * rows[f"{name}_ratio"].values for name in ("stability", "length"))
    return (
        rf" As $\eta$ of Eq. (3) the patch turns unstable at {unstable.min():.1f} and the force "
        rf"drops at {drop.min():.1f}, above the literature's $2/\pi$ to 4/3."
    )


def _lengths(rows: xr.Dataset, unit: Array | float = 1.0) -> list[Ours]:
    """The mean lengths in some unit, each with its realisations' range."""
    ends = (rows[f"length_ratio{end}"].values * unit for end in ("", "_low", "_high"))
    return [Ours.between(*length) for length in zip(*ends, strict=True)]


def _each_sense(rows: xr.Dataset, values: Array) -> str:
    """The largest of some values with the stiffer body above, and below."""
    above, below = (values[sign * rows["f_beta"].values > STRONG] for sign in (-1.0, 1.0))
    if not above.size or not below.size:
        return ""
    return (
        f" With the stiffer body above it is at most {above.max():.3g}, below {below.max():.3g}. "
        f"{CAUSE}"
    )


def _over_weakenings(values: dict[float, Array], note: str) -> Result:
    """The values of all zeta/a, that furthest from one of each in the note."""
    own = {z: max(found, key=lambda value: abs(value - 1.0)) for z, found in values.items()}
    each = ", ".join(rf"{worst:.3g} for $\zeta/a = {z:g}$" for z, worst in own.items())
    ours = np.concatenate(list(values.values()))
    return Result(ours, note=f"{note} The furthest: {each}.")


def pairs_half_spaces(evidence: PairEvidence) -> Result:
    rows = rows_of(evidence, "pairs_identical")
    high = chosen(rows, (rows["height"] >= HALF_SPACE * rows["theory_length"]).values)
    required(high, "No identical blocks are as high as half-spaces")
    return Result(_lengths(high), note=_note(high) + _eta(high))


def response(evidence: PairEvidence, part: int) -> Result:
    """The measured G1 (part 0) or G2 (part 1) of half-spaces over Eq. (7)."""
    modes = evidence.modes
    high = modes.isel(run=[str(name).startswith("half-spaces") for name in modes["id"].values])
    required(high, "No modes between half-spaces were simulated")
    names = ("second_shear_modulus", "shear_modulus", "poisson_ratio", "second_poisson_ratio")
    second, first, nu, second_nu = (high[name].values for name in names)
    pairs = zip(second / first, nu, second_nu, strict=True)
    expected = np.array([printed.bimaterial_transfer(*pair)[part] for pair in pairs])
    return Result(measured_response(high)[part] / expected[:, None], note=SLIDING)


def pairs_modulus(evidence: PairEvidence) -> Result:
    rows, left_out = decided(evidence)
    scaled = {z: both.mean(axis=1) / identical for z, _, both, identical in senses(rows)}
    return _over_weakenings(scaled, _note(rows) + left_out)


def pairs_contrast(evidence: PairEvidence) -> Result:
    rows, left_out = decided(evidence)
    scaled = {}
    for z, contrast, both, _ in senses(rows):
        effect = (both[:, 0] - both[:, 1]) / both.sum(axis=1) / contrast
        if effect.size < 2:
            raise Missing(rf"$\zeta/a = {z:g}$ has no two contrasts")
        scaled[z] = effect[1:] / effect[0]
    return _over_weakenings(scaled, _note(rows) + left_out)


def pairs_bimaterial(evidence: PairEvidence) -> Result:
    rows, left_out = decided(evidence)
    longest = (rows["length"] / rows["height"]).values.max()
    note = f" The longest patch at the drop is {longest:.2g} of the height of its block."
    return Result(_lengths(rows), note=_note(rows) + note + left_out)


def pairs_smaller(evidence: PairEvidence) -> Result:
    rows, left_out = decided(evidence)
    strong = chosen(rows, np.abs(rows["f_beta"].values) > STRONG)
    ours = _lengths(strong, unit=strong["half_space_ratio"].values)
    senses_apart = _each_sense(strong, over_effective_modulus(strong))
    return Result(ours, note=_note(rows) + senses_apart + left_out)


def pairs_decreasing(evidence: PairEvidence) -> Result:
    rows, left_out = decided(evidence)
    slopes, at = [], []
    ratio = over_effective_modulus(rows)
    contrast, weakening = rows["f_beta"].values, np.round(rows["zeta_over_a"].values, 3)
    for value in np.unique(weakening):
        for sign in (1.0, -1.0):
            own = np.flatnonzero((weakening == value) & (sign * contrast >= -1e-9))
            own = own[np.argsort(np.abs(contrast[own]))]
            slopes += (np.diff(ratio[own]) / np.diff(np.abs(contrast[own]))).tolist()
            at += own[1:].tolist()
    if not slopes:
        raise Missing("The study has no two contrasts of one sense")
    senses_apart = _each_sense(rows.isel(run=at), np.array(slopes))
    return Result(slopes, note=_note(rows) + senses_apart + left_out)


OURS: dict[str, Computation] = {
    "pairs-g1": lambda e: response(e, 0),
    "pairs-g2": lambda e: response(e, 1),
}
"""The claims whose numbers take a line; each of the others has a function with its name."""
