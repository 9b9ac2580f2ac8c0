"""Eqs. (6) to (9) and Figure 2 against simulations of two deformable bodies.

The paper has these as theory alone. Lengths are those of the table of pairs
(:func:`nucleation.patch.pairs.gather`), at the declared strength that it states; Eqs. (7) and (8)
are also held against the elastic response that simulated modes between two sliding layers meet
(:mod:`nucleation.verification.pair_modes`). The verdicts are a table of their own: the paper's own
claims do not wait for these simulations. A length is the mean of a fault's realisations, and its
range theirs.
"""

from typing import NamedTuple

import numpy as np
import xarray as xr

from ...patch.pairs import chosen, of_role, over_realisations
from ...types import Array
from ...verification.pair_modes import DEEP, measured_response
from ..claim import Computation, Result
from ..independent import printed
from ..said import Missing, Ours

HALF_SPACE = 1.0  # least height of a half-space over the theory's length
SLIDING = f"Homogeneous sliding of two layers {DEEP:g} wavelengths high, integrated in time."
STRONG = 0.05  # f beta from which on two materials differ
CAUSE = (
    "Whether it is below or above decides by the normal stress that the push builds under the "
    "patch, which the theory of homogeneous sliding does not have (findings: Which side is stiff "
    "decides whether contrast shortens the patch)."
)


class PairEvidence(NamedTuple):
    """What the claims on two bodies are judged by."""

    table: xr.Dataset  # of nucleation.patch.pairs.gather
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


def _over_weakenings(values: dict[float, Array], rows: xr.Dataset) -> Result:
    """The values of all zeta/a, that furthest from one of each in the note."""
    own = {z: max(found, key=lambda value: abs(value - 1.0)) for z, found in values.items()}
    each = ", ".join(rf"{worst:.3g} for $\zeta/a = {z:g}$" for z, worst in own.items())
    ours = np.concatenate(list(values.values()))
    return Result(ours, note=f"{_note(rows)} The furthest: {each}.")


def pairs_half_spaces(evidence: PairEvidence) -> Result:
    rows = rows_of(evidence, "pairs_identical")
    high = chosen(rows, (rows["height"] >= HALF_SPACE * rows["theory_length"]).values)
    required(high, "No identical blocks are as high as half-spaces")
    return Result(_lengths(high), note=_note(high))


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
    rows = rows_of(evidence)
    scaled = {z: both.mean(axis=1) / identical for z, _, both, identical in senses(rows)}
    return _over_weakenings(scaled, rows)


def pairs_contrast(evidence: PairEvidence) -> Result:
    rows = rows_of(evidence)
    scaled = {}
    for z, contrast, both, _ in senses(rows):
        effect = (both[:, 0] - both[:, 1]) / both.sum(axis=1) / contrast
        if effect.size < 2:
            raise Missing(rf"$\zeta/a = {z:g}$ has no two contrasts")
        scaled[z] = effect[1:] / effect[0]
    return _over_weakenings(scaled, rows)


def pairs_bimaterial(evidence: PairEvidence) -> Result:
    rows = rows_of(evidence)
    over = rows["length"].values / rows["height"].values
    note = (
        f" {int((rows['height'] < rows['theory_length']).sum())} of {over.size} blocks are lower "
        f"than $L_c$; {int((over > 1.0).sum())} patches are at the drop longer than their block is "
        f"high, at most by a factor of {over.max():.2g}."
    )
    return Result(_lengths(rows), note=_note(rows) + note)


def pairs_smaller(evidence: PairEvidence) -> Result:
    rows = rows_of(evidence)
    strong = chosen(rows, np.abs(rows["f_beta"].values) > STRONG)
    ours = _lengths(strong, unit=strong["half_space_ratio"].values)
    return Result(ours, note=_note(rows) + _each_sense(strong, over_effective_modulus(strong)))


def pairs_decreasing(evidence: PairEvidence) -> Result:
    rows, slopes, at = rows_of(evidence), [], []
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
    return Result(slopes, note=_note(rows) + _each_sense(rows.isel(run=at), np.array(slopes)))


OURS: dict[str, Computation] = {
    "pairs-g1": lambda e: response(e, 0),
    "pairs-g2": lambda e: response(e, 1),
}
"""The claims whose numbers take a line; each of the others has a function with its name."""
