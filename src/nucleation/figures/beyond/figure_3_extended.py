"""Figure 3 with more lengths: where the patch turns unstable, and the drop from noisy to quiet."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ...analysis.lengths import join, over_realisations
from ...figures import laws, style

OLDER = ", older interface"
ABOVE = 1.12  # the axes end at this multiple of the highest block
BAND = r"drop, load steady to $10^{-5}$ to $10^{-2}$"
JUDGED = "converged"


class Series(NamedTuple):
    """One set of lengths: column, role, and how it is drawn and called."""

    column: str
    role: str
    colour: str | None  # None: the kind's own
    filled: bool
    size: float  # points
    label: str

    def look(self, kind: laws.Look) -> Any:
        """Marker, size and colours of one kind of simulation."""
        colour = self.colour or kind.colour
        face = colour if self.filled else "white"
        return {"marker": kind.marker, "ms": self.size, "color": colour, "mfc": face}


PAPERS = Series("length", "paper", None, True, 3.0, "drop, quiet, on the paper's mesh")
STEADY = Series("length", JUDGED, None, False, 4.8, r"drop, load steady to $10^{-5}$")
STABILITY = Series(
    "stability_length", JUDGED, style.GREEN, True, 4.8, "patch turns unstable, $L_s$"
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
        On ``run``: ``role``, ``evolution``, ``height`` (m), ``phi0`` (s), ``theory_length`` and
        ``length`` with ``_low`` and ``_high`` (m).
    table : Dataset
        The same with ``stability_length`` in place of ``length``.
    noisy : Dataset
        Lengths of the aging law's faults under a stronger perturbation: a band from these to those
        with the role `converged` is drawn if they are given. Those at that role's own strength are
        more realisations of its faults.
    """
    if isinstance(noisy, xr.Dataset):
        noisy, lengths = _with_more(lengths, noisy)
    lengths = _means(lengths)
    figure, panels = style.panels(1, 2, 8.2)
    stability = STABILITY
    if JUDGED not in table["role"].values:  # growth begins: of the paper's runs
        stability = STABILITY._replace(role="paper")
    for axes, relative in zip(panels, (False, True), strict=True):
        length = theory["critical_length"].values
        for part, dashes in ((1.0, "-"), (0.5, "--")):
            values = np.full(length.shape, part) if relative else part * length
            axes.plot(theory["height"], values, dashes, color=style.THEORY, linewidth=1.2)
        if isinstance(noisy, xr.Dataset):
            _draw_band(axes, _means(noisy), lengths, relative)
        for series in (PAPERS, STEADY, stability):
            _draw_series(axes, table if series is stability else lengths, series, relative)
        axes.set_xlabel("Height $H$ (m)")
    _finish_lengths(panels[0], theory, lengths, isinstance(noisy, xr.Dataset))
    _finish_ratios(panels[1], lengths)
    style.letters(*panels, minor=True)
    return figure


def _means(table: xr.Dataset) -> xr.Dataset:
    """The mean of each fault's realisations, and their range by the one definition of a length."""
    ends = {"length_low": table["length"], "length_high": table["length"]}
    return over_realisations(table.assign(ends))


def _with_more(lengths: xr.Dataset, noisy: xr.Dataset) -> tuple[xr.Dataset, xr.Dataset]:
    """The stronger perturbed runs alone, and the others among those judged."""
    judged = laws.where(lengths, role=JUDGED)
    more = np.isin(noisy["strength"].values, judged["strength"].values)
    own = laws.where(noisy, more)
    for name in ("study", "role"):
        own[name] = "run", np.resize(judged[name].values, own.sizes["run"])
    return laws.where(noisy, ~more), join([lengths, own])


def _draw_band(axes: Axes, noisy: xr.Dataset, lengths: xr.Dataset, relative: bool) -> None:
    """From the drop under the stronger perturbation to that under the role `converged`'s."""
    quiet = laws.where(lengths, role=JUDGED)
    quiet = laws.where(quiet, laws.usual(quiet))
    heights = np.intersect1d(noisy["height"].values, quiet["height"].values)
    ends = []
    for runs in (noisy, quiet):
        order = [int(np.flatnonzero(runs["height"].values == height)[0]) for height in heights]
        scale = runs["theory_length"].values[order] if relative else 1.0
        ends.append(runs["length"].values[order] / scale)
    axes.fill_between(heights, ends[0], ends[1], color=style.AGING, alpha=0.2, linewidth=0.0)


def _draw_series(axes: Axes, table: xr.Dataset, series: Series, relative: bool) -> None:
    """One set of lengths, a marker for each law and initial state; quiet runs have no bars."""
    for (_, old), kind, runs in laws.kinds(table):
        runs = laws.where(runs, np.isfinite(runs[series.column].values), role=series.role)
        if not runs.sizes["run"]:
            continue
        if series is PAPERS:
            runs = runs.assign(length_low=runs["length"], length_high=runs["length"])
        scale = runs["theory_length"].values if relative else 1.0
        look = series.look(kind) | {"elinewidth": 0.8}
        label = f"{series.label}, {kind.label}{OLDER * old}"
        laws.draw(axes, runs["height"].values, runs, series.column, scale, label=label, **look)


def _finish_lengths(axes: Axes, theory: xr.Dataset, lengths: xr.Dataset, band: bool) -> None:
    highest = ABOVE * float(lengths["height"].max())
    top = np.interp(highest, theory["height"].values, theory["critical_length"].values)
    axes.set(xlim=(0.0, highest), ylim=(0.0, 1.6 * float(top)), ylabel="Length $L$ (m)")
    shown = laws.usual_law(lengths)
    usual = laws.looks([shown])[shown, False]
    handles: list[Artist] = [
        style.key("theory $L_c$", "", "-", style.THEORY, linewidth=1.2),
        style.key("theory $L_c/2$", "", "--", style.THEORY, linewidth=1.2),
    ]
    for series in (STEADY, PAPERS, STABILITY):
        look = series.look(usual)
        handles.append(style.key(series.label, colour=look.pop("color"), **look))
    if band:
        handles.append(Patch(color=style.AGING, alpha=0.2, label=BAND))
    axes.legend(handles=handles, loc="upper left", labelspacing=0.3)


def _finish_ratios(axes: Axes, lengths: xr.Dataset) -> None:
    axes.set(xscale="log", xlim=(0.004, 0.13), ylim=(0.4, 1.2))
    axes.set_ylabel("Length over theory $L/L_c$")
    handles = [
        style.key(kind.label + OLDER * old, kind.marker, markersize=4.8)
        for (_, old), kind, runs in laws.kinds(lengths)
        if runs.sizes["run"]
    ]
    axes.legend(handles=handles, loc="upper left", labelspacing=0.3)
