"""The map: the patch's two lengths over the theory's, over the block's height and the weakening."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import (
    LogLocator,
    NullFormatter,
    StrMethodFormatter,
)

from ...figures import style
from ...patch.tables.map import mean_over_seeds

_RATIOS = (0.45, 1.0)  # range of the colours
_CONTOURS = (0.5, 0.55, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0, 1.2)
_NOTHING = "#D9D9D9"
_SLICES = (
    ("o", style.VERMILLION),
    ("s", style.BLUE),
    ("^", style.GREEN),
)
"""Marks of the weakenings in the panel over height."""


@style.styled
def draw(grid: xr.Dataset) -> Figure:
    """Draw ratios of lengths as images with contours, and lengths over height.

    The images show stability, and the drop at the weakest and the strongest perturbation. Lengths
    over height are drawn for a few weakenings.

    Parameters
    ----------
    grid : Dataset
        From :func:`nucleation.patch.tables.map.on_grid`.

    Returns
    -------
    Figure
        Four panels.
    """
    figure, ((stable, quiet), (noisy, slices)) = style.panels(2, 2, 13.0)
    stability = mean_over_seeds(grid, "stability_ratio").isel(strength=0)
    drop = mean_over_seeds(grid, "length_ratio")
    weakest = drop.isel(strength=0)
    strongest = drop.isel(strength=-1)
    weak, strong = (rf"$10^{{{np.log10(grid['strength'].values[i]):.0f}}}$" for i in (0, -1))
    for axes, ratio, title in (
        (stable, stability, r"(a) patch turns unstable, $L_s/L_c$"),
        (quiet, weakest, rf"(b) drop, load {weak}, $L/L_c$"),
        (noisy, strongest, rf"(c) drop, load {strong}, $L/L_c$"),
    ):
        image = _draw_ratio(axes, ratio)
        axes.set_title(title, loc="left")
    label = "(a) to (c): length over theory"
    figure.colorbar(image, ax=[quiet, slices], label=label, extend="both")
    _draw_slices(slices, grid, stability, weakest)
    slices.set_title("(d) lengths over height", loc="left")
    return figure


def _draw_ratio(axes: Axes, ratio: xr.DataArray) -> QuadMesh:
    """An image of a ratio over height and weakening, with contours; grey where there is none."""
    values = ratio.transpose("zeta_over_a", "height").values
    height = ratio["height"].values
    weakening = ratio["zeta_over_a"].values
    axes.set_facecolor(_NOTHING)
    image = axes.pcolormesh(
        height,
        weakening,
        values,
        cmap=style.SEQUENCE,
        norm=Normalize(*_RATIOS),
        shading="nearest",
        rasterized=True,
    )
    if min(values.shape) > 1 and np.isfinite(values).any():
        lines = axes.contour(
            height,
            weakening,
            values,
            levels=_CONTOURS,
            colors="white",
            linewidths=0.7,
        )
        axes.clabel(lines, fmt="%g", fontsize=style.SMALL)
    axes.set(xscale="log", yscale="log", xlabel="Block height $H$ (m)")
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)))
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_ylabel(r"Weakening $\zeta/a$")
    return image


def _draw_slices(
    axes: Axes,
    grid: xr.Dataset,
    stability: xr.DataArray,
    drop: xr.DataArray,
) -> None:
    """Theory, stability and drop over height for a few weakenings."""
    weakenings = grid["zeta_over_a"].values
    height = grid["height"].values
    places = np.linspace(0, weakenings.size - 1, len(_SLICES) + 2)[1:-1]
    shown = np.unique(places.round().astype(int))
    for i, (marker, colour) in zip(shown, _SLICES, strict=False):
        theory = grid["critical_length"].values[:, i]
        axes.plot(
            height,
            theory,
            color=colour,
            label=rf"$\zeta/a = {weakenings[i]:.2g}$",
        )
        for ratio, face in ((drop, colour), (stability, "white")):
            length = ratio.isel(zeta_over_a=i).values * theory
            axes.plot(
                height,
                length,
                marker,
                color=colour,
                markerfacecolor=face,
                markersize=3.5,
            )
    handles = [
        *style.entries(axes).values(),
        style.key("theory $L_c$", "", "-"),
        style.key("drop", "o", markersize=3.5),
        style.key("patch unstable", "o", markersize=3.5, **style.OPEN),
    ]
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="Block height $H$ (m)",
        ylabel="Length (m)",
    )
    axes.set_ylim(bottom=axes.get_ylim()[0] / 2.0)  # for the legend
    axes.legend(
        handles=handles,
        fontsize=style.SMALL,
        loc="lower right",
        ncols=2,
    )
