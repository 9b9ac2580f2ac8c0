"""Sensitivity of the length at the drop to parameters and definitions."""

import re

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.pictures import style

from . import laws

_PERCENT = 1e2
_SPREAD = 0.5  # of the markers of one row, over the distance of rows

SYMBOLS = {
    "rho": r"\rho",
    "mu": r"\mu",
    "nu": r"\nu",
    "sigma0": r"\sigma_0",
    "tau0": r"\tau_0",
    "phi0": r"\phi_0",
    "L": r"\mathrm{block\ length}",
}
"""TeX of the declared symbols that are not single letters; L is the measured length here."""

_PANELS = (
    ("length_change", "(a) length at the drop $L$"),
    ("ratio_change", "(b) over the theory $L/L_c$"),
)


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw relative changes of L, and of L over the theory's L_c, one row for each variation."""
    shown = laws.where(table, table["variation"].values != "base")
    variations = list(dict.fromkeys(shown["variation"].values.tolist()))
    rows = len(variations)
    figure, panels = style.panels(
        1,
        2,
        0.47 * (rows + 4),
        sharey=True,
    )
    for axes, (name, title) in zip(panels, _PANELS, strict=True):
        _draw_changes(axes, shown, variations, name)
        axes.set(title=title, xlabel="Change against the base (%)")
    panels[0].set_yticks(range(rows), [label(variation) for variation in variations])
    panels[0].set_ylim(rows - 0.5, -0.5)
    handles = panels[0].get_legend_handles_labels()[0]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def label(variation: str) -> str:
    """A variation, such as ``rho x 0.5``, in TeX."""
    found = re.fullmatch(r"(\w+\*?) (x|=) (\S+)( Pa)?", variation)
    if found is None:
        return re.sub(r" V$", " $V$", variation)
    symbol, relation, value, unit = found.groups()
    typeset = SYMBOLS.get(symbol, symbol)
    if unit:
        return rf"${typeset}={float(value) / 1e6:g}$ MPa"
    sign = r"\times" if relation == "x" else "="
    return rf"${typeset}{sign}{value}$"


def _draw_changes(
    axes: Axes,
    shown: xr.Dataset,
    variations: list[str],
    name: str,
) -> None:
    for i in range(0, len(variations), 2):
        axes.axhspan(i - 0.5, i + 0.5, color="0.95", zorder=0)
    heights = list(laws.groups(shown.sortby("height"), "height"))
    for i, own in enumerate(heights):
        marker, colour = style.look(i)
        shift = _SPREAD * (i - 0.5 * (len(heights) - 1)) / max(len(heights), 2)
        rows = np.array([variations.index(row) for row in own["variation"].values.tolist()])
        axes.plot(
            _PERCENT * own[name].values,
            rows + shift,
            marker,
            color=colour,
            ms=3.8,
            label=f"$H={float(own['height'][0]):g}$ m",
        )
    style.vertical(axes, 0.0, "-", 0.7)
    axes.tick_params(axis="y", length=0)
