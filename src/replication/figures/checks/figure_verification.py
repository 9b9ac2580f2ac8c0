"""Verification: errors of manufactured solutions against element size and time step."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.pictures import style
from nucleation.types import Array

_AGING: style.Options = {"marker": "o", "color": style.AGING, "ms": 3.8}
_SLIP: style.Options = {"marker": "^", "color": style.SLIP, "mfc": "none", "ms": 6.5}
_BODY: style.Options = {"marker": "D", "color": style.BLUE, "ms": 3.8}

_SERIES: tuple[tuple[str, str, str, str, style.Options], ...] = (
    ("aging", "slip_rate_error", "aging law, slip rate", "-", _AGING),
    ("aging", "log_state_error", "aging law, state", "--", _AGING),
    ("slip", "slip_rate_error", "slip law, slip rate", "-", _SLIP),
    ("slip", "log_state_error", "slip law, state", "--", _SLIP),
    ("elastodynamics", "displacement_error", "elastodynamics, displacement", "-", _BODY),
)
"""Problem, variable, label, line and marks of each error."""

_PANELS = (
    ("mesh", "element_size", 1e-3, "(a) mesh", "Element size $h$ (mm)", 2),
    ("step", "step_size", 1e-6, "(b) step, waves resolved", r"Time step $\Delta t$ (µs)", 2),
    (
        "quasi_static_step",
        "quasi_static_step_size",
        1e-3,
        "(c) step, quasi-static",
        r"Time step $\Delta t$ (ms)",
        3,
    ),
)
"""Refinement, its variable and the unit of the abscissa (SI), title, label, expected order."""


@style.styled
def draw(convergence: xr.Dataset) -> Figure:
    """Draw errors against ``h`` and ``dt``, with the slopes of the expected orders.

    Parameters
    ----------
    convergence : Dataset
        From :func:`replication.verification.orders.convergence_dataset`: dimensionless errors on
        (problem, refinement, level); ``element_size`` (m), ``step_size`` and
        ``quasi_static_step_size`` (s) on level.

    Returns
    -------
    Figure
        Three panels.
    """
    figure, panels = style.panels(1, len(_PANELS), 8.2, sharey=True)
    for axes, panel in zip(panels, _PANELS, strict=True):
        refinement, variable, unit, title, abscissa, order = panel
        spacing = convergence[variable].values / unit
        axes.set(xscale="log", yscale="log", xlabel=abscissa, title=title)
        axes.set_xticks(spacing, [f"{value:.3g}" for value in spacing])
        axes.minorticks_off()
        errors = convergence.sel(refinement=refinement)
        for problem, name, label, line, look in _SERIES:
            error = errors[name].sel(problem=problem)
            if np.isfinite(error).all():
                axes.plot(spacing, error, linestyle=line, linewidth=1.0, label=label, **look)
        _draw_slope(axes, spacing, order)
    panels[0].set_ylabel("Error over the solution's scale")
    handles = panels[0].get_legend_handles_labels()
    figure.legend(*handles, loc="outside lower center", ncols=3)
    return figure


def _draw_slope(
    axes: Axes,
    spacing: Array,
    order: int,
) -> None:
    """A line of the expected order below the errors."""
    lowest = min(np.min(np.asarray(line.get_ydata())) for line in axes.get_lines())
    ends = np.array([spacing.min(), 0.5 * spacing.max()])
    line = 0.35 * lowest * (ends / ends[0]) ** order
    axes.plot(ends, line, color=style.GUIDE, linewidth=1.0, linestyle=":")
    place = (np.sqrt(ends.prod()), np.sqrt(line.prod()))
    style.note(axes, f"slope {order}", place, (5, -5), va="top", color=style.GUIDE)
