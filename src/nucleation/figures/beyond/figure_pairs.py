"""Two deformable bodies: lengths of the patch against height, and over the theory of each run."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...answers.formulas import FINITE_PATCH
from ...figures import laws, style
from ...patch.tables.pairs import over_realisations

SIDES = (
    ("free", "o", style.VERMILLION),
    ("clamped", "s", style.BLUE),
    ("roller", "^", style.GREEN),
)
"""Far sides of the second body with their markers."""

HALF_SPACES = (
    (1.0, "--", r"half-spaces, $\eta=\pi/(1-\nu)$"),
    (0.5, ":", "half of it"),
    (FINITE_PATCH / np.pi, "-.", "finite patch in creep, 0.37 of it"),
)
"""Part of the half-spaces' length, line and name."""


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw (a) the lengths of identical blocks and (b) all pairs' over the theory's.

    `table` is that of :func:`nucleation.patch.tables.pairs.gather_pairs`.
    """
    figure, (left, right) = style.panels(1, 2, 7.4)
    table = over_realisations(table)
    table = laws.where(table, n_x=np.median(table["n_x"]))  # the finer mesh is a check
    _draw_heights(left, laws.where(table, role="pairs_identical").sortby("height"))
    weakening = table["zeta_over_a"].values / np.median(table["zeta_over_a"])
    _draw_ratios(right, laws.where(table, np.abs(weakening - 1.0) < 0.1))
    return figure


def _draw_heights(axes: Axes, rows: xr.Dataset) -> None:
    height, theory = rows["height"].values, rows["theory_length"].values
    axes.plot(height, theory, color=style.THEORY, label="theory $L_c$, free far sides")
    axes.plot(height, rows["length"].values, "o", color=style.VERMILLION, label="at the drop")
    low, high = (theory * rows[f"length_ratio_{end}"].values for end in ("low", "high"))
    axes.vlines(height, low, high, color=style.VERMILLION)
    look: Any = {"color": style.BLACK, "ms": 4.0, "mfc": "none"}
    stability = rows["stability_length"].values
    axes.plot(height, stability, "D", label="patch turns unstable, $L_s$", **look)
    for part, line, label in HALF_SPACES if height.size else ():
        style.level(axes, part * theory[-1], line, 0.8, label=label)
    axes.set(xscale="log", yscale="log", xlabel="Height of each block $H$ (m)", ylabel="Length (m)")
    axes.set_title("(a) identical blocks", loc="left")
    axes.legend(fontsize=style.SMALL, loc="lower right")


def _draw_ratios(axes: Axes, rows: xr.Dataset) -> None:
    for side, marker, colour in SIDES:
        own = laws.where(rows, far_side=side)
        thickness = own["second_height"].values / own["theory_length"].values
        look: Any = {"color": colour, "ms": 4.2}
        axes.plot(thickness, own["length_ratio"].values, marker, label=f"bottom {side}", **look)
        axes.plot(thickness, own["stability_ratio"].values, marker, mfc="none", **look)
        low, high = (own[f"length_ratio_{end}"].values for end in ("low", "high"))
        axes.vlines(thickness, low, high, color=colour, linewidth=0.9)
    style.level(axes, 0.5, ":", 0.8, label="half of it")
    style.level(axes, 1.0, "--", 0.8, label="theory")
    axes.set(xscale="log", ylim=(0.4, 1.1), xlabel="Second height over theory $H_2/L_c$")
    axes.set_ylabel("Length / theory for the same pair")
    axes.set_title("(b) all pairs: drop (filled), $L_s$ (open)", loc="left")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.85), **style.BOXED)
