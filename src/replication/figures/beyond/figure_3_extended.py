"""Figure 3 with more lengths: where the patch becomes unstable, and the drop under load noise."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from nucleation.pictures import style

from ...tables.lengths import join, over_realisations
from .. import laws

_OLDER = ", older interface"
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


_PAPERS = _Series(
    "length",
    "paper",
    "drop, quiet, on the paper's mesh",
    {"ms": 3.0},
)
_STEADY = _Series(
    "length",
    _JUDGED,
    r"drop, load steady to $10^{-5}$",
    {"ms": 4.8, **style.OPEN},
)
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

    Parameters
    ----------
    theory : Dataset
        With ``critical_length(height)`` (m).
    lengths : Dataset
        On ``run``: ``role``, ``evolution``, ``height`` (m), ``initial_state`` (s),
        ``critical_length`` and ``length`` with ``_low`` and ``_high`` (m).
    table : Dataset
        The same with ``stability_length`` instead of ``length``.
    noisy : Dataset, or an empty sequence
        Lengths of the aging law's faults under a stronger perturbation. A band is drawn from these
        to the lengths with the role `converged`. Runs with the perturbation of that role are
        further realisations of its faults.

    Returns
    -------
    Figure
        Two panels.
    """
    stronger = laws.where(lengths, False)
    if isinstance(noisy, xr.Dataset):
        stronger, lengths = _with_more(lengths, noisy)
    drawn = (theory, _means(lengths), table, _means(stronger))
    figure, panels = style.panels(1, 2, 8.2)
    _draw_panel(panels[0], *drawn)
    _draw_panel(panels[1], *(_over_theory(own) for own in drawn))
    _finish_lengths(panels[0], theory, drawn[1], bool(stronger.sizes["run"]))
    _finish_ratios(panels[1], lengths)
    style.letters(*panels, minor=True)
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
    axes: Axes,
    theory: xr.Dataset,
    lengths: xr.Dataset,
    table: xr.Dataset,
    stronger: xr.Dataset,
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
        _draw_band(axes, stronger, laws.where(lengths, role=_JUDGED))
    _draw_series(axes, lengths, _PAPERS)
    _draw_series(axes, lengths, _STEADY)
    stability = _STABILITY
    if _JUDGED not in table["role"].values:  # then L_s is that of the paper's runs
        stability = _STABILITY._replace(role="paper")
    _draw_series(axes, table, stability)
    axes.set_xlabel("Height $H$ (m)")


def _draw_band(
    axes: Axes,
    stronger: xr.Dataset,
    judged: xr.Dataset,
) -> None:
    """From the drop under the stronger perturbation to that of the role `converged`."""
    quiet = laws.where(judged, laws.usual(judged))
    both = (stronger["height"], quiet["height"])
    heights, first, second = np.intersect1d(*both, return_indices=True)
    low = stronger["length"][first]
    high = quiet["length"][second]
    axes.fill_between(
        heights,
        low,
        high,
        color=style.AGING,
        alpha=0.2,
        linewidth=0.0,
    )


def _draw_series(
    axes: Axes,
    table: xr.Dataset,
    series: _Series,
) -> None:
    """One set of lengths, a marker for each law and initial state."""
    known = np.isfinite(table[series.column].values)
    for (_, old), kind, runs in laws.kinds(
        laws.where(
            table,
            known,
            role=series.role,
        )
    ):
        if runs.sizes["run"]:
            look = series.look(kind)
            label = f"{series.label}, {_state(kind, old)}"
            laws.draw(axes, "height", runs, series.column, elinewidth=0.8, label=label, **look)


def _state(kind: laws.Look, old: bool) -> str:
    return kind.label + _OLDER if old else kind.label


def _finish_lengths(
    axes: Axes,
    theory: xr.Dataset,
    lengths: xr.Dataset,
    band: bool,
) -> None:
    highest = _ABOVE * float(lengths["height"].max())
    top = np.interp(highest, theory["height"], theory["critical_length"])
    axes.set(
        xlim=(0.0, highest),
        ylim=(0.0, 1.6 * float(top)),
        ylabel="Length $L$ (m)",
    )
    shown = laws.usual_law(lengths)
    usual = laws.looks([shown])[shown, False]
    handles: list[Artist] = [
        style.key("theory $L_c$", "", "-", style.THEORY, linewidth=1.2),
        style.key("theory $L_c/2$", "", "--", style.THEORY, linewidth=1.2),
    ]
    for series in (_STEADY, _PAPERS, _STABILITY):
        look = series.look(usual)
        handles.append(style.key(series.label, colour=look.pop("color"), **look))
    if band:
        handles.append(Patch(color=style.AGING, alpha=0.2, label=_BAND))
    axes.legend(handles=handles, loc="upper left", labelspacing=0.3)


def _finish_ratios(axes: Axes, lengths: xr.Dataset) -> None:
    axes.set(xscale="log", xlim=(0.004, 0.13), ylim=(0.4, 1.2))
    axes.set_ylabel("Length over theory $L/L_c$")
    handles = []
    for (_, old), kind, runs in laws.kinds(lengths):
        if runs.sizes["run"]:
            handles.append(
                style.key(
                    _state(kind, old),
                    kind.marker,
                    markersize=4.8,
                )
            )
    axes.legend(handles=handles, loc="upper left", labelspacing=0.3)
