"""Two deformable bodies: lengths of the patch against height, and over the theory of each run."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style
from ...patch.pairs import chosen, of_role, over_realisations
from ...theory.literature import FINITE_PATCH

ROLE = "pairs_identical"
SIDES = (
    ("free", "o", style.VERMILLION), ("clamped", "s", style.BLUE), ("roller", "^", style.GREEN),
)  # fmt: skip
"""Far sides of the second body with their markers."""


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw (a) the lengths of identical blocks and (b) all pairs' over the theory's.

    Parameters
    ----------
    table : Dataset
        From :func:`nucleation.patch.pairs.gather`.

    Returns
    -------
    Figure
        Two columns wide, two panels.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 7.4 * style.CENTIMETRE)
    left, right = figure.subplots(1, 2)
    table = over_realisations(table)
    coarse, weakening = _usual(table, "n_x"), _usual(table, "zeta_over_a")
    table = chosen(table, (table["n_x"] == coarse).values)  # the finer mesh is a check
    _draw_heights(left, of_role(table, ROLE).sortby("height"))
    _draw_ratios(right, chosen(table, np.abs(table["zeta_over_a"].values / weakening - 1) < 0.1))
    return figure


def _usual(table: xr.Dataset, name: str) -> float:
    """What most runs have."""
    return float(np.median(table[name]))


def _draw_heights(axes: Axes, rows: xr.Dataset) -> None:
    height, theory = rows["height"].values, rows["theory_length"].values
    axes.plot(height, theory, color=style.THEORY, label="theory $L_c$, free far sides")
    axes.plot(height, rows["length"].values, "o", color=style.VERMILLION, label="at the drop")
    axes.vlines(height, theory * rows["length_ratio_low"].values,
                theory * rows["length_ratio_high"].values, color=style.VERMILLION)  # fmt: skip
    axes.plot(
        height, rows["stability_length"].values, "D", color=style.BLACK, markersize=4.0,
        markerfacecolor="none", label="patch turns unstable, $L_s$",
    )  # fmt: skip
    if height.size:
        axes.axhline(
            theory[-1], color=style.GUIDE, linewidth=0.8, linestyle="--",
            label=r"half-spaces, $\eta=\pi/(1-\nu)$",
        )  # fmt: skip
        axes.axhline(0.5 * theory[-1], color=style.GUIDE, linewidth=0.8, linestyle=":",
                     label="half of it")  # fmt: skip
        axes.axhline(
            FINITE_PATCH / np.pi * theory[-1], color=style.GUIDE, linewidth=0.8, linestyle="-.",
            label="finite patch in creep, 0.37 of it",
        )  # fmt: skip
    axes.set(xscale="log", yscale="log", xlabel="Height of each block $H$ (m)", ylabel="Length (m)")
    axes.set_title("(a) identical blocks", loc="left")
    axes.legend(fontsize=style.SMALL, loc="lower right")


def _draw_ratios(axes: Axes, rows: xr.Dataset) -> None:
    thickness = rows["second_height"].values / rows["theory_length"].values
    for side, marker, colour in SIDES:
        of_side = rows["far_side"].values == side
        for name, filled in (("length_ratio", True), ("stability_ratio", False)):
            axes.plot(
                thickness[of_side], rows[name].values[of_side], marker, color=colour,
                markersize=4.2, markerfacecolor=colour if filled else "none",
                label=f"bottom {side}" if filled else None,
            )  # fmt: skip
        low, high = (rows[f"length_ratio_{end}"].values[of_side] for end in ("low", "high"))
        axes.vlines(thickness[of_side], low, high, color=colour, linewidth=0.9)
    axes.axhline(0.5, color=style.GUIDE, linewidth=0.8, linestyle=":", label="half of it")
    axes.axhline(1.0, color=style.GUIDE, linewidth=0.8, linestyle="--", label="theory")
    axes.set(
        xscale="log", ylim=(0.4, 1.1), xlabel="Second height over theory $H_2/L_c$",
        ylabel="Length / theory for the same pair",
    )  # fmt: skip
    axes.set_title("(b) all pairs: drop (filled), $L_s$ (open)", loc="left")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.85), **style.BOXED)
