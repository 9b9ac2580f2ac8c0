"""Refinement of mesh and steps, with a declared perturbation and without."""

from collections.abc import Iterator

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator

from nucleation.model.friction import USUAL_EVOLUTION
from nucleation.pictures import style

from . import laws

_PERCENT = 100.0
LEAST = 1e-3  # per cent: smaller differences are drawn there

_KINDS = {
    "normal_load": "load",
    "drive_velocity": "drive",
    "state": "state",
    "strength": "roughness",
}
_REFINED = {
    "n_x": "elements along $x$",
    "n_y": "elements along $y$",
    "longest_step": "longest step",
    "tolerance": "tolerance",
}
_ALONG = {
    "n_x": "Elements $N$ within the theory's $L_c$",
    "longest_step": r"Longest step $\times V/D$",
}
_FAULT = ("kind", "evolution", "initial_state", "height", "strength", "seed", "fault")
_EVERY_FAULT = "normal_load"  # the kind with a place for each fault
_SIZE: style.Options = {"markersize": 3.8}

_Place = tuple[object, ...]
"""Kind of the perturbation, followed by the fault if each has its own place."""


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw the change of the drop by refinement, with and without a perturbation.

    The upper panels have onset and length of every perturbed run, the lower ones lengths of
    perturbed and quiet runs.
    """
    figure = style.new_figure(14.5)
    panels = figure.subplot_mosaic("aa;bb;cd", height_ratios=(1.0, 1.0, 1.1))
    onset, length, meshes, steps = panels.values()
    perturbed = laws.where(table, table["kind"].values != "none")
    # the goals are in per cent
    _draw_differences(onset, perturbed, "onset_difference", "Onset apart (%)", 0.3)
    _draw_differences(length, perturbed, "length_difference", "$L$ apart (%)", 0.5)
    onset.tick_params(labelbottom=False)
    length.set_xlabel("Height $H$ (m), and what else differs")
    steps.sharey(meshes)
    _draw_lengths(meshes, table, "n_x")
    _draw_lengths(steps, table, "longest_step")
    meshes.set_ylabel("Length over theory $L/L_c$")
    steps.tick_params(labelleft=False)
    steps.invert_xaxis()  # finer to the right, as in the other panel
    style.letters(onset, length, meshes, steps)
    handles = onset.get_legend_handles_labels()[0]
    look = _SIZE | style.OPEN
    handles.append(
        style.key(
            "open: coarsest mesh",
            "o",
            colour=style.VERMILLION,
            **look,
        )
    )
    figure.legend(handles=handles, loc="outside upper center", ncols=6)
    return figure


def places(table: xr.Dataset) -> dict[_Place, xr.Dataset]:
    """The rows of each fault under the load, and all rows of each other kind, in order."""
    columns = [table[name].values.tolist() for name in _FAULT]
    keys = [_place(row) for row in zip(*columns, strict=True)]
    kinds = list(_KINDS)
    order = sorted(set(keys), key=lambda key: (kinds.index(str(key[0])), *key[1:]))
    found = {}
    for key in order:
        found[key] = laws.where(table, [own == key for own in keys])
    return found


def _place(fault: _Place) -> _Place:
    return fault if fault[0] == _EVERY_FAULT else fault[:1]


def _name(key: _Place, usual_age: object) -> str:
    """A place in a few words: the height, an unusual law and an older interface."""
    if key[0] != _EVERY_FAULT:
        return f"all, {_KINDS[str(key[0])]}"
    law, age, height = key[1:4]
    words = [f"{height:g}"]
    if law != USUAL_EVOLUTION:
        words.append(str(law))
    if age != usual_age:
        words.append("older")
    return " ".join(words)


def _draw_differences(
    axes: Axes, perturbed: xr.Dataset, name: str, label: str, goal: float
) -> None:
    """Difference of each run from the finest of its sequence."""
    found = places(perturbed)
    usual_age = min(perturbed["initial_state"].values.tolist(), default=0.0)
    axes.axhspan(
        LEAST / 2.0,
        goal,
        color="0.93",
        zorder=0,
        label="goal",
    )
    for i, (refined, meaning) in enumerate(_REFINED.items()):
        marker, colour = style.look(i)
        look: style.Options = {"color": colour, "ls": "none", **_SIZE}
        for place, rows in enumerate(found.values()):
            for sequence in _sequences(rows, refined):
                differences = _PERCENT * np.abs(sequence[name].values[:-1])
                shown = np.maximum(differences, LEAST)
                at = np.full(shown.size, place + 0.17 * (i - 1.5))
                coarse = shown.size - 1 if refined == "n_x" else 0
                axes.plot(
                    at[:coarse],
                    shown[:coarse],
                    marker,
                    **style.OPEN,
                    **look,
                )
                axes.plot(at[coarse:], shown[coarse:], marker, **look)
        axes.plot([], [], marker, label=meaning, **look)
    axes.set(
        yscale="log",
        ylim=(LEAST / 2.0, 30.0),
        xlim=(-0.6, len(found) - 0.4),
        ylabel=label,
    )
    axes.set_yticks([LEAST, 0.1, 10.0], [f"\u2264 {LEAST:g}", "0.1", "10"])
    names = [_name(key, usual_age) for key in found]
    axes.set_xticks(
        range(len(found)),
        names,
        rotation=40.0,
        ha="right",
        rotation_mode="anchor",
    )
    axes.xaxis.set_minor_locator(NullLocator())
    axes.tick_params(axis="x", length=0)


def _sequences(rows: xr.Dataset, refined: str) -> Iterator[xr.Dataset]:
    """The sequences of one refined parameter, each from coarse to fine."""
    others = [name for name in _REFINED if name != refined]
    return laws.groups(
        laws.where(rows, refinement=refined),
        *_FAULT,
        *others,
    )


def _draw_lengths(axes: Axes, table: xr.Dataset, refined: str) -> None:
    """Lengths of quiet and of perturbed runs of the same faults, against the refined parameter."""
    quiet = laws.where(table, kind="none")
    heights = np.unique(quiet["height"].values).tolist()
    alike = np.isin(table["kind"].values, ["none", "normal_load"])
    alike &= np.isin(table["height"].values, heights)
    rows = laws.where(table, alike, evolution=USUAL_EVOLUTION)
    sizes: set[float] = set()
    for sequence in _sequences(rows, refined):
        height = float(sequence["height"][0])
        is_quiet = bool(sequence["kind"][0] == "none")
        marker, colour = style.look(heights.index(height))
        ratio = sequence["length_over_theory"].values
        # elements along x in the theory's critical length, for any length of the block
        elements = sequence["n_x"] * sequence["critical_length"] / sequence["block_length"]
        within = np.rint(elements.values)
        size = within if refined == "n_x" else sequence[refined].values
        sizes.update(size.tolist())
        look: style.Options = {"marker": marker, "color": colour, "linewidth": 1.0, **_SIZE}
        if is_quiet:
            look |= {"linestyle": "--", **style.OPEN}
        axes.plot(size, ratio, **look)
        if is_quiet and refined == "longest_step":  # quiet runs of one height differ in the mesh
            mesh = f"$N={within[0]:g}$"
            style.note(
                axes,
                mesh,
                (size[0], ratio[0]),
                (3, -10),
                color=colour,
            )
        elif is_quiet and height == heights[-1]:
            step = f"{float(sequence['longest_step'][0]):g} $D/V$"
            end = (size[-1], ratio[-1])
            style.note(
                axes,
                step,
                end,
                (-3, -9),
                ha="right",
                color=colour,
            )
    axes.margins(y=0.16)  # room for labels below the lowest curve
    axes.set(xscale="log", xlabel=_ALONG[refined])
    axes.set_xticks(sorted(sizes), [f"{size:g}" for size in sorted(sizes)])
    axes.xaxis.set_minor_locator(NullLocator())
    if refined == "n_x":
        axes.legend(handles=_keys(heights), loc="upper left", fontsize=style.SMALL)


def _keys(heights: list[float]) -> list[Line2D]:
    keys = []
    for i, height in enumerate(heights):
        marker, colour = style.look(i)
        keys.append(
            style.key(
                f"$H={height:g}$ m",
                marker,
                "-",
                colour,
                **_SIZE,
                lw=1.0,
            )
        )
    keys.append(
        style.key(
            "quiet",
            "o",
            "--",
            linewidth=1.0,
            **_SIZE,
            **style.OPEN,
        )
    )
    return keys
