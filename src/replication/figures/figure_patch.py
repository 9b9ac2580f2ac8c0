"""The linear stability of the creeping patch: of runs, and the theory against simulations."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from nucleation.extraction.extraction import parameters_of
from nucleation.pictures import style
from nucleation.types import Array

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


@style.styled
def draw_stability(table: xr.Dataset, patches: Sequence[xr.Dataset]) -> Figure:
    """Draw growth and frequency of the frozen patches, and the shape of the mode."""
    figure, (growth, frequency, shape) = style.panels(1, 3, 6.6)
    shown = _shown(table.assign(patch=("run", np.arange(len(patches)))))
    heights = np.unique(shown["height"].values)
    # shades by the logarithm of the height
    shades = colormaps[style.SEQUENCE](_DARKEST * LogNorm(heights.min(), heights.max())(heights))
    colours = dict(zip(heights.tolist(), shades, strict=True))
    for i in range(shown.sizes["run"]):
        row = shown.isel(run=i)
        patch = patches[int(row["patch"])]
        colour = colours[float(row["height"])]
        _draw_properties((growth, frequency), patch, row, colour)
        _draw_mode(shape, patch, row, colour)
    memory_time = max(parameters_of(patch).memory_time for patch in patches)
    for axes, (_, limits, label) in zip(
        (growth, frequency),
        _PANELS,
        strict=True,
    ):
        axes.set(
            xlim=(0.3, 0.8),
            ylim=np.array(limits) / memory_time,
            ylabel=label,
        )
        axes.set_xlabel("Patch length over theory $L/L_c$")
    style.level(growth, 0.0)
    look: style.Options = {"color": style.THEORY}
    growth.axvline(0.5, linewidth=1.0, linestyle="--", **look)
    look |= {"transform": growth.get_xaxis_transform(), "fontsize": style.SMALL}
    growth.text(0.49, 0.9, "$L_c/2$", ha="right", **look)
    number = min(_LEGEND_HEIGHTS, heights.size)
    named = (
        np.linspace(
            0,
            heights.size - 1,
            number,
        )
        .round()
        .astype(int)
    )
    for height in heights[named]:
        frequency.plot(
            [],
            [],
            "-",
            color=colours[float(height)],
            label=f"$H={height:g}$ m",
        )
    late = style.key(f"last {_LATE:g} periods", "x", markersize=3.0)
    growth.legend(handles=[late], loc="lower right", handletextpad=0.2)
    frequency.legend(loc="lower left", labelspacing=0.3)
    _finish_mode(shape)
    style.letters(growth, frequency, shape, minor=True)
    return figure


def _shown(table: xr.Dataset) -> xr.Dataset:
    """The runs with the usual law and the usual initial state, of the shown role."""
    usual = laws.where(table, laws.usual(table))
    for role in _SHOWN:
        if role in usual["role"].values:
            return laws.where(usual, role=role)
    return usual


def _draw_properties(
    panels: Sequence[Axes], patch: xr.Dataset, row: xr.Dataset, colour: Array
) -> None:
    """Growth and frequency of the mode at every frozen instant."""
    ratio = patch["patch_length"].values / float(row["critical_length"])
    time = patch["instant_time"].values
    late = time > time.max() - _LATE * 2.0 * np.pi / float(patch["stability_frequency"])
    for axes, (name, _, _) in zip(
        panels,
        _PANELS,
        strict=True,
    ):
        values = patch[f"oscillation_{name}"].values
        look: style.Options = {"rasterized": True, "color": colour, "linestyle": "none"}
        axes.plot(
            ratio[~late],
            values[~late],
            marker=".",
            ms=1.8,
            **look,
        )
        axes.plot(
            ratio[late],
            values[late],
            marker="x",
            ms=2.4,
            mew=0.6,
            **look,
        )


def _draw_mode(
    axes: Axes,
    patch: xr.Dataset,
    row: xr.Dataset,
    colour: Array,
) -> None:
    """Modulus of the mode where it begins to grow."""
    length = float(row["stability_length"])
    if np.isfinite(length):
        modulus = np.hypot(patch["mode_real"].values, patch["mode_imaginary"].values)
        axes.plot(
            patch["x"].values / length,
            modulus,
            linewidth=1.0,
            color=colour,
        )


def _finish_mode(axes: Axes) -> None:
    """The homogeneous mode of the theory, a whole wave of constant modulus, and texts."""
    x = np.linspace(0.0, 1.0, 201)
    axes.plot(
        x,
        np.sin(2.0 * np.pi * x),
        "--",
        color=style.THEORY,
        linewidth=1.1,
    )
    style.level(axes, 0.0)
    text: style.Options = {"fontsize": style.SMALL, "va": "top"}
    axes.text(0.05, -0.15, "patch, $L=L_s$:\nhalf a wavelength\n(modulus)", **text)
    theory = "theory, $L=L_c$: one wavelength"
    axes.text(
        0.95,
        -1.08,
        theory,
        color=style.THEORY,
        ha="right",
        **text,
    )
    axes.set(xlim=(0.0, 1.0), ylim=(-1.35, 1.15))
    axes.set(xlabel="Position over patch length $x/L$", ylabel="Slip in the mode")


_BAND = 0.03  # relative error within which theory and simulation agree


@style.styled
def draw_theory(table: xr.Dataset) -> Figure:
    """Draw L_s over L_c against zeta/a, both lengths against each other, slip rate and stress."""
    figure, (ratio, parity, creep) = style.panels(1, 3, 7.6)
    _draw_ratio(ratio, table)
    _draw_parity(parity, table)
    if "shown_beta" in table:
        _draw_creep(creep, table)
    style.letters(ratio, parity, creep, minor=True)
    return figure


def _draw_ratio(axes: Axes, table: xr.Dataset) -> None:
    """L_s/L_c over zeta/a: the thin limit, and simulations by their height."""
    curve = table["curve_stability"]
    axes.semilogx(table["curve_ratio"], curve, color=style.STABILITY, label="thin layers")
    own = laws.where(table, f_beta=0.0)
    theory = own["critical_length"]
    drawn = axes.scatter(
        own["zeta_over_a"],
        own["stability_length"] / theory,
        c=own["height"] / theory,
        s=7.0,
        norm="log",
        cmap=style.SEQUENCE,
        label="simulated",
    )
    axes.figure.colorbar(drawn, ax=axes, label="$H/L_c$")
    style.level(axes, 0.5, ":", 0.6, label="one half")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.legend(fontsize=style.SMALL)
    axes.set(xlabel=r"$\zeta/a$", ylabel="$L_s/L_c$")


def _draw_parity(axes: Axes, table: xr.Dataset) -> None:
    """Difference of the theory's L_s from the simulated one, by study."""
    for n, own in enumerate(laws.groups(table, "study")):
        marker, colour = style.look(n)
        measured = own["stability_length"] / own["critical_length"]
        difference = 100.0 * (own["front_length"] / own["stability_length"] - 1.0)
        label = str(own["study"].values[0]).replace("_", " ")
        axes.plot(
            measured,
            difference,
            marker,
            color=colour,
            markersize=2.8,
            label=label,
        )
    style.band(axes, -100.0 * _BAND, 100.0 * _BAND, f"within {100 * _BAND:g} %")
    axes.set(xlabel="$L_s/L_c$, simulated", ylabel=r"$L_s$: theory / simulation $-$ 1 (%)")
    axes.figure.legend(
        handles=axes.get_legend_handles_labels()[0],
        loc="outside lower center",
        title="Studies in (b)",
        fontsize=style.SMALL,
        handletextpad=0.2,
        columnspacing=1.0,
        ncols=5,
    )


def _draw_creep(axes: Axes, table: xr.Dataset) -> None:
    """Slip rate (dashed) and normal stress along patches at their L_s, by the contrast."""
    for i, colour in enumerate(style.shades(table.sizes["case"])):
        case = table.isel(case=i)
        label = rf"$f\beta = {float(case['shown_beta']):.2g}$"
        axes.plot(
            case["shown_x"],
            case["shown_stress"],
            color=colour,
            label=label,
        )
        axes.plot(
            case["shown_x"],
            case["shown_rate"],
            color=colour,
            linestyle="--",
        )
    axes.set(xlabel="$x/L_s$", ylabel=r"$\sigma/\sigma_0$;  $v/V$ (dashed)", ylim=(0.0, 2.2))
    axes.legend(fontsize=style.SMALL)
