"""Sensitivity of the critical length to parameters and definitions."""

import re

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style

PERCENT = 1e2
BASE = "base"
SPREAD = 0.5  # of the markers of one row, over the distance of rows
ROW = 0.47 * style.CENTIMETRE

SYMBOLS = {
    "rho": r"\rho", "sigma0": r"\sigma_0", "tau0": r"\tau_0", "mu": r"\mu", "nu": r"\nu",
    "phi0": r"\phi_0",
}  # fmt: skip
"""How the symbols of declarations are typeset, where they are not single letters."""


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw relative changes of L_c, and of L_c over the theory's, one row for each variation.

    Parameters
    ----------
    table : Dataset
        From :func:`nucleation.analysis.sensitivity.sensitivity_table`.

    Returns
    -------
    Figure
        Two columns wide, two panels.
    """
    shown = table.isel(run=np.flatnonzero(table["variation"].values != BASE))
    rows = list(dict.fromkeys(shown["variation"].values.tolist()))
    figure = style.new_figure(style.DOUBLE_COLUMN, (len(rows) + 4) * ROW)
    left, right = figure.subplots(1, 2, sharey=True)
    for axes, name, title in (
        (left, "length_change", "(a) critical length $L_c$"),
        (right, "ratio_change", "(b) $L_c$ over the theory's"),
    ):
        _draw_changes(axes, shown, rows, name)
        axes.set_title(title, loc="left")
        axes.set_xlabel("Change against the base (%)")
    left.set_yticks(range(len(rows)), [label(row) for row in rows])
    left.set_ylim(len(rows) - 0.5, -0.5)
    handles, labels = left.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(handles))
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
    heights = np.unique(shown["height"].values).tolist()
    shifts = SPREAD * (np.arange(len(heights)) - 0.5 * (len(heights) - 1)) / max(len(heights), 2)
    place = {row: i for i, row in enumerate(rows)}
    for i in range(0, len(rows), 2):
        axes.axhspan(i - 0.5, i + 0.5, color="0.95", zorder=0)
    for i, (height, shift) in enumerate(zip(heights, shifts, strict=True)):
        marker, colour = style.look(i)
        of_height = shown.isel(run=np.flatnonzero(shown["height"].values == height))
        at = np.array([place[row] for row in of_height["variation"].values.tolist()])
        axes.plot(
            PERCENT * of_height[name].values, at + shift, marker, color=colour, markersize=3.8,
            label=f"$H={height:g}$ m",
        )  # fmt: skip
    axes.axvline(0.0, color=style.GUIDE, linewidth=0.7)
    axes.tick_params(axis="y", length=0)
