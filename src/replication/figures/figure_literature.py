"""The literature's lengths: simulated in their own settings, over their formulas."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.lengths.formulas import CRACK_LIMIT, LOCALISED_LIMIT
from nucleation.pictures import style

from . import laws

KINDS = {
    "rubin_ampuero_localised": ("fixed length", "o", style.VERMILLION),
    "rubin_ampuero_crack": ("expanding", "s", style.BLUE),
    "thin_layer": ("thin layer", "^", style.GREEN),
    "state_evolution": (r"slip law, over $L_b$", "D", style.BLACK),
}
"""Label, marker and colour of each simulated length."""

_SHOWN_AT = 1e3  # m/s, in the panel over a/b: nearest to the asymptotes
_TICKS = (0.1, 0.2, 0.5, 1.0, 2.0)


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw simulated lengths over formulas (a) against a/b and (b) against the slip rate."""
    figure, (left, right) = style.panels(
        1,
        2,
        7.6,
        sharey=True,
    )
    table = laws.where(table, np.isfinite(table["simulated_length"]))
    for name, (label, marker, colour) in KINDS.items():
        rows = laws.where(table, name=name)
        at = laws.where(rows, np.isclose(rows["read_at"], _SHOWN_AT))
        look: style.Options = {"marker": marker, "color": colour, "mfc": "none"}
        left.plot(
            at["a_over_b"],
            at["difference"] + 1.0,
            linestyle="none",
            label=label,
            **look,
        )
        _draw_growth(right, rows, look)
    left.axvspan(LOCALISED_LIMIT, CRACK_LIMIT, color="0.9", lw=0, label="neither formula holds")
    left.set(xlabel="$a/b$", ylabel="Simulated length / formula", xlim=(0.0, 1.0))
    left.set_title(f"(a) read at {_SHOWN_AT:g} m/s")
    right.set(xscale="log", xlabel="Largest slip rate (m/s)")
    right.set_title("(b) as slip accelerates; labels: $a/b$")
    right.set_xlim(right=5e4)  # with room for the labels
    for axes in (left, right):
        axes.set_yscale("log")
        style.level(axes, 1.0)
    left.set_yticks(_TICKS, [f"{tick:g}" for tick in _TICKS])
    left.minorticks_off()
    left.legend(loc="center left")
    return figure


def _draw_growth(axes: Axes, rows: xr.Dataset, look: style.Options) -> None:
    """One line for each a/b, of its first run; dashed: the formula at that slip rate."""
    rows = rows.assign(ratio=rows["a_over_b"].round(6)).sortby("ratio")
    for same in laws.groups(rows, "ratio"):
        first = next(laws.groups(same, "id"))
        x = first["read_at"].values
        y = first["difference"].values + 1.0
        axes.plot(x, y, **look)
        at_this_rate = first["finite_speed_length"].values / first["formula_length"].values
        axes.plot(
            x,
            at_this_rate,
            color=look["color"],
            linestyle="--",
            lw=0.8,
        )
        if abs(y[-1] - 1.0) > 0.12:  # near 1 the lines coincide
            ratio = float(same["ratio"][0])
            place = "bottom" if ratio < 0.5 else "top"
            style.note(
                axes,
                f"{ratio:.2g}",
                (x[-1], y[-1]),
                (5, 0),
                va=place,
                color=look["color"],
            )
