"""The linear stability of the creeping patch: growth against length, and the mode."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from ...figures import laws, style

SHOWN = ("converged", "paper")  # the role whose patches are shown: the first that is there
LEGEND_HEIGHTS = 3  # heights that the legend names, out of those drawn
DARKEST = 0.9  # part of the sequence of colours in use: its end is too light for lines
PANELS = (
    ("growth", (-6.0, 4.5), r"Growth rate $\mathrm{Re}\,\Lambda$ (1/s)"),
    ("frequency", (4.0, 20.0), r"Frequency $\mathrm{Im}\,\Lambda$ (1/s)"),
)
"""Property of the oscillating mode, range (1/s), name."""


@style.styled
def draw(table: xr.Dataset, patches: Sequence[xr.Dataset]) -> Figure:
    """Draw growth and frequency of the frozen patches, and the shape of the mode.

    Parameters
    ----------
    table : Dataset
        On ``run``: ``role``, ``evolution``, ``height`` (m), ``phi0`` (s), ``theory_length`` and
        ``stability_length`` (m).
    patches : sequence of Dataset
        In the same order, with ``patch_length`` (m), ``oscillation_growth`` and
        ``oscillation_frequency`` (1/s) on ``instant``, ``mode_real`` and ``mode_imaginary`` on x.
    """
    figure, (growth, frequency, shape) = style.panels(1, 3, 6.6)
    shown = _shown(table.assign(patch=("run", np.arange(len(patches)))))
    heights = np.unique(shown["height"].values)
    norm, sequence = LogNorm(heights.min(), heights.max()), colormaps[style.SEQUENCE]

    def colour(height: xr.DataArray | float) -> Any:
        return sequence(DARKEST * float(np.clip(norm(float(height)), 0.0, 1.0)))

    for row in (shown.isel(run=i) for i in range(shown.sizes["run"])):
        _draw_patch(
            (growth, frequency, shape), patches[int(row["patch"])], row, colour(row["height"])
        )
    for axes, (_, limits, label) in zip((growth, frequency), PANELS, strict=True):
        axes.set(xlim=(0.3, 0.8), ylim=limits, ylabel=label)
        axes.set_xlabel("Patch length over theory $L/L_c$")
    style.level(growth, 0.0)
    growth.axvline(0.5, color=style.THEORY, linewidth=1.0, linestyle="--")
    growth.text(0.49, 3.4, "$L_c/2$", color=style.THEORY, fontsize=style.SMALL, ha="right")
    named = np.linspace(0, heights.size - 1, min(LEGEND_HEIGHTS, heights.size)).round().astype(int)
    for height in heights[named]:
        frequency.plot([], [], "-", color=colour(height), label=f"$H={height:g}$ m")
    frequency.legend(loc="lower left", labelspacing=0.3)
    # the homogeneous mode of the theory: a wave of constant modulus, whole in the patch
    x = np.linspace(0.0, 1.0, 201)
    shape.plot(x, np.sin(2.0 * np.pi * x), "--", color=style.THEORY, linewidth=1.1)
    style.level(shape, 0.0)
    text: Any = {"fontsize": style.SMALL, "va": "top"}
    shape.text(0.05, -0.15, "patch, $L=L_s$:\nhalf a wavelength\n(modulus)", **text)
    theory = "theory, $L=L_c$: one wavelength"
    shape.text(0.95, -1.08, theory, color=style.THEORY, ha="right", **text)
    shape.set(xlim=(0.0, 1.0), ylim=(-1.35, 1.15))
    shape.set(xlabel="Position over patch length $x/L$", ylabel="Slip in the mode")
    style.letters(growth, frequency, shape, minor=True)
    return figure


def _shown(table: xr.Dataset) -> xr.Dataset:
    """The runs with the usual law and the usual initial state, of the role that is shown."""
    usual = laws.where(table, laws.usual(table))
    role = next((name for name in SHOWN if name in usual["role"].values), None)
    return laws.where(usual, role=role) if role else usual


def _draw_patch(panels: Sequence[Axes], patch: xr.Dataset, row: xr.Dataset, colour: Any) -> None:
    """Properties of the mode of every frozen instant; its modulus where it begins to grow."""
    *properties, shape = panels
    ratio, look = patch["patch_length"].values / float(row["theory_length"]), {"color": colour}
    for axes, (name, *_) in zip(properties, PANELS, strict=True):
        axes.plot(ratio, patch[f"oscillation_{name}"].values, ".", ms=1.8, rasterized=True, **look)
    length = float(row["stability_length"])
    if np.isfinite(length):
        modulus = np.hypot(patch["mode_real"].values, patch["mode_imaginary"].values)
        shape.plot(patch["x"].values / length, modulus, linewidth=1.0, **look)
