"""Where the force drops under a declared perturbation: simulations, and the law beside them."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.model.friction import USUAL_EVOLUTION
from nucleation.pictures import style

from . import laws

# the fault in the panels over the strength; height in m
_SHOWN: dict[str, str | float] = {"evolution": USUAL_EVOLUTION, "height": 0.02}
_KINDS = {
    "normal_load": ("o", style.VERMILLION, "load"),
    "state": ("s", style.SKY_BLUE, "state"),
    "drive_velocity": ("^", style.PURPLE, "drive"),
    "strength": ("D", style.BLACK, "roughness"),
}
_STRENGTH: style.Options = {
    "xscale": "log",
    "xlim": (3e-13, 3e-1),
    "xlabel": r"Relative strength $\epsilon$",
}
ENSEMBLE = ("fault", "kind", "correlation_length", "strength", "n_x", "longest_step")
_GOAL = 0.03  # relative error of the law's mean
# factors that separate kinds of the same strength
_ASIDE = {"normal_load": 0.65, "state": 1.3, "strength": 2.2}


@style.styled()
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths at the drop against strength, and the law beside them."""
    figure, (load, state, ratio) = style.panels(8.0, columns=3)
    style.letters(load, state, ratio)
    _draw_strengths(load, table, "normal_load")
    _draw_strengths(state, table, "state")
    load.set_ylabel("Length over theory $L/L_c$")
    _draw_ratios(ratio, ensembles(table))
    above: style.Options = {"loc": "outside upper center", "ncols": 4}
    style.legend(figure, load, state, title="(a, b)", fontsize=style.SMALL, **above)
    return figure


def ensembles(table: xr.Dataset) -> list[xr.Dataset]:
    """The realisations with a drop, by fault, kind and strength."""
    dropped = np.isfinite(table["length"].values) & (table["kind"].values != "none")
    return list(laws.groups(laws.where(table, dropped), *ENSEMBLE))


def _draw_strengths(axes: Axes, table: xr.Dataset, kind: str) -> None:
    """One kind of perturbation of the shown fault, or else of the first in the table."""
    runs = laws.where(table, **_SHOWN)
    if not runs.sizes["run"]:
        runs = laws.where(table, **{name: table[name].values[0] for name in _SHOWN})
    fault = laws.where(runs, fault=runs["fault"].values[0])  # of one material
    own = laws.where(fault, kind=kind)
    marker, colour, label = _KINDS[kind]
    theory = float(fault["critical_length"].values[0])
    if own.sizes["run"]:
        _draw_law(axes, table, own, theory)
    look: style.Options = {"marker": marker, "color": colour, "mfc": "white", "elinewidth": 0.9}
    for same in ensembles(own):
        simulated = same["length"].values / theory
        laws.draw_range(axes, same["strength"].values[0], simulated, **look)
    axes.plot([], [], marker, color=colour, mfc="white", label=f"{label}: mean and range")
    stability = fault["stability_length"].values[0] / theory
    axes.axhline(stability, ls=":", lw=1.0, color=style.STABILITY, label="unstable patch, $L_s$")
    axes.set_title(f"fluctuating {label}", loc="center")
    axes.set(ylim=(0.45, 0.87), **_STRENGTH)


def _draw_law(axes: Axes, table: xr.Dataset, own: xr.Dataset, theory: float) -> None:
    """The law's median and range, and its closed form, up to the strongest of some runs."""
    same_fault = table["curve_fault"].values == own["fault"].values[0]
    same_kind = table["curve_kind"].values == own["kind"].values[0]
    cases = np.flatnonzero(same_fault & same_kind)
    if cases.size:
        strongest = own["strength"].values[np.isfinite(own["law_length"].values)].max()
        known = np.flatnonzero(table["curve_strength"].values <= 1.01 * strongest)
        law = table.isel(case=cases[0], curve=known)
        strength = law["curve_strength"]
        low, high = law["curve_low"] / theory, law["curve_high"] / theory
        axes.fill_between(strength, low, high, alpha=0.35, lw=0.0, label="law: 16 to 84 %")
        median, closed = law["curve_length"] / theory, law["curve_closed_form"] / theory
        axes.plot(strength, median, color=style.THEORY, label="law: median")
        axes.plot(strength, closed, "--", color=style.THEORY, lw=0.9, label="law in one line")


def _draw_ratios(axes: Axes, found: list[xr.Dataset]) -> None:
    """Simulated mean over the law's median, for every fault and kind; open: the slip law."""
    for runs in found:
        first = runs.isel(run=0)
        kind = str(first["kind"].values)
        marker, colour, label = _KINDS[kind]
        ratio = float(runs["length"].mean() / first["law_length"])
        strength = _ASIDE.get(kind, 1.0) * float(first["strength"])
        face = colour if first["evolution"] == USUAL_EVOLUTION else "white"
        axes.plot(strength, ratio, marker, color=colour, alpha=0.8, mfc=face, label=label)
    axes.plot([], [], "o", mfc="white", label="open: slip law")
    close = f"within {100 * _GOAL:g} %"
    axes.axhspan(1.0 - _GOAL, 1.0 + _GOAL, color=style.GUIDE, alpha=0.15, lw=0.0, label=close)
    axes.set(ylabel="Simulated mean over the law", **_STRENGTH)
    style.legend(axes, axes, loc="upper left", **style.BOXED)
