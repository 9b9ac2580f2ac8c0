"""Dispersion: growth and frequency of single modes, time integration against Eq. (5)."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style

# marker and line: along +x and -x
BRANCHES: tuple[tuple[str, Any], ...] = (("o", "-"), ("s", (0, (4, 1.5))))
PANELS = (
    ("growth", r"Growth rate $\mathrm{Re}\,\Lambda\, D/V$"),
    ("frequency", r"Angular frequency $\mathrm{Im}\,\Lambda\, D/V$"),
)


@style.styled
def draw(dispersion: xr.Dataset) -> Figure:
    """Draw growth rates and frequencies against ``k/k_c``, one colour for each height.

    Parameters
    ----------
    dispersion : Dataset
        From :func:`nucleation.verification.dispersion.dispersion_dataset`: rates (1/s) on (height,
        mode, branch) and (height, curve, branch), wavenumbers (1/m), ``memory_time`` (s).
    """
    figure, panels = style.panels(1, 2, 9.6, sharex=True)
    layout: Any = figure.get_layout_engine()
    layout.set(wspace=0.05)
    heights = dispersion["height"].values
    shades = style.shades(heights.size)
    modes = (dispersion["mode_wavenumber"] / dispersion["critical_wavenumber"]).values
    margin = 0.04 * (modes.max() - modes.min())
    for axes, (name, label) in zip(panels, PANELS, strict=True):
        for i, shade in enumerate(shades):
            _draw_height(axes, dispersion.isel(height=i), name, shade)
        axes.axvline(1.0, color=style.GUIDE, linestyle="--", linewidth=0.9)
        axes.set(xlabel=r"Wavenumber $k/k_c$", ylabel=label)
        axes.set_xlim(modes.min() - margin, modes.max() + margin)
        _limit_to_lines(axes)
    style.level(panels[0], 0.0)
    style.letters(*panels, minor=True)
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
    return figure


def _draw_height(axes: Axes, one: xr.Dataset, name: str, shade: tuple[float, ...]) -> None:
    critical, unit = float(one["critical_wavenumber"]), float(one["memory_time"])
    curve, modes = one["curve_wavenumber"] / critical, one["mode_wavenumber"] / critical
    lines = (one[f"curve_{name}"] * unit).transpose("curve", "branch").values
    marks = (one[f"measured_{name}"] * unit).transpose("mode", "branch").values
    for branch, (marker, dash) in enumerate(BRANCHES):
        axes.plot(curve, lines[:, branch], color=shade, linestyle=dash, linewidth=1.0)
        look: Any = {"color": shade, "ms": 3.6, "mew": 0.9, **style.OPEN}
        axes.plot(modes, marks[:, branch], marker, **look)


def _limit_to_lines(axes: Axes) -> None:
    """Limit the ordinate so that nothing within the abscissa's limits is cut."""
    left, right = axes.get_xlim()
    shown = []
    for line in axes.get_lines():
        if line.get_transform() == axes.transData:
            x, y = np.asarray(line.get_xydata()).T
            shown += [*y[(x >= left) & (x <= right)]]
    margin = 0.04 * (max(shown) - min(shown))
    axes.set_ylim(min(shown) - margin, max(shown) + margin)
