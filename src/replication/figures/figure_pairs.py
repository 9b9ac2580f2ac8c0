"""Two deformable bodies: lengths of the patch against height, and over the theory of each pair."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from nucleation.lengths.formulas import FINITE_PATCH
from nucleation.pictures import style

from ..tables.ratios import pairs_over_realisations
from . import laws
from .figure_studies import Curves

_SIDES = (
    ("free", "o", style.VERMILLION),
    ("clamped", "s", style.BLUE),
    ("roller", "^", style.PURPLE),
)
"""Boundary conditions of the second body's far side, with marker and colour."""

_HALF_SPACES = (
    (1.0, "--", r"half-spaces, $\eta=\pi/(1-\nu)$"),
    (0.5, ":", "half of it"),
    (FINITE_PATCH / np.pi, "-.", "finite patch in creep, 0.37 of it"),
)
"""Part of the half-spaces' length, line and name."""

_THEORY = "theory $L_c$, free far sides"


@style.styled
def draw(table: xr.Dataset, theory: Curves) -> Figure:
    """Draw (a) lengths of identical blocks and (b) the lengths of all pairs over the theory's."""
    figure, (left, right) = style.panels(1, 2, 7.4)
    table = pairs_over_realisations(table)
    table = laws.where(table, n_x=np.median(table["n_x"]))  # the finer mesh is a check
    identical = laws.where(table, role="pairs_identical").sortby("height")
    _draw_heights(left, identical, theory)
    weakening = table["zeta_over_a"].values / np.median(table["zeta_over_a"])
    _draw_ratios(right, laws.where(table, np.abs(weakening - 1.0) < 0.1))
    return figure


def _draw_heights(axes: Axes, rows: xr.Dataset, curves: Curves) -> None:
    height = rows["height"].values
    theory = rows["critical_length"].values
    connected = {"": {"x": height, "length": theory}}
    for curve in (curves or connected).values():
        axes.plot(
            curve["x"],
            curve["length"],
            color=style.THEORY,
            label=_THEORY,
        )
    axes.plot(
        height,
        rows["length"],
        "o",
        color=style.VERMILLION,
        label="at the drop",
    )
    low = theory * rows["length_ratio_low"]
    high = theory * rows["length_ratio_high"]
    axes.vlines(height, low, high, color=style.VERMILLION)
    look: style.Options = {"color": style.STABILITY, "ms": 4.0, "mfc": "none"}
    label = "patch turns unstable, $L_s$"
    axes.plot(height, rows["stability_length"], "D", label=label, **look)
    if height.size:
        for part, line, label in _HALF_SPACES:
            style.level(
                axes,
                part * theory[-1],
                line,
                0.8,
                label=label,
            )
    axes.set(xscale="log", yscale="log", xlabel="Height of each block $H$ (m)", ylabel="Length (m)")
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    style.plain_numbers(axes.yaxis)
    axes.set_title("(a) identical blocks")
    axes.legend(fontsize=style.SMALL, loc="lower right")


def _draw_ratios(axes: Axes, rows: xr.Dataset) -> None:
    for side, marker, colour in _SIDES:
        own = laws.where(rows, far_side=side)
        thickness = own["second_height"] / own["critical_length"]
        look: style.Options = {"color": colour, "ms": 4.2}
        axes.plot(thickness, own["length_ratio"], marker, label=f"bottom {side}", **look)
        axes.plot(thickness, own["stability_ratio"], marker, mfc="none", **look)
        ends = (own["length_ratio_low"], own["length_ratio_high"])
        axes.vlines(thickness, *ends, color=colour, linewidth=0.9)
    style.level(
        axes,
        1.0,
        "-",
        1.2,
        color=style.THEORY,
        label="theory $L_c$",
    )
    style.level(
        axes,
        0.5,
        "--",
        1.2,
        color=style.THEORY,
        label="theory $L_c/2$",
    )
    axes.set(xscale="log", ylim=(0.4, 1.1), xlabel="Second height over theory $H_2/L_c$")
    axes.set_ylabel("Length / theory for the same pair")
    axes.set_title("(b) all pairs: drop (filled), $L_s$ (open)")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.85), **style.BOXED)
