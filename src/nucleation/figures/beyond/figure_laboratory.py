"""Laboratory faults: their length, the nucleation length observed and what the theory says."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from ...figures import style


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
    lengths = ["fault_length", "observed_low", "critical_length"]
    known = np.isfinite([table[name].values for name in lengths]).any(axis=0)
    shown = table.isel(run=np.flatnonzero(known))
    rows = np.arange(shown.sizes["run"])
    figure = style.new_figure(style.DOUBLE_COLUMN, (2.2 + 0.55 * rows.size) * style.CENTIMETRE)
    axes = figure.add_subplot()
    axes.plot(shown["fault_length"], rows, "|", color=style.BLACK, markersize=11.0, label="fault")
    assumed = shown["assumed"].values.astype(str) != ""
    for low, high, colour, label, face, of in (
        ("stability_length", "critical_length", style.BLUE, "$L_s$, $L_c$", None, ~assumed),
        (
            "stability_length",
            "critical_length",
            style.BLUE,
            "$L_s$, $L_c$, of\nassumed numbers",
            "w",
            assumed,
        ),
        ("observed_low", "observed_high", style.VERMILLION, "observed", None, rows >= 0),
    ):
        ends = shown[low].values[of], shown[high].values[of]
        if not np.isfinite(ends).any():
            continue
        axes.hlines(rows[of], *ends, color=colour)
        points = {"color": colour, "markerfacecolor": face or colour}
        axes.plot(np.ravel(ends), np.tile(rows[of], 2), "o", label=label, **points)
    axes.set_xscale("log")
    axes.set_yticks(rows, shown["title"].values.astype(str))
    axes.set_ylim(rows.size - 0.5, -0.5)
    axes.set_xlabel("Length (m)")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure
