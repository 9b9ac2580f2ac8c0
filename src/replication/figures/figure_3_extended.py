"""Figure 3 with more lengths: where the patch becomes unstable, and the drop under load noise."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from nucleation.pictures import style

from ..tables.lengths import join, over_realisations
from . import laws

_ABOVE = 1.12  # the axes end at this multiple of the highest block
_BAND = r"drop, load steady to $10^{-5}$ to $10^{-2}$"
_JUDGED = "converged"


class _Series(NamedTuple):
    """One set of lengths: column and role, name in the legend, and what differs from the law's."""

    column: str
    role: str
    label: str
    own: style.Options

    def look(self, kind: laws.Look) -> style.Options:
        """Marker, size and colours of one kind of simulation."""
        return {"marker": kind.marker, "color": kind.colour, **self.own}


_PAPERS = _Series("length", "paper", "drop, quiet, on the paper's mesh", {"ms": 3.0})
_STEADY = _Series("length", _JUDGED, r"drop, load steady to $10^{-5}$", {"ms": 4.8, **style.OPEN})
_STABILITY = _Series(
    "stability_length",
    _JUDGED,
    "patch turns unstable, $L_s$",
    {"ms": 4.8, "color": style.STABILITY},
)


@style.styled
def draw(
    theory: xr.Dataset,
    lengths: xr.Dataset,
    table: xr.Dataset,
    noisy: xr.Dataset | Sequence[xr.Dataset] = (),
) -> Figure:
    """Draw lengths against height, and the same over the theory's.

    `table` has L_s of the same runs. `noisy` has lengths under a stronger perturbation, from which
    a band is drawn to the role `converged`, and further realisations of that role's faults.
    """
    stronger = laws.where(lengths, False)
    if isinstance(noisy, xr.Dataset):
        stronger, lengths = _with_more(lengths, noisy)
    drawn = (theory, _means(lengths), table, _means(stronger))
    figure, (left, right) = style.panels(1, 2, 8.2)
    _draw_panel(left, *drawn)
    _draw_panel(right, *(_over_theory(own) for own in drawn))
    _finish_lengths(left, theory, drawn[1], bool(stronger.sizes["run"]))
    heights = drawn[1]["height"]
    right.set(
        xscale="log",
        xlim=(0.8 * heights.min(), 1.3 * heights.max()),
        ylim=(0.4, 1.2),
    )
    right.set_ylabel("Length over theory $L/L_c$")
    handles = []
    for kind, runs in laws.kinds(lengths):
        if runs.sizes["run"]:
            handles.append(style.key(kind.name, kind.marker, markersize=4.8))
    right.legend(handles=handles, loc="upper left", labelspacing=0.3)
    style.letters(left, right, minor=True)
    return figure


def _means(table: xr.Dataset) -> xr.Dataset:
    """The mean of each fault's realisations, and their range with one definition of length."""
    length = table["length"]
    return over_realisations(table.assign(length_low=length, length_high=length))


def _over_theory(table: xr.Dataset) -> xr.Dataset:
    """A table with its lengths over the theory's."""
    names = [name for name in table.data_vars if "length" in str(name)]
    return table.assign({name: table[name] / table["critical_length"] for name in names})


def _with_more(lengths: xr.Dataset, noisy: xr.Dataset) -> tuple[xr.Dataset, xr.Dataset]:
    """The runs with the stronger perturbation, and the lengths with the further realisations."""
    judged = laws.where(lengths, role=_JUDGED)
    more = np.isin(noisy["strength"].values, judged["strength"].values)
    own = laws.where(noisy, more)
    for name in ("study", "role"):
        own[name] = ("run", np.resize(judged[name].values, own.sizes["run"]))
    return laws.where(noisy, ~more), join([lengths, own])


def _draw_panel(
    axes: Axes, theory: xr.Dataset, lengths: xr.Dataset, table: xr.Dataset, stronger: xr.Dataset
) -> None:
    """Theory, half of it, the band under stronger perturbations, and all sets of lengths."""
    for part, dashes in ((1.0, "-"), (0.5, "--")):
        length = part * theory["critical_length"]
        axes.plot(
            theory["height"],
            length,
            dashes,
            color=style.THEORY,
            linewidth=1.2,
        )
    if stronger.sizes["run"]:
        quiet = laws.where(lengths, role=_JUDGED)
        quiet = laws.where(quiet, laws.usual(quiet))
        both = (stronger["height"], quiet["height"])
        heights, first, second = np.intersect1d(*both, return_indices=True)
        ends = (stronger["length"][first], quiet["length"][second])
        axes.fill_between(
            heights,
            *ends,
            color=style.AGING,
            alpha=0.2,
            linewidth=0.0,
        )
    _draw_series(axes, lengths, _PAPERS)
    _draw_series(axes, lengths, _STEADY)
    stability = _STABILITY
    if _JUDGED not in table["role"].values:  # then L_s is that of the paper's runs
        stability = _STABILITY._replace(role="paper")
    _draw_series(axes, table, stability)
    axes.set_xlabel("Height $H$ (m)")


def _draw_series(axes: Axes, table: xr.Dataset, series: _Series) -> None:
    """One set of lengths, a marker for each law and initial state."""
    known = laws.where(
        table,
        np.isfinite(table[series.column]),
        role=series.role,
    )
    for kind, runs in laws.kinds(known):
        if runs.sizes["run"]:
            label = f"{series.label}, {kind.name}"
            look = {"elinewidth": 0.8, "label": label, **series.look(kind)}
            laws.draw(axes, "height", runs, series.column, **look)


def _finish_lengths(
    axes: Axes,
    theory: xr.Dataset,
    lengths: xr.Dataset,
    band: bool,
) -> None:
    """Limits, and the legend of all sets."""
    highest = _ABOVE * float(lengths["height"].max())
    top = np.interp(highest, theory["height"], theory["critical_length"])
    axes.set(
        xlim=(0.0, highest),
        ylim=(0.0, 1.6 * float(top)),
        ylabel="Length $L$ (m)",
    )
    shown = laws.usual_law(lengths)
    usual = laws.looks([shown])[shown, False]
    handles = [
        style.key("theory $L_c$", "", "-", style.THEORY, linewidth=1.2),
        style.key("theory $L_c/2$", "", "--", style.THEORY, linewidth=1.2),
    ]
    for series in (_STEADY, _PAPERS, _STABILITY):
        look = series.look(usual)
        handles.append(
            style.key(
                series.label,
                colour=look.pop("color"),
                **look,
            )
        )
    bands = (
        [
            Patch(
                color=style.AGING,
                alpha=0.2,
                label=_BAND,
            )
        ]
        if band
        else []
    )
    axes.legend(
        handles=[*handles, *bands],
        loc="upper left",
        labelspacing=0.3,
    )
