"""Quick pictures of single datasets: the theory's lengths, a table of lengths, a patch."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from ..figures import style

COLOURS = (style.BLUE, style.VERMILLION, style.GREEN, style.PURPLE, style.ORANGE, style.SKY_BLUE)
MARKERS = "os^vDP"


@style.styled
def draw_theory(theory: xr.Dataset) -> Figure:
    """Draw ``critical_length`` and ``thin_limit_length`` (m) against ``height`` (m)."""
    figure = style.new_figure(style.SINGLE_COLUMN, 6.4 * style.CENTIMETRE)
    axes = figure.add_subplot()
    height, length = theory["height"].values, theory["critical_length"].values
    axes.plot(height, length, color=style.THEORY, label="theory")
    axes.plot(
        height, theory["thin_limit_length"].values, color=style.THIN_LIMIT, linestyle="--",
        linewidth=1.1, label=r"$Hk\to 0$",
    )  # fmt: skip
    axes.set(xlabel="Height $H$ (m)", ylabel="Critical length $L_c$ (m)")
    axes.set_xlim(0.0, height.max())
    axes.set_ylim(0.0, 1.15 * length.max())
    axes.legend(loc="lower right")
    return figure


@style.styled
def draw_lengths(table: xr.Dataset) -> Figure:
    """Draw ``length`` with ``_low`` and ``_high`` (m) against ``theory_length`` (m)."""
    figure = style.new_figure(style.SINGLE_COLUMN, 7.4 * style.CENTIMETRE)
    axes = figure.add_subplot()
    names = table["study"].values.astype(str)
    for number, name in enumerate(dict.fromkeys(names)):
        rows = table.isel(run=np.flatnonzero(names == name))
        length = rows["length"].values
        bars = [length - rows["length_low"].values, rows["length_high"].values - length]
        axes.errorbar(
            rows["theory_length"].values, length, yerr=np.clip(bars, 0.0, None), linestyle="none",
            marker=MARKERS[number % 6], color=COLOURS[number % 6], elinewidth=0.9, label=name,
        )  # fmt: skip
    top = 1.08 * float(max(table["theory_length"].max(), table["length_high"].max()))
    axes.plot([0.0, top], [0.0, top], color=style.GUIDE, linewidth=0.9, zorder=0)
    axes.annotate("theory", (0.8 * top, 0.82 * top), color=style.GUIDE, rotation=45, ha="center")
    axes.set(xlabel="$L_c$ of the theory (m)", ylabel="$L_c$ of the simulation (m)")
    axes.set(xlim=(0.0, top), ylim=(0.0, top), aspect="equal")
    axes.legend(loc="upper left")
    return figure


@style.styled
def draw_patch(patch: xr.Dataset) -> Figure:
    """Draw ``oscillation_growth`` and ``_frequency`` (1/s) against ``patch_length`` (m)."""
    figure = style.new_figure(style.SINGLE_COLUMN, 8.4 * style.CENTIMETRE)
    growth, frequency = figure.subplots(2, 1, sharex=True)
    length = patch["patch_length"].values
    growth.plot(length, patch["oscillation_growth"].values, color=style.THEORY)
    growth.axhline(0.0, color=style.GUIDE, linewidth=0.9)
    frequency.plot(length, patch["oscillation_frequency"].values, color=style.THEORY)
    for axes in (growth, frequency):
        axes.axvline(float(patch["stability_length"]), color=style.GUIDE, linestyle=":")
    growth.annotate(
        "$L_s$", (float(patch["stability_length"]), 1.0), (3.0, -10.0),
        xycoords=growth.get_xaxis_transform(), textcoords="offset points", color=style.GUIDE,
    )  # fmt: skip
    growth.set_ylabel(r"Growth $\mathrm{Re}\,\Lambda$ (1/s)")
    frequency.set(xlabel="Patch length $L$ (m)", ylabel=r"Frequency $\mathrm{Im}\,\Lambda$ (1/s)")
    return figure
