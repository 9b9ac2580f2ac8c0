"""Laboratory faults: their length, the nucleation length observed and what the theory says."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from ...figures import style


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw a row for each fault of which a length was read; open where numbers were assumed.

    `table` is that of :func:`nucleation.analysis.laboratory.laboratory_table`.
    """
    lengths = ["fault_length", "observed_low", "theory_length"]
    known = np.isfinite([table[name].values for name in lengths]).any(axis=0)
    shown = table.isel(run=np.flatnonzero(known))
    rows = np.arange(shown.sizes["run"])
    figure, axes = style.panels(1, 1, 2.2 + 0.55 * rows.size)
    axes.plot(shown["fault_length"], rows, "|", color=style.BLACK, markersize=11.0, label="fault")
    assumed = shown["assumed"].values.astype(str) != ""
    theory, observed = ("creep_length", "theory_length"), ("observed_low", "observed_high")
    for of, names, colour, face, label in (
        (~assumed, theory, style.BLUE, style.BLUE, "$L_s$, $L_c$"),
        (assumed, theory, style.BLUE, "white", "$L_s$, $L_c$ of assumed numbers"),
        (rows >= 0, observed, style.VERMILLION, style.VERMILLION, "observed"),
    ):
        ends = [shown[name].values[of] for name in names]
        if np.isfinite(ends).any():
            axes.hlines(rows[of], *ends, color=colour)
            both = np.ravel(ends), np.tile(rows[of], 2)
            axes.plot(*both, "o", color=colour, markerfacecolor=face, label=label)
    axes.set(xscale="log", xlabel="Length (m)", ylim=(rows.size - 0.5, -0.5))
    axes.set_yticks(rows, shown["title"].values.astype(str))
    figure.legend(loc="outside lower center", ncols=4)
    return figure
