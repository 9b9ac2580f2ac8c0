"""Refinement of mesh and steps, with a declared perturbation and without."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from ...figures import laws, style
from ...model.friction.registry import USUAL_EVOLUTION
from ...types import Array

PERCENT = 100.0
LEAST = 1e-3  # per cent: smaller differences are drawn there
DIFFERENCES = (
    ("onset_difference", "Onset apart (%)", 0.3),
    ("length_difference", "$L_c$ apart (%)", 0.5),
)
"""Column, name, goal in per cent."""

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
ALONG = {
    "n_x": "Elements $N$ within the theory's $L_c$",
    "longest_step": r"Longest step $\times V/D$",
}
FAULT = ("kind", "evolution", "phi0", "height", "strength", "seed", "fault")
EVERY_FAULT = "normal_load"  # the kind whose faults are told apart
SIZE: Any = {"markersize": 3.8}


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw how far refinement moves the drop, with and without a perturbation.

    Onset and length of every perturbed run, and lengths of quiet runs beside them. `table` is that
    of :func:`nucleation.analysis.convergence.refinement_table`.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 14.5 * style.CENTIMETRE)
    panels = figure.subplot_mosaic("aa;bb;cd", height_ratios=(1.0, 1.0, 1.1))
    onset, length, meshes, steps = panels.values()
    declared = laws.where(table, table["kind"].values != "none")
    for axes, difference in zip((onset, length), DIFFERENCES, strict=True):
        _draw_differences(axes, declared, *difference)
    onset.tick_params(labelbottom=False)
    length.set_xlabel("Height $H$ (m), and what else differs")
    steps.sharey(meshes)
    for axes, refined in ((meshes, "n_x"), (steps, "longest_step")):
        _draw_lengths(axes, table, refined)
    meshes.set_ylabel("$L_c$ over the theory's")
    steps.tick_params(labelleft=False)
    steps.invert_xaxis()  # finer to the right, as in the other panel
    style.letters(onset, length, meshes, steps)
    handles = onset.get_legend_handles_labels()[0]
    look = SIZE | style.OPEN
    handles.append(style.key("open: coarsest mesh", "o", colour=style.VERMILLION, **look))
    figure.legend(handles=handles, loc="outside upper center", ncols=6)
    return figure


def places(table: xr.Dataset) -> dict[tuple[object, ...], xr.Dataset]:
    """The rows of each fault under the load, and all rows of each other kind, in order."""
    rows = zip(*(table[name].values.tolist() for name in FAULT), strict=True)
    keys = [row if row[0] == EVERY_FAULT else row[:1] for row in rows]
    order = sorted(set(keys), key=lambda key: (list(KINDS).index(str(key[0])), *key[1:]))
    return {key: laws.where(table, [own == key for own in keys]) for key in order}


def _name(key: tuple[object, ...], usual_age: object) -> str:
    """A place in a few words: what sets a fault apart from a height with the usual law."""
    if key[0] != EVERY_FAULT:
        return f"all, {KINDS[str(key[0])]}"
    law, age, height = key[1:4]
    words = [f"{height:g}", *[str(law)] * (law != USUAL_EVOLUTION), *["older"] * (age != usual_age)]
    return " ".join(words)


def _draw_differences(axes: Axes, declared: xr.Dataset, name: str, label: str, goal: float) -> None:
    """How far each run but the finest of its sequence is from that one."""
    found = places(declared)
    usual_age = min(declared["phi0"].values.tolist(), default=0.0)
    axes.axhspan(LEAST / 2.0, goal, color="0.93", zorder=0, label="goal")
    for i, (refined, meaning) in enumerate(REFINED.items()):
        marker, colour = style.look(i)
        look: Any = {"color": colour, "ls": "none", **SIZE}
        for place, rows in enumerate(found.values()):
            for sequence in _sequences(rows, refined):
                apart = np.maximum(PERCENT * np.abs(sequence[name].values[:-1]), LEAST)
                at = np.full(apart.size, place + 0.17 * (i - 1.5))
                coarse = apart.size - 1 if refined == "n_x" else 0
                axes.plot(at[:coarse], apart[:coarse], marker, **style.OPEN, **look)
                axes.plot(at[coarse:], apart[coarse:], marker, **look)
        axes.plot([], [], marker, label=meaning, **look)
    axes.set(yscale="log", ylim=(LEAST / 2.0, 30.0), xlim=(-0.6, len(found) - 0.4), ylabel=label)
    axes.set_yticks([LEAST, 0.1, 10.0], [r"$\leq 10^{-3}$", "$0.1$", "$10$"])
    names = [_name(key, usual_age) for key in found]
    axes.set_xticks(range(len(found)), names, rotation=40.0, ha="right", rotation_mode="anchor")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.tick_params(axis="x", length=0)


def _sequences(rows: xr.Dataset, refined: str) -> Iterator[xr.Dataset]:
    """The sequences of one refined parameter, each from coarse to fine."""
    others = (name for name in REFINED if name != refined)
    return laws.groups(laws.where(rows, refinement=refined), *FAULT, *others)


def _elements_within(rows: xr.Dataset) -> Array:
    """Number of elements along x in the theory's critical length, whatever the block's length."""
    return np.rint((rows["n_x"] * rows["theory_length"] / rows["block_length"]).values)


def _draw_lengths(axes: Axes, table: xr.Dataset, refined: str) -> None:
    """Lengths of quiet runs, and of perturbed ones of the same faults, against what is refined."""
    heights = np.unique(laws.where(table, kind="none")["height"].values).tolist()
    alike = np.isin(table["kind"].values, ["none", "normal_load"])
    alike &= np.isin(table["height"].values, heights)
    sizes: set[float] = set()
    for sequence in _sequences(laws.where(table, alike, evolution=USUAL_EVOLUTION), refined):
        height, calm = float(sequence["height"][0]), bool(sequence["kind"][0] == "none")
        marker, colour = style.look(heights.index(height))
        ratio, within = sequence["length_over_theory"].values, _elements_within(sequence)
        size = within if refined == "n_x" else sequence[refined].values
        sizes.update(size.tolist())
        look: Any = {"color": colour, "mfc": "white" if calm else colour, "linewidth": 1.0, **SIZE}
        axes.plot(size, ratio, marker=marker, linestyle="--" if calm else "-", **look)
        text: Any = {"textcoords": "offset points", "fontsize": style.SMALL, "color": colour}
        if calm and refined == "longest_step":  # what sets quiet runs of one height apart
            mesh = f"$N={within[0]:g}$"
            axes.annotate(mesh, (size[0], ratio[0]), xytext=(3, -10), **text)
        elif calm and height == heights[-1]:
            step = f"{float(sequence['longest_step'][0]):g} $D/V$"
            axes.annotate(step, (size[-1], ratio[-1]), xytext=(-3, -9), ha="right", **text)
    axes.margins(y=0.16)  # room for labels below the lowest curve
    axes.set(xscale="log", xlabel=ALONG[refined])
    axes.set_xticks(sorted(sizes), [f"{size:g}" for size in sorted(sizes)])
    axes.xaxis.set_minor_locator(NullLocator())
    if refined == "n_x":
        keys = [
            style.key(f"$H={height:g}$ m", style.look(i)[0], "-", style.look(i)[1], **SIZE, lw=1.0)
            for i, height in enumerate(heights)
        ]
        keys.append(style.key("quiet", "o", "--", linewidth=1.0, **SIZE, **style.OPEN))
        axes.legend(handles=keys, loc="upper left", fontsize=style.SMALL)
