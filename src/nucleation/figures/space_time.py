"""Space-time images on grids that are uneven in time."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import Normalize
from numpy.typing import NDArray


def cell_edges(centres: NDArray) -> NDArray:
    """Edges of the cells about increasing centres: half way between, and the outer centres."""
    centres = np.asarray(centres, dtype=float)
    between = (centres[1:] + centres[:-1]) / 2.0
    return np.concatenate([centres[:1], between, centres[-1:]])


def thin(time: NDArray, start: float, end: float, columns: int) -> NDArray:
    """Indices of the times to draw from `start` to `end` with a resolution of `columns`.

    Of the times that fall into one column of pixels the first is kept, so that a fast event
    stays a step at its true time. One time beyond either end is kept, to fill the panel.

    Parameters
    ----------
    time : array
        Increasing times.
    start, end : float
        The interval that is drawn, in the unit of `time`.
    columns : int
        Number of columns of pixels across the interval.

    Returns
    -------
    array of int
    """
    first = max(int(np.searchsorted(time, start, side="right")) - 1, 0)
    last = min(int(np.searchsorted(time, end, side="left")) + 1, time.size)
    column = np.floor((time[first:last] - start) / (end - start) * columns)
    return first + np.flatnonzero(np.diff(column, prepend=-np.inf) > 0.0)


def draw(
    axes: Axes, field: xr.DataArray, norm: Normalize, *, origin: float = 0.0, scale: float = 1.0
) -> QuadMesh:
    """Draw a field over time (across) and x (upwards) as an image with true time cells.

    Parameters
    ----------
    axes : Axes
        The panel.
    field : DataArray
        On dimensions ``time`` (s) and ``x`` (m).
    norm : Normalize
        Colour scale.
    origin, scale : float
        The panel's time axis shows ``(time - origin) * scale``.

    Returns
    -------
    QuadMesh
        Drawn as pixels also in vector formats, which keeps them small.
    """
    return axes.pcolormesh(
        (cell_edges(field["time"].values) - origin) * scale,
        cell_edges(field["x"].values),
        field.transpose("x", "time").values,
        norm=norm,
        rasterized=True,
    )
