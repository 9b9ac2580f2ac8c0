"""The map: the patch's two lengths over the theory's, over the block's height and the weakening."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from ...figures import style
from ...patch.map_table import mean_over_seeds

RATIOS = (0.45, 1.0)  # of the colours
CONTOURS = (0.5, 0.55, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0, 1.2)
SLICES = 3  # weakenings of which lengths are shown over height
ROOM = 2.0  # of the panel of lengths
MARKERS = ("o", "s", "^")


@style.styled
def draw(grid: xr.Dataset) -> Figure:
    """Draw ratios of lengths as images with contours, and lengths over height.

    Parameters
    ----------
    grid : Dataset
        Of :func:`nucleation.patch.map_table.on_grid`.

    Returns
    -------
    Figure
        Two columns wide: stability, the drop at the weakest and the strongest perturbation, and
        lengths over height for some weakenings.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 13.0 * style.CENTIMETRE)
    (stable, quiet), (noisy, slices) = figure.subplots(2, 2)
    strengths = grid["strength"].values
    stability = mean_over_seeds(grid, "stability_ratio").isel(strength=0)
    drop = mean_over_seeds(grid, "length_ratio")
    shown = [
        (stable, stability, r"patch turns unstable, $L_s/L_c$"),
        (quiet, drop.isel(strength=0), rf"drop, load {_power(strengths[0])}, $L/L_c$"),
        (noisy, drop.isel(strength=-1), rf"drop, load {_power(strengths[-1])}, $L/L_c$"),
    ]
    for (axes, ratio, title), letter in zip(shown, "abc", strict=True):
        image = _draw_ratio(axes, ratio)
        axes.set_title(f"({letter}) {title}", loc="left")
    figure.colorbar(
        image, ax=[quiet, slices], label="(a) to (c): length over theory", extend="both"
    )
    _draw_slices(slices, grid, stability, drop.isel(strength=0))
    slices.set_title("(d) lengths over height", loc="left")
    return figure


def _power(strength: float) -> str:
    """A strength as a power of ten."""
    return rf"$10^{{{np.log10(strength):.0f}}}$"


def _draw_ratio(axes: Axes, ratio: xr.DataArray):  # type: ignore[no-untyped-def]
    """An image of a ratio over height and weakening, with contours; grey where there is none."""
    height, weakening = ratio["height"].values, ratio["zeta_over_a"].values
    values = ratio.transpose("zeta_over_a", "height").values
    axes.set_facecolor("#D9D9D9")
    image = axes.pcolormesh(
        height, weakening, values, norm=Normalize(*RATIOS), cmap=style.SEQUENCE, shading="nearest",
        rasterized=True,
    )  # fmt: skip
    if min(values.shape) > 1 and np.isfinite(values).any():
        lines = axes.contour(
            height, weakening, values, levels=CONTOURS, colors="white", linewidths=0.7
        )
        axes.clabel(lines, fmt="%g", fontsize=style.SMALL)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)))
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel("Block height $H$ (m)")
    axes.set_ylabel(r"Weakening $\zeta/a$")
    return image


def _draw_slices(axes: Axes, grid: xr.Dataset, stability: xr.DataArray, drop: xr.DataArray) -> None:
    """Theory, stability and drop over height for some weakenings."""
    weakenings = grid["zeta_over_a"].values
    chosen = np.unique(np.linspace(0, weakenings.size - 1, SLICES + 2)[1:-1].round().astype(int))
    colours = (style.VERMILLION, style.BLUE, style.GREEN)
    height = grid["height"].values
    for i, marker, colour in zip(chosen, MARKERS, colours, strict=False):
        theory = grid["theory_length"].values[:, i]
        axes.plot(height, theory, color=colour, label=rf"$\zeta/a = {weakenings[i]:.2g}$")
        for ratio, face in ((drop, colour), (stability, "white")):
            axes.plot(
                height, ratio.isel(zeta_over_a=i).values * theory, marker, color=colour,
                markerfacecolor=face, markersize=3.5, linestyle="none",
            )  # fmt: skip
    axes.plot([], [], color=style.GUIDE, label="theory $L_c$")
    axes.plot([], [], "o", color=style.GUIDE, markersize=3.5, label="drop")
    axes.plot([], [], "o", color=style.GUIDE, markersize=3.5, label="patch unstable", **style.OPEN)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("Block height $H$ (m)")
    axes.set_ylabel("Length (m)")
    low, high = axes.get_ylim()
    axes.set_ylim(low / ROOM, high)  # for the legend
    axes.legend(fontsize=style.SMALL, loc="lower right", ncols=2)
