"""Figure 3 with more lengths: where the patch turns unstable, and the drop from noisy to quiet."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...analysis.lengths import join, over_realisations
from ...figures import laws, style

OLDER = ", older interface"
RATIOS = (0.4, 1.2)
ABOVE = 1.12  # the axes end at this multiple of the highest block
LIMIT_HEIGHTS = (0.004, 0.13)  # m, of the logarithmic axis


class Series(NamedTuple):
    """One set of lengths: column, role, and how it is drawn and called."""

    column: str
    role: str
    colour: str | None  # None: the kind's own
    filled: bool
    size: float  # points
    bars: bool  # whether it has error bars
    label: str


DROPS = (
    Series("length", "paper", None, True, 3.0, False, "drop, quiet, on the paper's mesh"),
    Series("length", "converged", None, False, 4.8, True, r"drop, load steady to $10^{-5}$"),
)
BAND = r"drop, load steady to $10^{-5}$ to $10^{-2}$"
JUDGED = "converged"
STABILITY = (JUDGED, "paper")  # growth begins: of the first of these roles that is there


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
        On ``run``: ``role``, ``evolution``, ``height`` (m), ``phi0`` (s), ``theory_length`` and
        ``length`` with ``_low`` and ``_high`` (m).
    table : Dataset
        The same with ``stability_length`` in place of ``length``.
    noisy : Dataset
        Lengths of the aging law's faults under a stronger perturbation: a band from these to those
        with the role `converged` is drawn if they are given. Those at that role's own strength are
        more realisations of its faults.

    Returns
    -------
    Figure
        Two columns wide.
    """
    if isinstance(noisy, xr.Dataset):
        noisy, lengths = _with_more(lengths, noisy)
    lengths = _means(lengths)
    figure = style.new_figure(style.DOUBLE_COLUMN, 8.2 * style.CENTIMETRE)
    left, right = figure.subplots(1, 2)
    roles = table["role"].values.astype(str)
    role = next((name for name in STABILITY if name in roles), STABILITY[0])
    stability = Series(
        "stability_length", role, style.GREEN, True, 4.8, True, "patch turns unstable, $L_s$"
    )
    for axes, relative in ((left, False), (right, True)):
        _draw_theory(axes, theory, relative)
        if isinstance(noisy, xr.Dataset):
            _draw_band(axes, _means(noisy), lengths, relative)
        for series in (*DROPS, stability):
            _draw_series(axes, table if series is stability else lengths, series, relative)
        axes.set_xlabel("Height $H$ (m)")
    _finish_lengths(left, theory, lengths, (*DROPS[::-1], stability), isinstance(noisy, xr.Dataset))
    _finish_ratios(right, lengths)
    style.letters(left, right)
    for axes in (left, right):
        axes.minorticks_on()
    return figure


def _means(table: xr.Dataset) -> xr.Dataset:
    """The mean of each fault's realisations, and their range by the one definition of a length."""
    ends = {"length_low": table["length"], "length_high": table["length"]}
    return over_realisations(table.assign(ends))


def _with_more(lengths: xr.Dataset, noisy: xr.Dataset) -> tuple[xr.Dataset, xr.Dataset]:
    """The stronger perturbed runs alone, and the others among those judged."""
    judged = lengths["role"].values.astype(str) == JUDGED
    more = np.isin(noisy["strength"].values, lengths["strength"].values[judged])
    own = noisy.isel(run=np.flatnonzero(more))
    same = {name: ("run", np.resize(lengths[name].values[judged], own.sizes["run"]))
            for name in ("study", "role")}  # fmt: skip
    own = own.assign(same)
    return noisy.isel(run=np.flatnonzero(~more)), join([lengths, own])


def _draw_theory(axes: Axes, theory: xr.Dataset, relative: bool) -> None:
    """The theory's length, solid, and its half, dashed."""
    height, length = theory["height"].values, theory["critical_length"].values
    for part, dashes in ((1.0, "-"), (0.5, "--")):
        values = np.full(height.shape, part) if relative else part * length
        axes.plot(height, values, dashes, color=style.THEORY, linewidth=1.2)


def _draw_band(axes: Axes, noisy: xr.Dataset, lengths: xr.Dataset, relative: bool) -> None:
    """From the drop under the stronger perturbation to that under the role `converged`'s."""
    quiet = lengths.isel(run=np.flatnonzero(lengths["role"].values == "converged"))
    quiet = quiet.isel(run=np.flatnonzero(laws.usual(quiet)))
    heights = np.intersect1d(noisy["height"].values, quiet["height"].values)
    ends = []
    for runs in (noisy, quiet):
        order = [int(np.flatnonzero(runs["height"].values == height)[0]) for height in heights]
        scale = runs["theory_length"].values[order] if relative else 1.0
        ends.append(runs["length"].values[order] / scale)
    strong, weak = ends
    axes.fill_between(heights, strong, weak, color=style.AGING, alpha=0.2, linewidth=0.0)


def _draw_series(axes: Axes, table: xr.Dataset, series: Series, relative: bool) -> None:
    """One set of lengths, a marker for each law and initial state."""
    law, aged = table["evolution"].values.astype(str), laws.aged(table)
    chosen = table["role"].values.astype(str) == series.role
    chosen &= np.isfinite(table[series.column].values)
    scale = table["theory_length"].values if relative else np.ones(law.size)
    for (name, old), kind in laws.looks(law).items():
        runs = np.flatnonzero(chosen & (law == name) & (aged == old))
        if not runs.size:
            continue
        middle, low, high = (
            (table[series.column + end].values / scale)[runs] for end in ("", "_low", "_high")
        )
        colour = series.colour or kind.colour
        below, above = np.clip(np.nan_to_num([middle - low, high - middle]), 0.0, None)
        axes.errorbar(
            table["height"].values[runs], middle, yerr=(below, above) if series.bars else None,
            linestyle="none", marker=kind.marker, markersize=series.size, color=colour,
            markerfacecolor=colour if series.filled else "white", elinewidth=0.8,
            label=f"{series.label}, {kind.label}{OLDER * old}",
        )  # fmt: skip


def _finish_lengths(
    axes: Axes, theory: xr.Dataset, lengths: xr.Dataset, drawn: tuple[Series, ...], band: bool
) -> None:
    highest = ABOVE * float(lengths["height"].max())
    top = np.interp(highest, theory["height"].values, theory["critical_length"].values)
    axes.set_xlim(0.0, highest)
    axes.set_ylim(0.0, 1.6 * float(top))
    axes.set_ylabel("Length $L$ (m)")
    handles: list[Artist] = [
        axes.plot([], [], dashes, color=style.THEORY, linewidth=1.2, label=label)[0]
        for dashes, label in (("-", "theory $L_c$"), ("--", "theory $L_c/2$"))
    ]
    shown = laws.usual_law(lengths)
    usual = laws.looks([shown])[shown, False]
    for series in drawn:
        colour = series.colour or usual.colour
        handles += axes.plot(
            [], [], usual.marker, color=colour, markersize=series.size, label=series.label,
            markerfacecolor=colour if series.filled else "white",
        )  # fmt: skip
    if band:
        handles.append(axes.fill_between([], [], [], color=style.AGING, alpha=0.2, label=BAND))
    axes.legend(handles=handles, loc="upper left", labelspacing=0.3)


def _finish_ratios(axes: Axes, lengths: xr.Dataset) -> None:
    axes.set_xscale("log")
    axes.set_xlim(*LIMIT_HEIGHTS)
    axes.set_ylim(*RATIOS)
    axes.set_ylabel("Length over theory $L/L_c$")
    law, aged = lengths["evolution"].values.astype(str), laws.aged(lengths)
    handles = [
        axes.plot([], [], kind.marker, color=style.GUIDE, markersize=4.8,
                  label=kind.label + OLDER * old)[0]
        for (name, old), kind in laws.looks(law).items()
        if ((law == name) & (aged == old)).any()
    ]  # fmt: skip
    axes.legend(handles=handles, loc="upper left", labelspacing=0.3)
