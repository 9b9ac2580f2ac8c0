"""Where the force drops under a declared perturbation: simulations, the law, meshes' own noise."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

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
_STRENGTHS = (3e-13, 3e-1)
_RATIOS = (0.45, 0.87)
_LAW = "law: median, and 16 to 84 % (band)"
_BAND_ALPHA = 0.35
_MEAN = "simulated: mean and range of realisations"
_QUANTILES = {"law_low": 0.16, "law_length": 0.5, "law_high": 0.84}
ENSEMBLE = ("fault", "kind", "correlation_length", "strength", "n_x", "longest_step")
FEWEST = 8  # realisations for a distribution
_GOAL = 0.03  # relative error of the law's mean
_CLOSE = 30.0  # strengths with a smaller ratio share one label
_ROOM = 0.6  # part of the panel of distributions for its legend
# factors that separate kinds of the same strength
_ASIDE = {"normal_load": 0.65, "state": 1.3, "strength": 2.2}


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths at the drop against strength, and the law beside them."""
    figure, ((load, state), (ratio, spread)) = style.panels(
        2,
        2,
        13.0,
    )
    _draw_strengths(load, table, "normal_load")
    _draw_strengths(state, table, "state")
    load.set_ylabel("Length over theory $L/L_c$")
    found = ensembles(table)
    _draw_ratios(ratio, found)
    _draw_distributions(spread, found)
    style.letters(load, state, ratio, spread)
    entries: style.Options = dict(style.entries(load, state))
    if _LAW in entries:
        line = style.key("", "", "-", style.THEORY)
        entries[_LAW] = (
            Patch(
                color=style.GUIDE,
                alpha=_BAND_ALPHA,
                linewidth=0.0,
            ),
            line,
        )
    entries[_MEAN] = style.key(_MEAN, "o", "-", **style.OPEN)
    figure.legend(
        entries.values(),
        entries,
        loc="outside upper center",
        ncols=3,
        title="In (a, b)",
        fontsize=style.SMALL,
        title_fontsize=style.SMALL,
    )
    return figure


def ensembles(table: xr.Dataset) -> list[xr.Dataset]:
    """The realisations with a drop, by fault, kind and strength."""
    dropped = np.isfinite(table["length"].values) & (table["kind"].values != "none")
    return list(laws.groups(laws.where(table, dropped), *ENSEMBLE))


def _draw_strengths(axes: Axes, table: xr.Dataset, kind: str) -> None:
    """One kind of perturbation of the shown fault."""
    fault = _shown_fault(table)
    own = laws.where(fault, kind=kind).sortby("strength")
    marker, colour, label = _KINDS[kind]
    theory = float(fault["critical_length"].values[0])
    if own.sizes["run"]:
        _draw_law(axes, table, own, theory)
        ratio = own["length"] / theory
        axes.plot(
            own["strength"],
            ratio,
            ".",
            color=colour,
            alpha=0.35,
            ms=3.0,
            mew=0.0,
        )
    look: style.Options = {"marker": marker, "ms": 4.0, "color": colour, **style.OPEN}
    for runs in ensembles(own):
        lengths = runs["length"].values / theory
        laws.draw_range(
            axes,
            runs["strength"].values[0],
            lengths,
            elinewidth=0.9,
            **look,
        )
    _draw_floors(axes, fault, f"floor_{kind}", theory)
    stability = fault["stability_length"].values[0] / theory
    unstable: style.Options = {"color": style.STABILITY, "label": "patch turns unstable, $L_s$"}
    style.level(axes, stability, ":", 1.0, **unstable)
    axes.set_title(f"fluctuating {label}", loc="center")
    axes.set(xscale="log", xlim=_STRENGTHS, ylim=_RATIOS, xlabel=r"Relative strength $\epsilon$")


def _shown_fault(table: xr.Dataset) -> xr.Dataset:
    """The runs of one fault: the shown one, or else the first in the table."""
    runs = laws.where(table, **_SHOWN)
    if not runs.sizes["run"]:
        runs = laws.where(table, **{name: table[name].values[0] for name in _SHOWN})
    return laws.where(runs, fault=runs["fault"].values[0])  # of one material


def _draw_law(
    axes: Axes,
    table: xr.Dataset,
    own: xr.Dataset,
    theory: float,
) -> None:
    """The law's median and range, and its closed form, up to the strongest of some runs."""
    same_fault = table["curve_fault"].values == own["fault"].values[0]
    cases = np.flatnonzero(same_fault & (table["curve_kind"].values == own["kind"].values[0]))
    if not cases.size:
        return
    strongest = own["strength"].values[np.isfinite(own["law_length"].values)].max()
    known = np.flatnonzero(table["curve_strength"].values <= 1.01 * strongest)
    law = table.isel(case=cases[0], curve=known)
    strength = law["curve_strength"]
    ends = (law["curve_low"] / theory, law["curve_high"] / theory)
    axes.fill_between(
        strength,
        *ends,
        color=style.GUIDE,
        alpha=_BAND_ALPHA,
        linewidth=0.0,
    )
    axes.plot(
        strength,
        law["curve_length"] / theory,
        color=style.THEORY,
        label=_LAW,
    )
    axes.plot(
        strength,
        law["curve_closed_form"] / theory,
        "--",
        color=style.THEORY,
        linewidth=0.9,
        label="law in one line",
    )


def _draw_floors(
    axes: Axes,
    fault: xr.Dataset,
    floor: str,
    theory: float,
) -> None:
    """Quiet runs, each at the strength for which the law's median is its length."""
    quiet = laws.where(fault, kind="none").sortby([floor, "length", "n_x"])
    inside = (2.0 * _STRENGTHS[0] < quiet[floor]) & (quiet[floor] < _STRENGTHS[1])
    shown = laws.where(quiet, inside)
    strength = shown[floor].values
    ratio = shown["length"].values / theory
    elements = np.rint(shown["n_x"].values * theory / shown["block_length"].values).astype(int)
    label = "nothing perturbed, with its elements within $L_c$"
    axes.plot(
        strength,
        ratio,
        "x",
        label=label,
        color=style.BLACK,
        ms=4.0,
        mew=0.8,
    )
    first = 0
    while first < strength.size:  # close ones share one label
        end = int(np.searchsorted(strength, _CLOSE * strength[first]))
        names = ", ".join(map(str, np.unique(elements[first:end])))
        place = (strength[end - 1], ratio[end - 1])
        style.note(axes, names, place, (-4, -12))
        first = end


def _draw_ratios(axes: Axes, found: list[xr.Dataset]) -> None:
    """Simulated mean over the law's median, for every fault and kind."""
    evolutions = set()
    for runs in found:
        first = runs.isel(run=0)
        kind = str(first["kind"].values)
        evolution = str(first["evolution"].values)
        evolutions.add(evolution)
        marker, colour, label = _KINDS[kind]
        ratio = float(runs["length"].mean() / first["law_length"])
        strength = _ASIDE.get(kind, 1.0) * float(first["strength"])
        face = colour if evolution == USUAL_EVOLUTION else "white"
        look: style.Options = {"color": colour, "ms": 4.0, "alpha": 0.8, "mfc": face}
        axes.plot(strength, ratio, marker, label=label, **look)
    style.band(axes, 1.0 - _GOAL, 1.0 + _GOAL, f"within {100 * _GOAL:g} %")
    entries = style.entries(axes)
    if "slip" in evolutions:
        entries["open: slip law"] = style.key(
            "",
            "o",
            markersize=4.0,
            **style.OPEN,
        )
    axes.set(xscale="log", xlim=_STRENGTHS, xlabel=r"Relative strength $\epsilon$")
    axes.set_ylabel("Simulated mean over the law")
    axes.legend(entries.values(), entries, loc="upper left", **style.BOXED)


def _draw_distributions(axes: Axes, found: list[xr.Dataset]) -> None:
    """The part of the realisations with a drop below a length, and the law's Rayleigh one."""
    for runs in found:
        if runs.sizes["run"] < FEWEST:
            continue
        first = runs.isel(run=0)
        marker, colour, kind = _KINDS[str(first["kind"].values)]
        strength = float(first["strength"])
        label = rf"{kind}, $10^{{{np.log10(strength):.0f}}}$"
        dashes = "-" if strength < 1e-4 else "--"
        theory = float(first["critical_length"])
        lengths = np.sort(runs["length"].values) / theory
        parts = (np.arange(lengths.size) + 0.5) / lengths.size
        look: style.Options = {"where": "mid", "label": label, "linewidth": 1.1}
        axes.step(lengths, parts, dashes, color=colour, **look)
        law = [float(first[name]) / theory for name in _QUANTILES]
        axes.plot(
            law,
            [*_QUANTILES.values()],
            marker,
            color=colour,
            ms=3.5,
            **style.OPEN,
        )
    axes.set(ylim=(0.0, 1.0), xlabel="Length over theory $L/L_c$", ylabel="Part that has dropped")
    handles = axes.get_legend_handles_labels()[0]
    if handles:
        law_key = style.key("law: 16, 50, 84 %", "o", markersize=3.5, **style.OPEN)
        low, high = axes.get_xlim()
        axes.set_xlim(low - _ROOM * (high - low), high)  # for the legend
        axes.legend(
            handles=[*handles, law_key],
            loc="upper left",
            **style.BOXED,
        )
