"""Lengths over the weakening of friction: over zeta/a, and over height and zeta/a."""

import numpy as np
import xarray as xr
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from nucleation.pictures import style
from nucleation.types import Array

from . import laws

_LINES = {
    "curve_stability": (r"$L_s$: the patch turns unstable", style.STABILITY, "-"),
    "curve_runaway": (
        r"$L_{\mathrm{run}}$: slow slip has no end but an event",
        style.VERMILLION,
        "-.",
    ),
    "curve_law": ("law of the drop, median", style.GUIDE, "--"),
}
"""Label, colour and dashes of each length by theory."""

_SIMULATED = "simulated drop: mean and range of realisations"
_BASES = {"rigid": "rigid base", "deformable": "identical blocks"}
_FEWEST = 3  # zeta/a of a base and height for a panel


@style.styled()
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths over L_c against zeta/a, one panel for each base and height."""
    systems = []
    for system in laws.groups(table, "study", "below", "height"):
        if np.unique(system["zeta_over_a"]).size >= _FEWEST:
            systems.append(system)
    figure, panels = style.panels(7.5, columns=len(systems), squeeze=False)
    for axes, letter, system in zip(panels.flat, "abcdefgh", systems, strict=False):
        same = np.ones(table.sizes["system"], dtype=bool)
        for name in ("study", "below", "height"):
            same &= table[f"curve_{name}"].values == system[name].values[0]
        curves = table.isel(system=np.flatnonzero(same)[0])
        for name, (label, colour, dashes) in _LINES.items():
            axes.plot(curves["curve_ratio"], curves[name], dashes, color=colour, label=label)
        axes.axhline(0.5, lw=0.7, label="half of $L_c$")
        for fault in laws.groups(system, "zeta_over_a"):
            simulated = (fault["length"] / fault["critical_length"]).values
            dropped = simulated[np.isfinite(simulated)]
            if dropped.size:
                at = fault["zeta_over_a"].values[0]
                laws.draw_range(axes, at, dropped, color=style.BLACK, marker="o")
        height = f"$H$ = {float(system['height'][0]):g} m"
        text = f"{_BASES[str(system['below'].values[0])]}, {height}"
        if curves["curve_half_spaces"]:
            text = f"half-spaces (runs: {height})"
        axes.set(title=f"({letter}) {text}", xlabel=r"Weakening $\zeta/a$", xlim=(0.18, 7.0))
        axes.set(xscale="log", yscale="log", ylim=(0.4, 3.5))
        style.plain_numbers(axes.xaxis)
        style.plain_numbers(axes.yaxis)
    axes.plot([], [], "o", color=style.BLACK, label=_SIMULATED)
    panels[0, 0].set_ylabel("Length over theory $L/L_c$")
    style.legend(figure, axes, loc="outside upper center", ncols=2)
    return figure


_STEPS = (0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.9, 1.0)  # of the colours
_NOTHING = "#D9D9D9"


@style.styled()
def draw_map(grid: xr.Dataset) -> Figure:
    """Draw ratios of lengths over height and weakening.

    They are of stability, and of the drop at the weakest and the strongest perturbation.
    """
    figure, panels = style.panels(6.4, columns=3, sharey=True)
    stability = grid["stability_ratio"].mean("seed", skipna=False).isel(strength=0)
    drop = grid["length_ratio"].mean("seed", skipna=False)
    shown = [(r"(a) patch turns unstable, $L_s/L_c$", stability)]
    for letter, i in (("b", 0), ("c", -1)):
        exponent = np.log10(grid["strength"].values[i])
        title = rf"({letter}) drop, load $10^{{{exponent:.0f}}}$, $L/L_c$"
        shown.append((title, drop.isel(strength=i)))
    norm = BoundaryNorm(_STEPS, 256, extend="both")
    for axes, (title, ratio) in zip(panels, shown, strict=True):
        x, y = _edges(ratio["height"].values), _edges(ratio["zeta_over_a"].values)
        values = ratio.transpose("zeta_over_a", "height")
        image = axes.pcolormesh(x, y, values, norm=norm, rasterized=True)
        axes.set(facecolor=_NOTHING, xscale="log", yscale="log", title=title)
        axes.set_xlabel("Block height $H$ (m)")
        style.plain_numbers(axes.yaxis, (1.5, 2.0, 3.0, 4.0, 6.0))
        axes.tick_params(which="both", direction="out", top=False, right=False)
    panels[0].set_ylabel(r"Weakening $\zeta/a$")
    figure.colorbar(image, ax=panels, label="Length over theory")
    return figure


def _edges(values: Array) -> Array:
    """Edges of cells around values, half way between them on a logarithmic axis."""
    if values.size == 1:
        return np.array([0.9, 1.1]) * values
    middle = np.sqrt(values[1:] * values[:-1])
    return np.r_[values[0] ** 2 / middle[0], middle, values[-1] ** 2 / middle[-1]]
