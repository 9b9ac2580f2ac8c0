"""Dispersion: growth and frequency of single modes, time integration against Eq. (5)."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.lines import Line2D

from nucleation.pictures import style
from nucleation.types import Array

_LineStyle = str | tuple[int, tuple[float, float]]

# direction, marker and line
_BRANCHES: tuple[tuple[str, str, _LineStyle], ...] = (
    ("$+x$", "o", "-"),
    ("$-x$", "s", (0, (4, 1.5))),
)
_PANELS = (
    ("growth", r"Growth rate $\mathrm{Re}\,\Lambda\, D/V$"),
    ("frequency", r"Angular frequency $\mathrm{Im}\,\Lambda\, D/V$"),
)


@style.styled
def draw(dispersion: xr.Dataset) -> Figure:
    """Draw growth rates and frequencies against ``k/k_c``, one colour for each height.

    Parameters
    ----------
    dispersion : Dataset
        From :func:`replication.verification.dispersion.dispersion_dataset`: rates (1/s) on (height,
        mode, branch) and (height, curve, branch), wavenumbers (1/m), ``memory_time`` (s).

    Returns
    -------
    Figure
        Two panels.
    """
    figure, panels = style.panels(1, 2, 9.6, sharex=True)
    layout = figure.get_layout_engine()
    assert isinstance(layout, ConstrainedLayoutEngine)
    layout.set(wspace=0.05)
    heights = dispersion["height"].values
    shades = style.shades(heights.size)
    modes = (dispersion["mode_wavenumber"] / dispersion["critical_wavenumber"]).values
    margin = 0.04 * (modes.max() - modes.min())
    for axes, (name, label) in zip(panels, _PANELS, strict=True):
        for i, shade in enumerate(shades):
            _draw_height(axes, dispersion.isel(height=i), name, shade)
        style.vertical(axes, 1.0)
        axes.set(xlabel=r"Wavenumber $k/k_c$", ylabel=label)
        axes.set_xlim(modes.min() - margin, modes.max() + margin)
        _limit_to_lines(axes)
    style.level(panels[0], 0.0)
    style.letters(*panels, minor=True)
    figure.legend(handles=_keys(heights), loc="outside lower center", ncols=4)
    return figure


def _keys(heights: Array) -> list[Line2D]:
    keys = []
    for height, shade in zip(heights, style.shades(heights.size), strict=True):
        keys.append(style.key(f"$H={height:.3g}$ m", "", "-", shade))
    for direction, marker, line in _BRANCHES:
        label = f"mode along {direction}"
        keys.append(style.key(label, marker, line, markersize=3.6, **style.OPEN))
    keys.append(style.key("lines: Eq. (5)"))
    keys.append(style.key("symbols: time integration"))
    return keys


def _draw_height(
    axes: Axes,
    one: xr.Dataset,
    name: str,
    shade: tuple[float, ...],
) -> None:
    critical = float(one["critical_wavenumber"])
    memory_time = float(one["memory_time"])
    curve = one["curve_wavenumber"] / critical
    modes = one["mode_wavenumber"] / critical
    theory = (one[f"curve_{name}"] * memory_time).transpose("curve", "branch").values
    measured = (one[f"measured_{name}"] * memory_time).transpose("mode", "branch").values
    for branch, (_, marker, line) in enumerate(_BRANCHES):
        axes.plot(
            curve,
            theory[:, branch],
            color=shade,
            linestyle=line,
            linewidth=1.0,
        )
        axes.plot(modes, measured[:, branch], marker, color=shade, ms=3.6, mew=0.9, **style.OPEN)


def _limit_to_lines(axes: Axes) -> None:
    """Choose the ordinate's limits so that all points within the abscissa's limits are visible."""
    left, right = axes.get_xlim()
    shown: list[float] = []
    for line in axes.get_lines():
        if line.get_transform() == axes.transData:
            x, y = np.asarray(line.get_xydata()).T
            shown += [*y[(x >= left) & (x <= right)]]
    margin = 0.04 * (max(shown) - min(shown))
    axes.set_ylim(min(shown) - margin, max(shown) + margin)
