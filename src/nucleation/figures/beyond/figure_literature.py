"""The literature's lengths: simulated in their own settings, over their formulas."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style

KINDS = {
    "rubin_ampuero_localised": ("fixed length", "o", style.VERMILLION),
    "rubin_ampuero_crack": ("expanding", "s", style.BLUE),
    "thin_layer": ("thin layer", "^", style.GREEN),
    "state_evolution": (r"slip law, over $L_b$", "D", style.BLACK),
}
"""Label, marker and colour of each simulated length."""

SHOWN_AT = 1e-2  # m/s, in the panel over a/b


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw simulated lengths over formulas (a) against a/b and (b) against the slip rate.

    Parameters
    ----------
    table : Dataset
        From :func:`nucleation.analysis.literature.literature_table`.

    Returns
    -------
    Figure
        Two columns wide, two panels.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 7.6 * style.CENTIMETRE)
    left, right = figure.subplots(1, 2, sharey=True)
    table = table.isel(run=np.flatnonzero(np.isfinite(table["simulated_length"].values)))
    for name, (label, marker, colour) in KINDS.items():
        rows = table.isel(run=np.flatnonzero(table["name"].values == name))
        at = rows.isel(run=np.flatnonzero(np.isclose(rows["read_at"].values, SHOWN_AT)))
        left.plot(
            at["a_over_b"], at["difference"] + 1.0, marker, color=colour, label=label,
            markerfacecolor="none",
        )  # fmt: skip
        _draw_growth(right, rows, marker, colour)
    left.set_xlabel("$a/b$")
    left.set_ylabel("Simulated length / formula")
    left.set_title(f"(a) read at {SHOWN_AT:g} m/s", loc="left")
    left.set_xlim(0.0, 1.0)
    right.set_xscale("log")
    right.set_xlabel("Largest slip rate (m/s)")
    right.set_title("(b) as slip accelerates; labels: $a/b$", loc="left")
    right.set_xlim(right=0.4)
    for axes in (left, right):
        axes.set_yscale("log")
        axes.axhline(1.0, color=style.GUIDE, linewidth=0.7)
    left.set_yticks([0.05, 0.1, 0.2, 0.5, 1.0, 2.0], ["0.05", "0.1", "0.2", "0.5", "1", "2"])
    left.minorticks_off()
    left.legend(loc="lower left")
    return figure


def _draw_growth(axes: Axes, rows: xr.Dataset, marker: str, colour: str) -> None:
    """One line for each a/b, of its first run."""
    for ratio in np.unique(rows["a_over_b"].values.round(6)):
        same = rows.isel(run=np.flatnonzero(np.isclose(rows["a_over_b"].values, ratio)))
        first = same.isel(run=np.flatnonzero(same["id"].values == same["id"].values[0]))
        x, y = first["read_at"].values, first["difference"].values + 1.0
        axes.plot(x, y, marker, color=colour, linestyle="-", markerfacecolor="none")
        if abs(y[-1] - 1.0) > 0.15:  # near 1 they lie on one another
            axes.annotate(
                f"{ratio:.2g}", (x[-1], y[-1]), (5, 0), textcoords="offset points", va="center",
                color=colour, fontsize=style.SMALL,
            )  # fmt: skip
