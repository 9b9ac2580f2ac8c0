"""All lengths of a fault: first the one at which the patch runs away, then what it rests on."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING

import numpy as np

from ..lengths.in_use import LENGTHS
from ..model.perturbations import KINDS
from ..model.settings import Perturbation
from ..model.units import in_metres
from ..theory.status import BETWEEN, STABLE
from ..theory.values import FaultLike, Values, labelled
from .answer import Answer, short
from .drop import USUAL_STRENGTH, run_away
from .literature import answers_of_literature
from .theory import critical_length, process_zone, stability_length

if TYPE_CHECKING:
    import xarray as xr

SYMBOLS = {
    "drop_length": "L",
    "stability_length": "L_s",
    "critical_length": "L_c",
    "runaway_length": "L_run",
    "process_zone": "L_pz",
}
"""Symbols of the theory's lengths by key, in the order of their listing."""

MEANINGS = {
    "drop_length": "the patch runs away, and the force drops (docs/drop.md)",
    "stability_length": "the patch turns unstable: its slip rate oscillates, more and more",
    "critical_length": "the shortest wavelength at which a fault that slides evenly is unstable",
    "runaway_length": "slow slip ends there, where friction weakens little",
    "process_zone": "the process zone behind the front, which a mesh has to resolve",
}

TITLES = {
    "drop_length": "length L at which the patch runs away",
    "stability_length": "stability length L_s",
    "critical_length": "critical length L_c",
    "runaway_length": "runaway length L_run",
    "process_zone": "process zone L_pz",
}
TITLES |= {length.key: length.title for length in LENGTHS}
"""Title of each length by key: those of the theory, and of the literature."""


class Lengths(dict[str, Answer]):
    """The lengths of a fault: :class:`Answer` by key, as a table where it is printed.

    Attributes
    ----------
    perturbation : Perturbation or None
        The perturbation of L; None where it was left out.
    literature : Lengths
        The lengths of the literature, each with its setting.

    Examples
    --------
    >>> from nucleation.api import PAPER
    >>> found = PAPER.lengths(strength=1e-5)
    >>> round(float(found["critical_length"].value), 3), found["drop_length"].status
    (0.238, 'value')
    >>> found.sentence.split(" (")[0]
    'The patch runs away at 0.16 m'
    """

    perturbation: Perturbation | None
    literature: Lengths

    def __init__(
        self,
        answers: dict[str, Answer],
        perturbation: Perturbation | None = None,
        literature: dict[str, Answer] | None = None,
    ) -> None:
        super().__init__(answers)
        self.perturbation = perturbation
        if literature is not None:
            self.literature = Lengths(literature)

    @property
    def sentence(self) -> str:
        """The answer to "how long must the patch grow before it runs away?", for a single fault."""
        stable = self["stability_length"]
        turns = f"It turns unstable at L_s = {in_metres(stable.value)}." if stable.exists else ""
        if self.perturbation is None:
            turns = turns.replace("It turns", "The patch turns") or f"No L_s: {stable.reason}."
            return f"{turns} Where it runs away depends on a perturbation, and none was given."
        drop = self["drop_length"]
        noise = f"{KINDS[self.perturbation.kind].noise} {short(self.perturbation.strength)}"
        if drop.exists:
            return f"The patch runs away at {with_range(drop)} {noise}."
        reason = drop.reason
        if drop.status == BETWEEN:
            ends = in_metres(drop.low, drop.high, joined=" and ")
            return f"The patch runs away between {ends}: {reason}."
        if drop.status == STABLE:
            return f"No patch runs away: {self['critical_length'].reason or reason}."
        return f"The length at which the patch runs away is not known: {reason}. {turns}".strip()

    @property
    def remarks(self) -> list[str]:
        """On what the answer of a single fault depends, and why it is uncertain; may be empty."""
        drop = self.get("drop_length")
        if drop is None or not drop.exists:
            return []
        found = [f"{drop.basis[0].upper()}{drop.basis[1:]}."] if drop.basis else []
        return [*found, f"DO NOT RELY ON IT: {drop.doubt}."] if drop.doubt else found

    def dataset(self) -> xr.Dataset:
        """The table as a Dataset over ``length`` and the dimensions of the fault.

        Returns
        -------
        Dataset
            ``value``, ``low``, ``high`` (m), ``status``, ``reason``, ``doubt`` and ``basis``.
            Arrays without named dimensions have the dimensions ``axis_0``, ``axis_1``, ...
        """
        import xarray as xr

        found = {}
        for field in Answer._fields:
            columns = {key: getattr(answer, field) for key, answer in self.items()}
            plain = {key: array for key, array in columns.items() if not labelled(array)}
            shape = np.broadcast_shapes(*map(np.shape, plain.values()))
            dims = [f"axis_{n}" for n in range(len(shape))]
            for key, array in plain.items():
                columns[key] = xr.DataArray(np.broadcast_to(array, shape), dims=dims)
            alike = xr.broadcast(*columns.values())
            index = xr.IndexVariable("length", list(self))
            parts = [x.drop_attrs() for x in alike]
            found[field] = xr.concat(parts, index).rename(field)
        for field in ("value", "low", "high"):
            found[field] = found[field].assign_attrs(units="m")
        titles = [TITLES[key] for key in self]
        return xr.Dataset(found).assign_coords(title=("length", titles))

    def __repr__(self) -> str:
        if any(np.size(answer.value) != 1 for answer in self.values()):
            return repr(self.dataset())
        rows = []
        for key, answer in self.items():
            shown = [TITLES[key], "", "", ""]
            if answer.exists:
                shown[1] = in_metres(answer.value)
                if answer.high > answer.low * 1.0001:
                    shown[2] = in_metres(answer.low, answer.high)
                shown[3] = str(answer.doubt)
            else:
                shown[3] = f"{answer.status}: {answer.reason}"
            rows.append(shown)
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)][:-1]
        lines = []
        for *cells, last in rows:
            padded = map(str.ljust, cells, widths)
            lines.append("  ".join([*padded, last]).rstrip())
        if "stability_length" in self:
            lines = [self.sentence, *self.remarks, "", *lines]
        return "\n".join(lines)


def with_range(answer: Answer) -> str:
    """A length with its range (m), in the digits that the range leaves.

    >>> with_range(Answer(4.1602, 4.0349, 4.5762, "value", ""))
    '4.2 m (4.0 to 4.6 m)'
    """
    value, low, high = (float(x) for x in answer[:3])
    if not high > low * (1.0 + 1e-4):
        return in_metres(value)
    form = f".{max(-math.floor(math.log10(0.5 * (high - low))), 0)}f"
    return f"{in_metres(value, form=form)} ({in_metres(low, high, form=form)})"


def lengths_of(
    fault: FaultLike, declared: Perturbation | None, weakening_rate: Values | None
) -> Lengths:
    """All lengths of each fault under a perturbation, whose strength is 0 if none was given.

    Without a perturbation L and L_run are left out. W (Pa/m) is of Uenishi and Rice's length.
    """
    found = {}
    usual = declared
    if declared is not None:
        given = declared if declared.strength > 0.0 else None
        usual = given or dataclasses.replace(declared, strength=USUAL_STRENGTH)
        found = dict(
            zip(("drop_length", "runaway_length"), run_away(fault, given, usual), strict=True)
        )
    found |= {
        "critical_length": critical_length(fault),
        "stability_length": stability_length(fault),
        "process_zone": process_zone(fault),
    }
    in_order = {key: found[key] for key in SYMBOLS if key in found}
    return Lengths(in_order, usual, answers_of_literature(fault, weakening_rate))
