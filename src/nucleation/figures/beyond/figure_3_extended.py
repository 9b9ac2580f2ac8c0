"""Figure 3 with more lengths: where the patch becomes unstable, and the drop under load noise."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ...analysis.lengths import join, over_realisations
from ...figures import laws, style

_OLDER = ", older interface"
_ABOVE = 1.12  # the axes end at this multiple of the highest block
_BAND = r"drop, load steady to $10^{-5}$ to $10^{-2}$"
_JUDGED = "converged"


class _Series(NamedTuple):
    """One set of lengths: column and role, marks, and its name in the legend."""

    column: str
    role: str
    colour: str | None  # None: the colour of the law
    filled: bool
    size: float  # points
    label: str

    def look(self, kind: laws.Look) -> style.Options:
        """Marker, size and colours of one kind of simulation."""
        colour = self.colour or kind.colour
        face = colour if self.filled else "white"
        return {
            "marker": kind.marker,
            "ms": self.size,
            "color": colour,
            "mfc": face,
        }


_PAPERS = _Series(
    column="length",
    role="paper",
    colour=None,
    filled=True,
    size=3.0,
    label="drop, quiet, on the paper's mesh",
)
_STEADY = _Series(
    column="length",
    role=_JUDGED,
    colour=None,
    filled=False,
    size=4.8,
    label=r"drop, load steady to $10^{-5}$",
)
_STABILITY = _Series(
    column="stability_length",
    role=_JUDGED,
    colour=style.GREEN,
    filled=True,
    size=4.8,
    label="patch turns unstable, $L_s$",
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
    noisy_lengths = None
    if isinstance(noisy, xr.Dataset):
        noisy, lengths = _with_more(lengths, noisy)
        noisy_lengths = _means(noisy)
    lengths = _means(lengths)
    figure, panels = style.panels(1, 2, 8.2)
    stability = _STABILITY
    if _JUDGED not in table["role"].values:  # then L_s is that of the paper's runs
        stability = _STABILITY._replace(role="paper")
    for axes, relative in zip(panels, (False, True), strict=True):
        _draw_theory(axes, theory, relative)
        if noisy_lengths is not None:
            _draw_band(axes, noisy_lengths, lengths, relative)
        for series in (_PAPERS, _STEADY):
            _draw_series(axes, lengths, series, relative)
        _draw_series(axes, table, stability, relative)
        axes.set_xlabel("Height $H$ (m)")
    _finish_lengths(panels[0], theory, lengths, noisy_lengths is not None)
    _finish_ratios(panels[1], lengths)
    style.letters(*panels, minor=True)
    return figure


def _draw_theory(axes: Axes, theory: xr.Dataset, relative: bool) -> None:
    """L_c, solid, and half of it, dashed."""
    length = theory["critical_length"].values
    for part, dashes in ((1.0, "-"), (0.5, "--")):
        values = np.full(length.shape, part) if relative else part * length
        axes.plot(
            theory["height"],
            values,
            dashes,
            color=style.THEORY,
            linewidth=1.2,
        )


def _means(table: xr.Dataset) -> xr.Dataset:
    """The mean of each fault's realisations, and their range with one definition of length."""
    length = table["length"]
    return over_realisations(table.assign(length_low=length, length_high=length))


def _with_more(lengths: xr.Dataset, noisy: xr.Dataset) -> tuple[xr.Dataset, xr.Dataset]:
    """The runs with the stronger perturbation, and the lengths with the further realisations."""
    judged = laws.where(lengths, role=_JUDGED)
    more = np.isin(noisy["strength"].values, judged["strength"].values)
    own = laws.where(noisy, more)
    for name in ("study", "role"):
        own[name] = (
            "run",
            np.resize(judged[name].values, own.sizes["run"]),
        )
    return laws.where(noisy, ~more), join([lengths, own])


def _draw_band(axes: Axes, noisy: xr.Dataset, lengths: xr.Dataset, relative: bool) -> None:
    """From the drop under the stronger perturbation to that of the role `converged`."""
    quiet = laws.where(lengths, role=_JUDGED)
    quiet = laws.where(quiet, laws.usual(quiet))
    heights = np.intersect1d(noisy["height"].values, quiet["height"].values)
    ends = []
    for runs in (noisy, quiet):
        order = [int(np.flatnonzero(runs["height"].values == height)[0]) for height in heights]
        scale = runs["critical_length"].values[order] if relative else 1.0
        ends.append(runs["length"].values[order] / scale)
    axes.fill_between(
        heights,
        ends[0],
        ends[1],
        color=style.AGING,
        alpha=0.2,
        linewidth=0.0,
    )


def _draw_series(axes: Axes, table: xr.Dataset, series: _Series, relative: bool) -> None:
    """One set of lengths, a marker for each law and initial state; quiet runs have no bars."""
    for (_, old), kind, runs in laws.kinds(table):
        runs = laws.where(
            runs,
            np.isfinite(runs[series.column].values),
            role=series.role,
        )
        if not runs.sizes["run"]:
            continue
        if series is _PAPERS:
            runs = runs.assign(length_low=runs["length"], length_high=runs["length"])
        scale = runs["critical_length"].values if relative else 1.0
        look = series.look(kind)
        look["elinewidth"] = 0.8
        look["label"] = f"{series.label}, {_state(kind, old)}"
        laws.draw(
            axes,
            runs["height"].values,
            runs,
            series.column,
            scale,
            **look,
        )


def _state(kind: laws.Look, old: bool) -> str:
    return kind.label + _OLDER if old else kind.label


def _finish_lengths(axes: Axes, theory: xr.Dataset, lengths: xr.Dataset, band: bool) -> None:
    highest = _ABOVE * float(lengths["height"].max())
    top = np.interp(
        highest,
        theory["height"].values,
        theory["critical_length"].values,
    )
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
            handles.append(style.key(_state(kind, old), kind.marker, markersize=4.8))
    axes.legend(handles=handles, loc="upper left", labelspacing=0.3)
