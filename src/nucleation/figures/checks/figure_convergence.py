"""Refinement of mesh and steps, with a declared perturbation and without."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from ...figures import style
from ...model.friction.registry import USUAL_EVOLUTION

PERCENT = 100.0
GOALS = {"onset_difference": 0.3, "length_difference": 0.5}  # per cent
LABELS = {"onset_difference": "Onset apart (%)", "length_difference": "$L_c$ apart (%)"}
LEAST = 1e-3  # per cent: smaller differences are drawn there
KINDS = {
    "normal_load": "load",
    "drive_velocity": "drive",
    "state": "state",
    "strength": "roughness",
}
REFINED = {
    "n_x": "elements along $x$",
    "n_y": "elements along $y$",
    "longest_step": "longest step",
    "tolerance": "tolerance",
}
ALONG = {"n_x": "Elements along $x$", "longest_step": r"Longest step $\times V/D$"}
FAULT = ("kind", "evolution", "phi0", "height", "strength", "seed", "fault")
EVERY_FAULT = "normal_load"  # the kind whose faults are told apart


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw how far refinement moves the drop, with and without a perturbation.

    Parameters
    ----------
    table : Dataset
        From :func:`nucleation.analysis.convergence.refinement_table`, of perturbed runs and of
        quiet ones.

    Returns
    -------
    Figure
        Two columns wide: onset and length of every perturbed run, and lengths of quiet runs beside
        them.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 14.5 * style.CENTIMETRE)
    grid = figure.add_gridspec(3, 2, height_ratios=(1.0, 1.0, 1.1))
    declared = table.isel(run=np.flatnonzero(table["kind"].values != "none"))
    onset = figure.add_subplot(grid[0, :])
    length = figure.add_subplot(grid[1, :], sharex=onset)
    for axes, name in ((onset, "onset_difference"), (length, "length_difference")):
        _draw_differences(axes, declared, name)
    onset.tick_params(labelbottom=False)
    length.set_xlabel("Height $H$ (m), and what else differs")
    meshes = figure.add_subplot(grid[2, 0])
    steps = figure.add_subplot(grid[2, 1], sharey=meshes)
    for axes, refined in ((meshes, "n_x"), (steps, "longest_step")):
        _draw_lengths(axes, table, refined)
    meshes.set_ylabel("$L_c$ over the theory's")
    steps.tick_params(labelleft=False)
    steps.invert_xaxis()  # finer to the right, as in the other panel
    style.letters(onset, length, meshes, steps)
    handles = onset.get_legend_handles_labels()[0]
    open_marks = style.key(
        "open: coarsest mesh", "o", colour=style.VERMILLION, markersize=3.8, **style.OPEN
    )
    figure.legend(handles=[*handles, open_marks], loc="outside upper center", ncols=6)
    return figure


def places(table: xr.Dataset) -> dict[tuple[object, ...], xr.Dataset]:
    """The rows of each fault under the load, and all rows of each other kind, in order."""
    rows = zip(*(table[name].values.tolist() for name in FAULT), strict=True)
    keys = [row if row[0] == EVERY_FAULT else row[:1] for row in rows]
    order = sorted(set(keys), key=lambda key: (list(KINDS).index(str(key[0])), *key[1:]))
    return {key: table.isel(run=[i for i, k in enumerate(keys) if k == key]) for key in order}


def _name(key: tuple[object, ...], usual_age: object) -> str:
    """A place in a few words: what sets a fault apart from a height with the usual law."""
    if key[0] != EVERY_FAULT:
        return f"all, {KINDS[str(key[0])]}"
    law, age, height = key[1:4]
    words = [f"{height:g}", *[str(law)] * (law != USUAL_EVOLUTION), *["older"] * (age != usual_age)]
    return " ".join(words)


def _draw_differences(axes: Axes, declared: xr.Dataset, name: str) -> None:
    """How far each run but the finest of its sequence is from that one."""
    found = places(declared)
    usual_age = min(declared["phi0"].values.tolist(), default=0.0)
    axes.axhspan(LEAST / 2.0, GOALS[name], color="0.93", zorder=0, label="goal")
    for place, rows in enumerate(found.values()):
        for i, refined in enumerate(REFINED):
            marker, colour = style.look(i)
            for sequence in _sequences(rows, refined):
                apart = np.maximum(PERCENT * np.abs(sequence[name].values[:-1]), LEAST)
                at = np.full(apart.size, place + 0.17 * (i - 1.5))
                coarse = slice(0, -1) if refined == "n_x" else slice(0, 0)
                rest = slice(-1, None) if refined == "n_x" else slice(None)
                look: dict[str, Any] = dict(marker=marker, color=colour, markersize=3.8, ls="none")
                axes.plot(at[coarse], apart[coarse], markerfacecolor="white", **look)
                axes.plot(at[rest], apart[rest], **look)
    for i, meaning in enumerate(REFINED.values()):
        marker, colour = style.look(i)
        axes.plot([], [], marker, color=colour, markersize=3.8, label=meaning)
    axes.set_yscale("log")
    axes.set_ylim(LEAST / 2.0, 30.0)
    axes.set_yticks([LEAST, 0.1, 10.0], [r"$\leq 10^{-3}$", "$0.1$", "$10$"])
    axes.set_ylabel(LABELS[name])
    axes.set_xlim(-0.6, len(found) - 0.4)
    names = [_name(key, usual_age) for key in found]
    axes.set_xticks(range(len(found)), names, rotation=40.0, ha="right", rotation_mode="anchor")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.tick_params(axis="x", length=0)


def _sequences(rows: xr.Dataset, refined: str) -> Iterator[xr.Dataset]:
    """The sequences of one refined parameter, each from coarse to fine."""
    rows = rows.isel(run=np.flatnonzero(rows["refinement"].values == refined))
    names = [*FAULT, *(name for name in REFINED if name != refined)]
    keys = list(zip(*(rows[name].values.tolist() for name in names), strict=True))
    for key in dict.fromkeys(keys):
        yield rows.isel(run=[i for i, own in enumerate(keys) if own == key])


def _draw_lengths(axes: Axes, table: xr.Dataset, refined: str) -> None:
    """Lengths of quiet runs, and of perturbed ones of the same faults, against what is refined."""
    quiet = table.isel(run=np.flatnonzero(table["kind"].values == "none"))
    heights = np.unique(quiet["height"].values).tolist()
    sizes: set[float] = set()
    for sequence in _sequences(table, refined):
        first = {name: sequence[name].values[0].item() for name in (*FAULT, "n_x")}
        alike = first["evolution"] == USUAL_EVOLUTION and first["kind"] in ("none", "normal_load")
        if first["height"] not in heights or not alike:
            continue
        marker, colour = style.look(heights.index(first["height"]))
        calm = first["kind"] == "none"
        size = sequence[refined].values
        sizes.update(size.tolist())
        axes.plot(
            size, sequence["length_over_theory"].values, marker=marker, color=colour,
            markersize=3.8, linewidth=1.0, linestyle="--" if calm else "-",
            markerfacecolor="white" if calm else colour,
        )  # fmt: skip
        if calm and (refined == "longest_step" or first["height"] == heights[-1]):
            _label_other(axes, sequence, refined, colour)
    axes.margins(y=0.16)  # room for labels below the lowest curve
    axes.set_xscale("log")
    axes.set_xticks(sorted(sizes), [f"{size:g}" for size in sorted(sizes)])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xlabel(ALONG[refined])
    if refined == "n_x":
        for height in heights:
            marker, colour = style.look(heights.index(height))
            axes.plot([], [], marker=marker, color=colour, markersize=3.8, linewidth=1.0,
                      label=f"$H={height:g}$ m")  # fmt: skip
        axes.plot([], [], "--o", color=style.GUIDE, markersize=3.8, linewidth=1.0,
                  markerfacecolor="white", label="quiet")  # fmt: skip
        axes.legend(loc="upper left", fontsize=style.SMALL)


def _label_other(axes: Axes, sequence: xr.Dataset, refined: str, colour: str) -> None:
    """What sets quiet runs of one height apart: their steps along x, their elements in steps."""
    ratio = sequence["length_over_theory"].values
    look: dict[str, Any] = {
        "textcoords": "offset points", "fontsize": style.SMALL, "color": colour
    }  # fmt: skip
    if refined == "n_x":
        step = f"{float(sequence['longest_step'][0]):g} $D/V$"
        axes.annotate(step, (sequence["n_x"].values[-1], ratio[-1]), xytext=(-3, -9), ha="right",
                      **look)  # fmt: skip
    else:
        mesh = f"$N_x={int(sequence['n_x'][0])}$"
        place = (sequence["longest_step"].values[0], ratio[0])
        axes.annotate(mesh, place, xytext=(3, -10), **look)
