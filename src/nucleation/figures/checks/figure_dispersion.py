"""Dispersion: growth and frequency of single modes, time integration against Eq. (5)."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style

# marker and line: along +x and -x
BRANCHES: tuple[tuple[str, Any], ...] = (("o", "-"), ("s", (0, (4, 1.5))))


@style.styled
def draw(dispersion: xr.Dataset) -> Figure:
    """Draw growth rates and frequencies against ``k/k_c``, one colour for each height.

    Parameters
    ----------
    dispersion : Dataset
        From :func:`nucleation.verification.dispersion.dispersion_dataset`: rates (1/s) on (height,
        mode, branch) and (height, curve, branch), wavenumbers (1/m), ``memory_time`` (s).
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 9.6 * style.CENTIMETRE)
    layout: Any = figure.get_layout_engine()
    layout.set(wspace=0.05)
    growth, frequency = figure.subplots(1, 2, sharex=True)
    heights = dispersion["height"].values
    shades = style.shades(heights.size)
    for i, shade in enumerate(shades):
        one = dispersion.isel(height=i)
        for axes, name in ((growth, "growth"), (frequency, "frequency")):
            _draw_height(axes, one, name, shade)
    growth.axhline(0.0, color=style.GUIDE, linewidth=0.7)
    style.letters(growth, frequency)
    for axes in (growth, frequency):
        axes.axvline(1.0, color=style.GUIDE, linestyle="--", linewidth=0.9)
        axes.set_xlabel(r"Wavenumber $k/k_c$")
        axes.minorticks_on()
    growth.set_ylabel(r"Growth rate $\mathrm{Re}\,\Lambda\, D/V$")
    frequency.set_ylabel(r"Angular frequency $\mathrm{Im}\,\Lambda\, D/V$")
    modes = (dispersion["mode_wavenumber"] / dispersion["critical_wavenumber"]).values
    margin = 0.04 * (modes.max() - modes.min())
    growth.set_xlim(modes.min() - margin, modes.max() + margin)
    for axes in (growth, frequency):
        _limit_to_lines(axes)
    _legend(figure, heights, shades)
    return figure


def _draw_height(axes: Axes, one: xr.Dataset, name: str, shade: tuple[float, ...]) -> None:
    critical, unit = float(one["critical_wavenumber"]), float(one["memory_time"])
    curve, modes = one["curve_wavenumber"] / critical, one["mode_wavenumber"] / critical
    lines = (one[f"curve_{name}"] * unit).transpose("curve", "branch").values
    marks = (one[f"measured_{name}"] * unit).transpose("mode", "branch").values
    for branch, (marker, dash) in enumerate(BRANCHES):
        axes.plot(curve, lines[:, branch], color=shade, linestyle=dash, linewidth=1.0)
        axes.plot(
            modes, marks[:, branch], marker, color=shade, markersize=3.6, markerfacecolor="white",
            markeredgewidth=0.9,
        )  # fmt: skip


def _limit_to_lines(axes: Axes) -> None:
    """Limit the ordinate so that nothing within the abscissa's limits is cut."""
    left, right = axes.get_xlim()
    shown = []
    for line in axes.get_lines():
        x, y = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
        if line.get_transform() == axes.transData:
            shown.append(y[(x >= left) & (x <= right)])
    low, high = np.concatenate(shown).min(), np.concatenate(shown).max()
    axes.set_ylim(low - 0.04 * (high - low), high + 0.04 * (high - low))


def _legend(figure: Figure, heights: np.ndarray, shades: list[tuple[float, ...]]) -> None:
    keys = [
        style.key(f"$H={height:.3g}$ m", "", "-", shade)
        for height, shade in zip(heights, shades, strict=True)
    ]
    keys += [
        style.key(f"mode along {direction}", marker, dash, markersize=3.6, **style.OPEN)
        for direction, (marker, dash) in zip(("$+x$", "$-x$"), BRANCHES, strict=True)
    ]
    keys += [style.key("lines: Eq. (5)"), style.key("symbols: time integration")]
    figure.legend(handles=keys, loc="outside lower center", ncols=4)
