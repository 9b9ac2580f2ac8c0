"""Where the force drops under a declared perturbation: simulations, the law, meshes' own noise."""

from collections.abc import Iterator

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style
from ...model.friction.registry import USUAL_EVOLUTION

SHOWN = (USUAL_EVOLUTION, 0.02)  # law and height (m) of the panels over the strength
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
FEWEST = 8  # realisations of which a distribution is shown
GOAL = 0.03  # of the law's mean
CLOSE = 30.0  # strengths whose ratio is less have one label
ROOM = 0.6  # of the panel of distributions, for its legend
ASIDE = {"normal_load": 0.75, "state": 1.33, "drive_velocity": 1.0, "strength": 1.0}
"""Factors by which kinds of the same strength are drawn apart."""


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths at the drop against strength, and the law beside them.

    Parameters
    ----------
    table : Dataset
        Of :func:`nucleation.patch.drop_table.gather`.

    Returns
    -------
    Figure
        Two columns wide.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 13.0 * style.CENTIMETRE)
    (load, state), (ratio, spread) = figure.subplots(2, 2)
    for axes, kind in ((load, "normal_load"), (state, "state")):
        _draw_strengths(axes, table, kind)
    load.set_ylabel("Length over theory $L/L_c$")
    _draw_ratios(ratio, table)
    _draw_distributions(spread, table)
    style.letters(load, state, ratio, spread)
    entries = {
        h[1]: h[0]
        for axes in (load, state)
        for h in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    entries[MEAN] = style.key(MEAN, "o", "-", **style.OPEN)
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


def _where(table: xr.Dataset, **labels: object) -> xr.Dataset:
    found = np.ones(table.sizes["run"], dtype=bool)
    for name, value in labels.items():
        found &= table[name].values == value
    return table.isel(run=np.flatnonzero(found))


def groups(table: xr.Dataset) -> Iterator[xr.Dataset]:
    """The realisations of each fault, kind and strength that have dropped."""
    names = ("fault", "kind", "correlation_length", "strength", "n_x", "longest_step")
    table = table.isel(
        run=np.flatnonzero((table["kind"].values != "none") & np.isfinite(table["length"].values))
    )
    keys = list(zip(*(table[name].values.tolist() for name in names), strict=True))
    for key in dict.fromkeys(keys):
        yield table.isel(run=[i for i, own in enumerate(keys) if own == key])


def _draw_strengths(axes: Axes, table: xr.Dataset, kind: str) -> None:
    """One kind of forcing on the shown fault."""
    law, height = SHOWN
    fault = _where(table, evolution=law, height=height)
    if not fault.sizes["run"]:  # a configuration without it: the fault it has
        fault = _where(
            table, evolution=table["evolution"].values[0], height=table["height"].values[0]
        )
    fault = _where(fault, fault=fault["fault"].values[0])  # of one material, if there are several
    own = _where(fault, kind=kind)
    marker, colour, label = KINDS[kind]
    theory = float(fault["theory_length"].values[0])
    if own.sizes["run"]:
        order = np.argsort(own["strength"].values)
        strength = own["strength"].values[order]
        low, middle, high, line = (
            own[name].values[order] / theory for name in (*PREDICTED, "closed_form_length")
        )
        axes.fill_between(strength, low, high, color=style.GUIDE, alpha=0.35, linewidth=0.0)
        axes.plot(strength, middle, color=style.THEORY, label="law: median, 16 to 84 %")
        axes.plot(strength, line, "--", color=style.THEORY, linewidth=0.9, label="law in one line")
        axes.plot(
            own["strength"].values, own["length"].values / theory, ".", color=colour, alpha=0.35,
            markersize=3.0, markeredgewidth=0.0,
        )  # fmt: skip
    for runs in groups(own):
        lengths = runs["length"].values / theory
        mean = lengths.mean()
        bars = [[mean - lengths.min()], [lengths.max() - mean]]
        axes.errorbar(
            runs["strength"].values[0], mean, yerr=bars, linestyle="none", marker=marker,
            markersize=4.0, color=colour, markerfacecolor="white", elinewidth=0.9,
        )  # fmt: skip
    _draw_floors(axes, fault, kind, theory)
    axes.axhline(float(fault["stability_length"].values[0]) / theory, color=style.GUIDE,
                 linestyle=":", linewidth=1.0, label="patch turns unstable, $L_s$")  # fmt: skip
    axes.set_title(f"fluctuating {label}")
    axes.set_xscale("log")
    axes.set_xlim(*STRENGTHS)
    axes.set_ylim(*RATIOS)
    axes.set_xlabel(r"Relative strength $\epsilon$")


def _draw_floors(axes: Axes, fault: xr.Dataset, kind: str, theory: float) -> None:
    """Where quiet runs drop, at the strength that would make the law's median drop there."""
    quiet = _where(fault, kind="none")
    found: list[tuple[float, float, int]] = sorted(
        (float(strength), float(length) / theory, int(n_x))
        for strength, length, n_x in zip(
            quiet[f"floor_{kind}"].values, quiet["length"].values, quiet["n_x"].values, strict=True
        )
        if 2.0 * STRENGTHS[0] < strength < STRENGTHS[1]
    )
    axes.plot(
        [one[0] for one in found], [one[1] for one in found], "x", color=style.BLACK,
        markersize=4.0, markeredgewidth=0.8, label="nothing perturbed, with its elements along $x$",
    )  # fmt: skip
    while found:
        strength = found[0][0]
        close = [one for one in found if one[0] < CLOSE * strength]  # with one label
        axes.annotate(
            ", ".join(str(n_x) for n_x in sorted({one[2] for one in close})), close[-1][:2],
            xytext=(4, 3), textcoords="offset points", fontsize=style.SMALL,
        )  # fmt: skip
        found = found[len(close) :]


def _draw_ratios(axes: Axes, table: xr.Dataset) -> None:
    """Simulated mean over the law's median, for every fault and kind."""
    seen: set[str] = set()
    for runs in groups(table):
        kind = str(runs["kind"].values[0])
        marker, colour, label = KINDS[kind]
        filled = runs["evolution"].values[0] == USUAL_EVOLUTION
        axes.plot(
            ASIDE[kind] * runs["strength"].values[0],
            runs["length"].values.mean() / runs["predicted_length"].values[0],
            marker, color=colour, markersize=4.0, alpha=0.8,
            markerfacecolor=colour if filled else "white",
            label=label if kind not in seen else None,
        )  # fmt: skip
        seen.add(kind)
    if (table["evolution"].values == "slip").any():
        axes.plot(
            [], [], "o", color=style.GUIDE, markersize=4.0, label="open: slip law", **style.OPEN
        )
    axes.axhspan(
        1.0 - GOAL,
        1.0 + GOAL,
        color=style.GUIDE,
        alpha=0.25,
        linewidth=0.0,
        label=f"within {100 * GOAL:g} %",
    )
    axes.set_xscale("log")
    axes.set_xlim(*STRENGTHS)
    axes.set_xlabel(r"Relative strength $\epsilon$")
    axes.set_ylabel("Simulated mean over the law")
    axes.legend(loc="upper left", **style.BOXED)


def _draw_distributions(axes: Axes, table: xr.Dataset) -> None:
    """Parts of the realisations that have dropped by a length, and the law's Rayleigh one."""
    for runs in groups(table):
        if runs.sizes["run"] < FEWEST:
            continue
        kind, strength = str(runs["kind"].values[0]), float(runs["strength"].values[0])
        _, colour, label = KINDS[kind]
        theory = float(runs["theory_length"].values[0])
        dashes = "-" if strength < 1e-4 else "--"
        lengths = np.sort(runs["length"].values) / theory
        parts = (np.arange(lengths.size) + 0.5) / lengths.size
        axes.step(
            lengths, parts, where="mid", color=colour, linestyle=dashes, linewidth=1.1,
            label=rf"{label}, $10^{{{np.log10(strength):.0f}}}$",
        )  # fmt: skip
        points = [float(runs[name].values[0]) / theory for name in PREDICTED]
        axes.plot(points, [0.16, 0.5, 0.84], "o", color=colour, markersize=3.5,
                  markerfacecolor="white")  # fmt: skip
    axes.set_ylim(0.0, 1.0)
    axes.set_xlabel("Length over theory $L/L_c$")
    axes.set_ylabel("Part that has dropped")
    if axes.get_legend_handles_labels()[0]:
        axes.plot(
            [], [], "o", color=style.GUIDE, markersize=3.5, label="law: 16, 50, 84 %", **style.OPEN
        )
        low, high = axes.get_xlim()
        axes.set_xlim(low - ROOM * (high - low), high)  # for the legend
        axes.legend(loc="upper left", **style.BOXED)
