"""The map: the patch's two lengths over the theory's, over the block's height and the weakening."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from ...figures import style
from ...patch.tables.map import mean_over_seeds

RATIOS = (0.45, 1.0)  # of the colours
CONTOURS = (0.5, 0.55, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0, 1.2)
SLICES = (("o", style.VERMILLION), ("s", style.BLUE), ("^", style.GREEN))
"""Looks of the weakenings of which lengths are shown over height."""


@style.styled
def draw(grid: xr.Dataset) -> Figure:
    """Draw ratios of lengths as images with contours, and lengths over height.

    Of stability, of the drop at the weakest and the strongest perturbation, and lengths over height
    for some weakenings. `grid` is that of :func:`nucleation.patch.tables.map.on_grid`.
    """
    figure, ((stable, quiet), (noisy, slices)) = style.panels(2, 2, 13.0)
    stability = mean_over_seeds(grid, "stability_ratio").isel(strength=0)
    drop = mean_over_seeds(grid, "length_ratio")
    weak, strong = (rf"$10^{{{np.log10(grid['strength'].values[i]):.0f}}}$" for i in (0, -1))
    for axes, ratio, title in (
        (stable, stability, r"(a) patch turns unstable, $L_s/L_c$"),
        (quiet, drop.isel(strength=0), rf"(b) drop, load {weak}, $L/L_c$"),
        (noisy, drop.isel(strength=-1), rf"(c) drop, load {strong}, $L/L_c$"),
    ):
        image = _draw_ratio(axes, ratio)
        axes.set_title(title, loc="left")
    label = "(a) to (c): length over theory"
    figure.colorbar(image, ax=[quiet, slices], label=label, extend="both")
    _draw_slices(slices, grid, stability, drop.isel(strength=0))
    slices.set_title("(d) lengths over height", loc="left")
    return figure


def _draw_ratio(axes: Axes, ratio: xr.DataArray) -> Any:
    """An image of a ratio over height and weakening, with contours; grey where there is none."""
    values = ratio.transpose("zeta_over_a", "height").values
    over = ratio["height"].values, ratio["zeta_over_a"].values, values
    axes.set_facecolor("#D9D9D9")
    look: Any = {"norm": Normalize(*RATIOS), "shading": "nearest", "rasterized": True}
    image = axes.pcolormesh(*over, cmap=style.SEQUENCE, **look)
    if min(values.shape) > 1 and np.isfinite(values).any():
        lines = axes.contour(*over, levels=CONTOURS, colors="white", linewidths=0.7)
        axes.clabel(lines, fmt="%g", fontsize=style.SMALL)
    axes.set(xscale="log", yscale="log", xlabel="Block height $H$ (m)")
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)))
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_ylabel(r"Weakening $\zeta/a$")
    return image


def _draw_slices(axes: Axes, grid: xr.Dataset, stability: xr.DataArray, drop: xr.DataArray) -> None:
    """Theory, stability and drop over height for some weakenings."""
    weakenings, height = grid["zeta_over_a"].values, grid["height"].values
    places = np.linspace(0, weakenings.size - 1, len(SLICES) + 2)[1:-1]
    for i, (marker, colour) in zip(np.unique(places.round().astype(int)), SLICES, strict=False):
        theory = grid["theory_length"].values[:, i]
        axes.plot(height, theory, color=colour, label=rf"$\zeta/a = {weakenings[i]:.2g}$")
        for ratio, face in ((drop, colour), (stability, "white")):
            length = ratio.isel(zeta_over_a=i).values * theory
            axes.plot(height, length, marker, color=colour, markerfacecolor=face, markersize=3.5)
    handles = [
        *style.entries(axes).values(),
        style.key("theory $L_c$", "", "-"),
        style.key("drop", "o", markersize=3.5),
        style.key("patch unstable", "o", markersize=3.5, **style.OPEN),
    ]
    axes.set(xscale="log", yscale="log", xlabel="Block height $H$ (m)", ylabel="Length (m)")
    axes.set_ylim(bottom=axes.get_ylim()[0] / 2.0)  # for the legend
    axes.legend(handles=handles, fontsize=style.SMALL, loc="lower right", ncols=2)
