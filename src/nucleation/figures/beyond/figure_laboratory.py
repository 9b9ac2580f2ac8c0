"""Laboratory faults: their length, the nucleation length observed and what the theory says."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style
from ...types import Array


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw a row for each fault of which a length was read; open where numbers were assumed.

    Parameters
    ----------
    table : Dataset
        Of :func:`nucleation.analysis.laboratory.laboratory_table`.

    Returns
    -------
    Figure
        Two columns wide.
    """
    lengths = ["fault_length", "observed_low", "theory_length"]
    known = np.isfinite([table[name].values for name in lengths]).any(axis=0)
    shown = table.isel(run=np.flatnonzero(known))
    rows = np.arange(shown.sizes["run"])
    figure = style.new_figure(style.DOUBLE_COLUMN, (2.2 + 0.55 * rows.size) * style.CENTIMETRE)
    axes = figure.add_subplot()
    axes.plot(shown["fault_length"], rows, "|", color=style.BLACK, markersize=11.0, label="fault")
    assumed = shown["assumed"].values.astype(str) != ""
    for of, face, label in ((~assumed, style.BLUE, ""), (assumed, "white", " of assumed numbers")):
        theory = shown["creep_length"].values[of], shown["theory_length"].values[of]
        _draw_ends(axes, rows[of], theory, style.BLUE, face, f"$L_s$, $L_c${label}")
    observed = shown["observed_low"].values, shown["observed_high"].values
    _draw_ends(axes, rows, observed, style.VERMILLION, style.VERMILLION, "observed")
    axes.set_xscale("log")
    axes.set_yticks(rows, shown["title"].values.astype(str))
    axes.set_ylim(rows.size - 0.5, -0.5)
    axes.set_xlabel("Length (m)")
    figure.legend(loc="outside lower center", ncols=4)
    return figure


def _draw_ends(
    axes: Axes, rows: np.ndarray, ends: tuple[Array, Array], colour: str, face: str, label: str
) -> None:
    """Both ends of ranges (m) and a line between them, nothing if all are unknown."""
    if np.isfinite(ends).any():
        axes.hlines(rows, *ends, color=colour)
        axes.plot(
            np.ravel(ends), np.tile(rows, 2), "o", color=colour, markerfacecolor=face, label=label
        )
