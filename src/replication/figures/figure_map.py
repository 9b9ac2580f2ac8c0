"""The map: the patch's two lengths over the theory's, over the block's height and the weakening."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.ticker import LogLocator
from scipy.ndimage import convolve1d

from nucleation.pictures import style
from nucleation.types import Array

from .study_axes import edges

_RATIOS = (0.45, 1.0)  # range of the colours
_CONTOURS = (0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.9, 1.0, 1.2)
_WEIGHTS = (0.25, 0.5, 0.25)  # of neighbours, for contours: realisations scatter by 2 %
_SHORTEST = 4  # points of a contour; shorter ones are scatter
_NOTHING = "#D9D9D9"
_SLICES = (("o", style.VERMILLION), ("s", style.BLUE), ("^", style.BLACK))
"""Marks of the weakenings in the panel over height."""
_LEGEND_ROOM = 0.15  # of the range of lengths, above them
_LABEL_ROOM = 0.25  # of the range of heights, beside them


@style.styled
def draw(grid: xr.Dataset) -> Figure:
    """Draw ratios of lengths as images with contours, and lengths over height.

    The images show stability, and the drop at the weakest and the strongest perturbation. Lengths
    over height are drawn for a few weakenings.
    """
    figure, ((stable, quiet), (noisy, slices)) = style.panels(
        2,
        2,
        13.0,
    )
    stability = grid["stability_ratio"].mean("seed", skipna=False).isel(strength=0)
    drop = grid["length_ratio"].mean("seed", skipna=False)
    _draw_ratio(stable, stability, r"(a) patch turns unstable, $L_s/L_c$")
    for axes, letter, i in ((quiet, "b", 0), (noisy, "c", -1)):
        exponent = np.log10(grid["strength"].values[i])
        title = rf"({letter}) drop, load $10^{{{exponent:.0f}}}$, $L/L_c$"
        image = _draw_ratio(axes, drop.isel(strength=i), title)
    label = "(a) to (c): length over theory"
    figure.colorbar(
        image,
        ax=[quiet, slices],
        label=label,
        extend="both",
    )
    _draw_slices(slices, grid, stability, drop.isel(strength=0))
    return figure


def _draw_ratio(axes: Axes, ratio: xr.DataArray, title: str) -> QuadMesh:
    """An image of a ratio over height and weakening, with contours; grey where there is none."""
    values = ratio.transpose("zeta_over_a", "height").values
    height = ratio["height"].values
    weakening = ratio["zeta_over_a"].values
    axes.set(facecolor=_NOTHING, xscale="log", yscale="log", title=title)
    image = axes.pcolormesh(
        edges(height, logarithmic=True),
        edges(weakening, logarithmic=True),
        values,
        cmap=style.SEQUENCE,
        norm=Normalize(*_RATIOS),
        rasterized=True,
    )
    if min(values.shape) > 1 and np.isfinite(values).any():
        _draw_contours(axes, height, weakening, values)
    axes.set(xlabel="Block height $H$ (m)", ylabel=r"Weakening $\zeta/a$")
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)))
    style.plain_numbers(axes.yaxis)
    return image


def _draw_contours(
    axes: Axes,
    height: Array,
    weakening: Array,
    values: Array,
) -> None:
    """Contours of the ratio, smoothed over neighbours, without short pieces."""
    smooth = _smoothed(_smoothed(values).T).T
    look: style.Options = {"levels": _CONTOURS, "colors": "white", "linewidths": 0.7}
    lines = axes.contour(height, weakening, smooth, **look)
    lines.set_paths([_long(path) for path in lines.get_paths()])
    axes.clabel(lines, fmt="%g", fontsize=style.SMALL)


def _smoothed(values: Array) -> Array:
    """Weighted means of neighbours in a column, of those that are known; NaN stays NaN."""
    known = np.isfinite(values)
    total = convolve1d(
        np.where(
            known,
            values,
            0.0,
        ),
        _WEIGHTS,
        axis=0,
        mode="constant",
    )
    share = convolve1d(known.astype(float), _WEIGHTS, axis=0, mode="constant")
    return np.divide(
        total,
        share,
        out=np.full(values.shape, np.nan),
        where=known,
    )


def _long(path: Path) -> Path:
    """A contour without its pieces of few points."""
    starts = np.flatnonzero(np.asarray(path.codes) == Path.MOVETO)
    pieces = np.split(np.asarray(path.vertices), starts[1:])
    return Path.make_compound_path(*[Path(piece) for piece in pieces if len(piece) >= _SHORTEST])


def _draw_slices(
    axes: Axes,
    grid: xr.Dataset,
    stability: xr.DataArray,
    drop: xr.DataArray,
) -> None:
    """Theory, stability and drop over height for a few weakenings."""
    weakenings = grid["zeta_over_a"].values
    height = grid["height"].values
    places = np.linspace(
        0,
        weakenings.size - 1,
        len(_SLICES) + 2,
    )[1:-1]
    shown = np.unique(places.round().astype(int))
    for i, (marker, colour) in zip(shown, _SLICES, strict=False):
        theory = grid["critical_length"].values[:, i]
        axes.plot(height, theory, color=colour)
        axes.plot(
            height,
            theory * drop[:, i],
            marker,
            color=colour,
            markersize=3.5,
        )
        axes.plot(
            height,
            theory * stability[:, i],
            "--",
            color=colour,
            linewidth=0.9,
        )
        name = rf"$\zeta/a = {weakenings[i]:.2g}$"
        style.note(
            axes,
            name,
            (height[-1], theory[-1]),
            (5.0, 0.0),
            va="center",
            color=colour,
        )
    axes.set(xscale="log", yscale="log", xlabel="Block height $H$ (m)", ylabel="Length (m)")
    axes.set_title("(d) lengths over height")
    low, high = axes.get_ylim()
    axes.set_ylim(top=high * (high / low) ** _LEGEND_ROOM)
    first, last = axes.get_xlim()
    axes.set_xlim(right=last * (last / first) ** _LABEL_ROOM)
    keys = [
        style.key("theory $L_c$", "", "-"),
        style.key("drop $L$", "o", markersize=3.5),
        style.key("$L_s$", "", "--", linewidth=0.9),
    ]
    look: style.Options = {"fontsize": style.SMALL, "loc": "upper left", "columnspacing": 1.2}
    axes.legend(handles=keys, ncols=3, **look)
