"""The linear stability of the creeping patch: growth against length, twins, and the mode."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from ...figures import laws, style

SHOWN = ("converged", "paper")  # the role whose patches are shown: the first that is there
LENGTHS = (0.3, 0.8)  # patch lengths shown, over the theory's
GROWTH_RANGE = (-6.0, 4.5)  # 1/s
FREQUENCY_RANGE = (4.0, 20.0)  # 1/s
LEGEND_HEIGHTS = 3  # heights that the legend names, out of those drawn
DARKEST = 0.9  # part of the sequence of colours in use: its end is too light for lines


@style.styled
def draw(table: xr.Dataset, patches: Sequence[xr.Dataset], twins: xr.Dataset) -> Figure:
    """Draw growth and frequency of the frozen patches with twin runs, and the shape of the mode.

    Parameters
    ----------
    table : Dataset
        On ``run``: ``role``, ``evolution``, ``height`` (m), ``phi0`` (s), ``theory_length`` and
        ``stability_length`` (m).
    patches : sequence of Dataset
        In the same order, with ``patch_length`` (m), ``oscillation_growth`` and
        ``oscillation_frequency`` (1/s) on ``instant``, ``mode_real`` and ``mode_imaginary`` on x.
    twins : Dataset
        On ``twin``: ``evolution``, ``height``, ``twin_length``, ``theory_length`` (m),
        ``twin_growth``
        and ``twin_frequency`` (1/s); those of the usual law are drawn.

    Returns
    -------
    Figure
        Two columns wide.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 6.6 * style.CENTIMETRE)
    growth, frequency, shape = figure.subplots(1, 3)
    shown = _shown(table)
    heights = table["height"].values[shown]
    colours = _Colours(heights)
    for i in shown:
        _draw_patch(growth, patches[i], "oscillation_growth", table.isel(run=i), colours)
        _draw_patch(frequency, patches[i], "oscillation_frequency", table.isel(run=i), colours)
        _draw_mode(shape, patches[i], table.isel(run=i), colours)
    _draw_twins(growth, twins, "twin_growth", colours)
    _draw_twins(frequency, twins, "twin_frequency", colours)
    _finish_growth(growth)
    _finish_frequency(frequency, np.unique(heights), colours, twins.sizes["twin"] > 0)
    _finish_shape(shape)
    style.letters(growth, frequency, shape)
    for axes in (growth, frequency, shape):
        axes.minorticks_on()
    return figure


class _Colours:
    """Colours by height."""

    def __init__(self, heights: np.ndarray) -> None:
        self._norm = LogNorm(heights.min(), heights.max())
        self._shades = colormaps[style.SEQUENCE]

    def __getitem__(self, height: float) -> tuple[float, ...]:
        return self._shades(DARKEST * float(np.clip(self._norm(height), 0.0, 1.0)))


def _shown(table: xr.Dataset) -> np.ndarray:
    """The runs with the usual law and the usual initial state, of the role that is shown."""
    usual = laws.usual(table)
    roles = table["role"].values.astype(str)
    chosen = (np.flatnonzero(usual & (roles == name)) for name in SHOWN)
    return next((runs for runs in chosen if runs.size), np.flatnonzero(usual))


def _draw_patch(
    axes: Axes, patch: xr.Dataset, name: str, row: xr.Dataset, colours: _Colours
) -> None:
    """A property of the oscillating mode of every frozen instant."""
    axes.plot(
        patch["patch_length"].values / float(row["theory_length"]), patch[name].values, ".",
        markersize=1.8, color=colours[float(row["height"])], rasterized=True,
    )  # fmt: skip


def _draw_twins(axes: Axes, twins: xr.Dataset, name: str, colours: _Colours) -> None:
    """What the twin runs of the usual law measure of the same property."""
    for i in np.flatnonzero(twins["evolution"].values.astype(str) == laws.usual_law(twins)):
        axes.plot(
            float(twins["twin_length"][i] / twins["theory_length"][i]), float(twins[name][i]), "o",
            markersize=4.6, markerfacecolor="none", markeredgewidth=1.0,
            color=colours[float(twins["height"][i])],
        )  # fmt: skip


def _draw_mode(axes: Axes, patch: xr.Dataset, row: xr.Dataset, colours: _Colours) -> None:
    """Modulus of the slip of the mode that begins to grow, over the patch's length then."""
    length = float(row["stability_length"])
    if not np.isfinite(length):
        return
    axes.plot(
        patch["x"].values / length,
        np.hypot(patch["mode_real"].values, patch["mode_imaginary"].values),
        color=colours[float(row["height"])], linewidth=1.0,
    )  # fmt: skip


def _finish_growth(axes: Axes) -> None:
    axes.axhline(0.0, color=style.GUIDE, linewidth=0.7)
    axes.axvline(0.5, color=style.THEORY, linewidth=1.0, linestyle="--")
    axes.text(0.49, 3.4, "$L_c/2$", color=style.THEORY, fontsize=style.SMALL, ha="right")
    axes.set_xlim(*LENGTHS)
    axes.set_ylim(*GROWTH_RANGE)
    axes.set_xlabel("Patch length over theory $L/L_c$")
    axes.set_ylabel(r"Growth rate $\mathrm{Re}\,\Lambda$ (1/s)")


def _finish_frequency(axes: Axes, heights: np.ndarray, colours: _Colours, twins: bool) -> None:
    axes.set_xlim(*LENGTHS)
    axes.set_ylim(*FREQUENCY_RANGE)
    axes.set_xlabel("Patch length over theory $L/L_c$")
    axes.set_ylabel(r"Frequency $\mathrm{Im}\,\Lambda$ (1/s)")
    named = np.linspace(0, heights.size - 1, min(LEGEND_HEIGHTS, heights.size)).round().astype(int)
    for height in heights[named]:
        axes.plot([], [], "-", color=colours[height], label=f"$H={height:g}$ m")
    if twins:
        axes.plot([], [], "o", color="black", markerfacecolor="none", label="twin runs")
    axes.legend(loc="lower left", labelspacing=0.3)


def _finish_shape(axes: Axes) -> None:
    """The homogeneous mode of the theory: a wave of constant modulus, whole in the patch."""
    x = np.linspace(0.0, 1.0, 201)
    axes.plot(x, np.sin(2.0 * np.pi * x), "--", color=style.THEORY, linewidth=1.1)
    axes.axhline(0.0, color=style.GUIDE, linewidth=0.7)
    axes.text(0.05, -0.15, "patch, $L=L_s$:\nhalf a wavelength\n(modulus)", fontsize=style.SMALL,
              va="top")  # fmt: skip
    axes.text(0.95, -1.08, "theory, $L=L_c$: one wavelength", color=style.THEORY,
              fontsize=style.SMALL, ha="right", va="top")  # fmt: skip
    axes.set_xlim(0.0, 1.0)
    axes.set_ylim(-1.35, 1.15)
    axes.set_xlabel("Position over patch length $x/L$")
    axes.set_ylabel("Slip in the mode")
