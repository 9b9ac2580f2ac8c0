"""The linear stability of the creeping patch in runs."""

from collections.abc import Iterable, Sequence

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from nucleation.extraction.extraction import parameters_of
from nucleation.pictures import style

from . import laws

# roles of the shown patches: the first that exists
_SHOWN = ("converged", "paper")
_LEGEND_HEIGHTS = 3  # heights in the legend
_DARKEST = 0.9  # used part of the sequence of colours: its end is too light for lines
_PANELS = (
    ("growth", (-0.3, 0.225), r"Growth rate $\mathrm{Re}\,\Lambda$ (1/s)"),
    ("frequency", (0.2, 1.0), r"Frequency $\mathrm{Im}\,\Lambda$ (1/s)"),
)
"""Property of the oscillating mode, range over V/D, name."""

_LATE = 4.0  # periods of the mode before the drop in which the patch slips in bursts


@style.styled()
def draw_stability(table: xr.Dataset, patches: Iterable[xr.Dataset]) -> Figure:
    """Draw growth and frequency of the frozen patches, and the shape of the mode."""
    patches = list(patches)
    figure, panels = style.panels(6.6, columns=3)
    growth, frequency, shape = panels
    style.letters(*panels)
    runs = shown(table.assign(patch=("run", np.arange(len(patches)))))
    heights = np.unique(runs["height"].values)
    # shades by the logarithm of the height
    shades = colormaps[style.SEQUENCE](_DARKEST * LogNorm(heights.min(), heights.max())(heights))
    named = np.linspace(0, heights.size - 1, min(_LEGEND_HEIGHTS, heights.size)).round()
    for i, (height, colour) in enumerate(zip(heights, shades, strict=True)):
        if i in named:
            frequency.plot([], [], color=colour, label=f"$H={style.number(height)}$ m")
        rows = laws.where(runs, height=height)
        for j in range(rows.sizes["run"]):
            row = rows.isel(run=j)
            patch = patches[int(row["patch"])]
            _draw_instants((growth, frequency), patch, row, {"color": colour, "ls": "none"})
            length = float(row["stability_length"])
            if np.isfinite(length):
                modulus = np.hypot(patch["mode_real"], patch["mode_imaginary"])
                shape.plot(patch["x"] / length, modulus, lw=1.0, color=colour)
    memory_time = max(parameters_of(patch).memory_time for patch in patches)
    for axes, (_, limits, label) in zip(panels, _PANELS, strict=False):
        axes.set(xlim=(0.3, 0.8), ylim=np.array(limits) / memory_time, ylabel=label)
        axes.set_xlabel("Patch length over theory $L/L_c$")
    look: style.Options = {"color": style.THEORY}
    growth.axvline(0.5, lw=1.0, ls="--", **look)
    look["fontsize"] = style.SMALL
    growth.text(0.49, 0.9, "$L_c/2$", ha="right", transform=growth.get_xaxis_transform(), **look)
    growth.plot([], [], "x", ms=3.0, label=f"last {_LATE:g} periods")
    growth.legend(loc="lower right", handletextpad=0.2)
    frequency.legend(loc="lower left")
    # the homogeneous mode of the theory: a whole wave of constant modulus
    x = np.linspace(0.0, 1.0, 201)
    shape.plot(x, np.sin(2.0 * np.pi * x), "--", color=style.THEORY, lw=1.1)
    shape.text(0.95, -1.08, "theory, $L=L_c$: one wavelength", ha="right", va="top", **look)
    text = "patch, $L=L_s$:\nhalf a wavelength\n(modulus)"
    shape.text(0.05, -0.15, text, fontsize=style.SMALL, va="top")
    for axes in (growth, shape):
        axes.axhline(0.0, lw=0.7)
    shape.set(xlabel="Position over patch length $x/L$", xlim=(0.0, 1.0))
    shape.set(ylabel="Slip in the mode", ylim=(-1.35, 1.15))
    return figure


def shown(table: xr.Dataset) -> xr.Dataset:
    """The runs with the usual law and the usual initial state, of the shown role."""
    *_, usual = next(laws.kinds(table))
    for role in _SHOWN:
        if role in usual["role"].values:
            return laws.where(usual, role=role)
    return usual


def _draw_instants(
    panels: Sequence[Axes], patch: xr.Dataset, row: xr.Dataset, look: style.Options
) -> None:
    """Growth and frequency of the mode at every frozen instant."""
    ratio = patch["patch_length"].values / float(row["critical_length"])
    time = patch["instant_time"].values
    late = time > time.max() - _LATE * 2.0 * np.pi / float(patch["stability_frequency"])
    for axes, (name, _, _) in zip(panels, _PANELS, strict=True):
        values = patch[f"oscillation_{name}"].values
        axes.plot(ratio[~late], values[~late], marker=".", ms=1.8, rasterized=True, **look)
        axes.plot(ratio[late], values[late], marker="x", ms=2.4, mew=0.6, rasterized=True, **look)
