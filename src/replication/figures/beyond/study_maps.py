"""Maps of a study with two varied numbers on a full grid."""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from nucleation.model.quantities import Quantity
from nucleation.pictures import style
from nucleation.types import Array

from .parameter_axes import edges, label_of, set_scale

_RATIO_MAP = "cividis"  # looks the same to all colour vision


def draw_maps(
    table: xr.Dataset,
    varied: Mapping[str, Sequence[float] | Sequence[str]],
    entries: Mapping[str, Quantity],
    grid: Mapping[str, Array],
) -> Figure:
    """Draw maps of the length and of its ratio to the theory's.

    Parameters
    ----------
    table : Dataset
        The study's table of lengths.
    varied : mapping
        The two numbers with their values in every run.
    entries : mapping
        Their declarations.
    grid : mapping
        Their values on the grid: first the abscissa, then the ordinate.

    Returns
    -------
    Figure
        Two panels.
    """
    along, up = grid
    x = np.asarray(varied[along], dtype=float)
    y = np.asarray(varied[up], dtype=float)
    at = np.searchsorted(grid[up], y), np.searchsorted(grid[along], x)
    figure, (left, right) = style.panels(1, 2, 7.476, sharex=True, sharey=True)
    length = table["length"].values
    ratio = length / table["critical_length"].values
    lost = ~np.isfinite(length)
    label = f"no event ({lost.sum()} of {lost.size})"
    for axes, values, title, colours in (
        (left, length, "(a) Length at the drop, simulated (m)", style.SEQUENCE),
        (right, ratio, "(b) Simulations over theory", _RATIO_MAP),
    ):
        image = np.full((grid[up].size, grid[along].size), np.nan)
        image[at] = values
        mesh = axes.pcolormesh(
            edges(grid[along]),
            edges(grid[up]),
            image,
            cmap=colours,
        )
        axes.plot(x[lost], y[lost], "x", color=style.VERMILLION, label=label)
        figure.colorbar(mesh, ax=axes, pad=0.02)
        axes.set_title(title)
        axes.set_xlabel(label_of(along, entries[along]))
        set_scale(axes, "x", grid[along])
        set_scale(axes, "y", grid[up])
        axes.tick_params(which="both", direction="out", top=False, right=False)
    if lost.any():
        left.legend(frameon=True, framealpha=1.0)
    left.set_ylabel(label_of(up, entries[up]))
    return figure
