"""Sensitivity of the critical length to parameters and definitions."""

import re

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import laws, style

PERCENT = 1e2
SPREAD = 0.5  # of the markers of one row, over the distance of rows

LETTERS = {"rho": r"\rho", "mu": r"\mu", "nu": r"\nu"}
SYMBOLS = LETTERS | {"sigma0": r"\sigma_0", "tau0": r"\tau_0", "phi0": r"\phi_0"}
"""How the symbols of declarations are typeset, where they are not single letters."""

PANELS = (
    ("length_change", "(a) critical length $L_c$"),
    ("ratio_change", "(b) $L_c$ over the theory's"),
)


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw relative changes of L_c, and of L_c over the theory's, one row for each variation.

    `table` is that of :func:`nucleation.analysis.sensitivity.sensitivity_table`.
    """
    shown = laws.where(table, table["variation"].values != "base")
    rows = list(dict.fromkeys(shown["variation"].values.tolist()))
    figure, panels = style.panels(1, 2, 0.47 * (len(rows) + 4), sharey=True)
    for axes, (name, title) in zip(panels, PANELS, strict=True):
        _draw_changes(axes, shown, rows, name)
        axes.set_title(title, loc="left")
        axes.set_xlabel("Change against the base (%)")
    panels[0].set_yticks(range(len(rows)), [label(row) for row in rows])
    panels[0].set_ylim(len(rows) - 0.5, -0.5)
    handles = panels[0].get_legend_handles_labels()[0]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def label(variation: str) -> str:
    """A variation in the figure's typography, such as ``rho x 0.5``."""
    found = re.fullmatch(r"(\w+\*?) (x|=) (\S+)( Pa)?", variation)
    if found is None:
        return re.sub(r" V$", " $V$", variation)
    symbol, relation, value, unit = found.groups()
    typeset = SYMBOLS.get(symbol, symbol)
    if unit:
        return rf"${typeset}={float(value) / 1e6:g}$ MPa"
    sign = r"\times" if relation == "x" else "="
    return rf"${typeset}{sign}{value}$"


def _draw_changes(axes: Axes, shown: xr.Dataset, rows: list[str], name: str) -> None:
    for i in range(0, len(rows), 2):
        axes.axhspan(i - 0.5, i + 0.5, color="0.95", zorder=0)
    heights = list(laws.groups(shown.sortby("height"), "height"))
    for i, own in enumerate(heights):
        marker, colour = style.look(i)
        shift = SPREAD * (i - 0.5 * (len(heights) - 1)) / max(len(heights), 2)
        at = np.array([rows.index(row) for row in own["variation"].values.tolist()]) + shift
        label = f"$H={float(own['height'][0]):g}$ m"
        axes.plot(PERCENT * own[name].values, at, marker, color=colour, ms=3.8, label=label)
    axes.axvline(0.0, color=style.GUIDE, linewidth=0.7)
    axes.tick_params(axis="y", length=0)
