"""The linear stability of the creeping patch: growth against length, and where it begins."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from . import style

USUAL_AGE = 1.0  # s
GROWTH_RANGE = (-1.2, 6.0)  # 1/s


@style.styled
def draw(lengths: xr.Dataset, table: xr.Dataset, patches: Sequence[xr.Dataset]) -> Figure:
    """Draw growth rates of the frozen patches and critical lengths over the theory's.

    Parameters
    ----------
    lengths : Dataset
        On ``run``: ``law``, ``height`` (m), ``phi0`` (s), ``length`` and ``theory_length`` (m).
    table : Dataset
        On ``run``, in the same order: ``stability_length``, ``_low``, ``_high`` (m).
    patches : sequence of Dataset
        In the same order, with ``patch_length`` (m) and ``growth_rate`` (1/s) on ``instant``.

    Returns
    -------
    Figure
        Two columns wide.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 7.2 * style.CENTIMETRE)
    left, right = figure.subplots(1, 2)
    _draw_growth(figure, left, table, patches)
    _draw_ratios(right, lengths, table)
    for axes, letter in ((left, "(a)"), (right, "(b)")):
        axes.set_title(letter, loc="left")
        axes.minorticks_on()
    return figure


def _usual(table: xr.Dataset) -> np.ndarray:
    return (table["law"].values.astype(str) == "aging") & (table["phi0"].values == USUAL_AGE)


def _draw_growth(
    figure: Figure, axes: Axes, table: xr.Dataset, patches: Sequence[xr.Dataset]
) -> None:
    """Growth rate of every frozen instant of the runs with the aging law, by height."""
    heights = table["height"].values
    norm = LogNorm(heights.min(), heights.max())
    shades = colormaps[style.SEQUENCE]
    for i in np.flatnonzero(_usual(table)):
        ratio = patches[i]["patch_length"].values / float(table["theory_length"][i])
        axes.plot(
            ratio, patches[i]["growth_rate"].values, ".", markersize=1.8,
            color=shades(0.9 * norm(heights[i])), rasterized=True,
        )  # fmt: skip
    axes.axhline(0.0, color=style.GUIDE, linewidth=0.7)
    axes.set_xlim(0.0, 1.0)
    axes.set_ylim(*GROWTH_RANGE)
    axes.set_xlabel("Patch length over theory $L/L_c$")
    axes.set_ylabel(r"Fastest growth $\max\,\mathrm{Re}\,\Lambda$ (1/s)")
    shown = [heights[_usual(table)].min(), heights[_usual(table)].max()]
    for height in shown:
        axes.plot([], [], "o", color=shades(0.9 * norm(height)), label=f"$H={height:g}$ m")
    axes.legend(loc="upper left")


def _draw_ratios(axes: Axes, lengths: xr.Dataset, table: xr.Dataset) -> None:
    """Both lengths over the theory's: where the force drops, and where growth begins."""
    kinds = (
        (_usual(table), "o", "aging law", style.AGING),
        (table["law"].values.astype(str) == "slip", "^", "slip law", style.SLIP),
        (table["phi0"].values != USUAL_AGE, "s", "aging law, older interface", style.OLD_AGE),
    )
    theory = table["theory_length"].values
    for chosen, marker, label, colour in kinds:
        height = table["height"].values[chosen]
        drop = (lengths["length"].values / theory)[chosen]
        axes.plot(height, drop, marker, color=colour, label=label)
        middle, low, high = (
            table[f"stability_length{end}"].values[chosen] / theory[chosen]
            for end in ("", "_low", "_high")
        )
        axes.errorbar(
            height, middle, yerr=np.clip([middle - low, high - middle], 0.0, None),
            linestyle="none", marker=marker, color=colour, markerfacecolor="white",
            elinewidth=0.8,
        )  # fmt: skip
    for value, name, dashes in ((1.0, "theory", "-"), (0.5, "half of it", "--")):
        axes.axhline(value, color=style.THEORY, linewidth=1.0, linestyle=dashes)
        axes.text(0.0044, value - 0.035, name, color=style.THEORY, fontsize=style.SMALL)
    axes.text(0.0068, 0.71, "the force drops (filled)", fontsize=style.SMALL)
    axes.text(0.0132, 0.585, "growth begins (open)", fontsize=style.SMALL)
    axes.set_xscale("log")
    axes.set_xlim(0.004, 0.13)
    axes.set_ylim(0.4, 1.3)
    axes.set_xlabel("Height $H$ (m)")
    axes.set_ylabel("Length over theory")
    axes.legend(loc="upper left", labelspacing=0.3)
