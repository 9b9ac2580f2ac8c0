"""Where the force drops under a declared perturbation: simulations, the law, meshes' own noise."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import laws, style
from ...model.friction.registry import USUAL_EVOLUTION

SHOWN: Any = {"evolution": USUAL_EVOLUTION, "height": 0.02}  # of the panels over the strength; m
KINDS = {
    "normal_load": ("o", style.VERMILLION, "load"),
    "state": ("s", style.BLUE, "state"),
    "drive_velocity": ("^", style.GREEN, "drive"),
    "strength": ("D", style.BLACK, "roughness"),
}
STRENGTHS = (3e-13, 3e-1)
RATIOS = (0.45, 0.87)
MEAN = "simulated: mean and range of realisations"
PREDICTED = ("predicted_low", "predicted_length", "predicted_high")
ENSEMBLE = ("fault", "kind", "correlation_length", "strength", "n_x", "longest_step")
FEWEST = 8  # realisations of which a distribution is shown
GOAL = 0.03  # of the law's mean
CLOSE = 30.0  # strengths whose ratio is less have one label
ROOM = 0.6  # of the panel of distributions, for its legend
ASIDE = {"normal_load": 0.75, "state": 1.33}  # factors by which kinds of one strength stand apart
SMALL: Any = {"fontsize": style.SMALL, "title_fontsize": style.SMALL}


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths at the drop against strength, and the law beside them.

    `table` is that of :func:`nucleation.patch.tables.drops.gather_drops`.
    """
    figure, ((load, state), (ratio, spread)) = style.panels(2, 2, 13.0)
    for axes, kind in ((load, "normal_load"), (state, "state")):
        _draw_strengths(axes, table, kind)
    load.set_ylabel("Length over theory $L/L_c$")
    _draw_ratios(ratio, ensembles(table))
    _draw_distributions(spread, ensembles(table))
    style.letters(load, state, ratio, spread)
    entries = style.entries(load, state)
    entries[MEAN] = style.key(MEAN, "o", "-", **style.OPEN)
    place: Any = {"loc": "outside upper center", "ncols": 3, "title": "In (a, b)"}
    figure.legend(entries.values(), entries, **place, **SMALL)
    return figure


def ensembles(table: xr.Dataset) -> list[xr.Dataset]:
    """The realisations of each fault, kind and strength that have dropped."""
    dropped = np.isfinite(table["length"].values) & (table["kind"].values != "none")
    return list(laws.groups(laws.where(table, dropped), *ENSEMBLE))


def _draw_strengths(axes: Axes, table: xr.Dataset, kind: str) -> None:
    """One kind of forcing on the shown fault."""
    fault = laws.where(table, **SHOWN)
    if not fault.sizes["run"]:  # a configuration without it: the fault it has
        fault = laws.where(table, **{name: table[name].values[0] for name in SHOWN})
    fault = laws.where(fault, fault=fault["fault"].values[0])  # of one material
    own = laws.where(fault, kind=kind).sortby("strength")
    marker, colour, label = KINDS[kind]
    theory = float(fault["theory_length"].values[0])
    ratio = own["length"].values / theory
    if own.sizes["run"]:
        strength = own["strength"].values
        low, middle, high = (own[name].values / theory for name in PREDICTED)
        axes.fill_between(strength, low, high, color=style.GUIDE, alpha=0.35, linewidth=0.0)
        axes.plot(strength, middle, color=style.THEORY, label="law: median, 16 to 84 %")
        line: Any = {"color": style.THEORY, "linewidth": 0.9, "label": "law in one line"}
        axes.plot(strength, own["closed_form_length"].values / theory, "--", **line)
        axes.plot(strength, ratio, ".", color=colour, alpha=0.35, ms=3.0, mew=0.0)
    for runs in ensembles(own):
        lengths = runs["length"].values / theory
        mean = lengths.mean()
        bars = [[mean - lengths.min()], [lengths.max() - mean]]
        look: Any = {"marker": marker, "ms": 4.0, "color": colour, "elinewidth": 0.9} | style.OPEN
        axes.errorbar(runs["strength"].values[0], mean, yerr=bars, linestyle="none", **look)
    _draw_floors(axes, fault, kind, theory)
    stability = float(fault["stability_length"].values[0]) / theory
    style.level(axes, stability, ":", 1.0, label="patch turns unstable, $L_s$")
    axes.set_title(f"fluctuating {label}")
    axes.set(xscale="log", xlim=STRENGTHS, ylim=RATIOS, xlabel=r"Relative strength $\epsilon$")


def _draw_floors(axes: Axes, fault: xr.Dataset, kind: str, theory: float) -> None:
    """Where quiet runs drop, at the strength that would make the law's median drop there."""
    quiet = laws.where(fault, kind="none").sortby([f"floor_{kind}", "length", "n_x"])
    strength = quiet[f"floor_{kind}"].values
    shown = laws.where(quiet, (2.0 * STRENGTHS[0] < strength) & (strength < STRENGTHS[1]))
    strength, ratio = shown[f"floor_{kind}"].values, shown["length"].values / theory
    elements = np.rint(shown["n_x"].values * theory / shown["block_length"].values).astype(int)
    look: Any = {"color": style.BLACK, "markersize": 4.0, "markeredgewidth": 0.8}
    label = "nothing perturbed, with its elements within $L_c$"
    axes.plot(strength, ratio, "x", label=label, **look)
    first = 0
    while first < strength.size:  # those that are close have one label
        end = int(np.searchsorted(strength, CLOSE * strength[first]))
        names = ", ".join(map(str, np.unique(elements[first:end])))
        place = strength[end - 1], ratio[end - 1]
        text: Any = {"textcoords": "offset points", "fontsize": style.SMALL}
        axes.annotate(names, place, (4, 3), **text)
        first = end


def _draw_ratios(axes: Axes, found: list[xr.Dataset]) -> None:
    """Simulated mean over the law's median, for every fault and kind."""
    other = False
    for runs in found:
        first = runs.isel(run=0)
        kind, usual = str(first["kind"].values), bool(first["evolution"] == USUAL_EVOLUTION)
        marker, colour, label = KINDS[kind]
        look: Any = {"color": colour, "ms": 4.0, "alpha": 0.8, "mfc": colour if usual else "white"}
        ratio = float(runs["length"].mean() / first["predicted_length"])
        strength = ASIDE.get(kind, 1.0) * float(first["strength"])
        axes.plot(strength, ratio, marker, label=label, **look)
        other = other or bool(first["evolution"] == "slip")
    style.band(axes, 1.0 - GOAL, 1.0 + GOAL, f"within {100 * GOAL:g} %")
    entries = style.entries(axes)
    if other:
        entries["open: slip law"] = style.key("", "o", markersize=4.0, **style.OPEN)
    axes.set(xscale="log", xlim=STRENGTHS, xlabel=r"Relative strength $\epsilon$")
    axes.set_ylabel("Simulated mean over the law")
    axes.legend(entries.values(), entries, loc="upper left", **style.BOXED)


def _draw_distributions(axes: Axes, found: list[xr.Dataset]) -> None:
    """Parts of the realisations that have dropped by a length, and the law's Rayleigh one."""
    for runs in found:
        if runs.sizes["run"] < FEWEST:
            continue
        first = runs.isel(run=0)
        _, colour, label = KINDS[str(first["kind"].values)]
        strength, theory = float(first["strength"]), float(first["theory_length"])
        lengths = np.sort(runs["length"].values) / theory
        parts = (np.arange(lengths.size) + 0.5) / lengths.size
        look: Any = {"linestyle": "-" if strength < 1e-4 else "--", "linewidth": 1.1}
        label = rf"{label}, $10^{{{np.log10(strength):.0f}}}$"
        axes.step(lengths, parts, where="mid", color=colour, label=label, **look)
        law = [float(first[name]) / theory for name in PREDICTED]
        axes.plot(law, [0.16, 0.5, 0.84], "o", color=colour, ms=3.5, **style.OPEN)
    axes.set_ylim(0.0, 1.0)
    axes.set_xlabel("Length over theory $L/L_c$")
    axes.set_ylabel("Part that has dropped")
    if handles := axes.get_legend_handles_labels()[0]:
        law_key = style.key("law: 16, 50, 84 %", "o", markersize=3.5, **style.OPEN)
        low, high = axes.get_xlim()
        axes.set_xlim(low - ROOM * (high - low), high)  # for the legend
        axes.legend(handles=[*handles, law_key], loc="upper left", **style.BOXED)
