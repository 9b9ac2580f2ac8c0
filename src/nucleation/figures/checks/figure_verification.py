"""Verification: errors of manufactured solutions against element size and time step."""

from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style
from ...types import Array

_AGING: style.Options = {"marker": "o", "color": style.AGING, "ms": 3.8}
_SLIP: style.Options = {
    "marker": "^",
    "color": style.SLIP,
    "mfc": "none",
    "ms": 6.5,
}
_BODY: style.Options = {"marker": "D", "color": style.BLUE, "ms": 3.8}


class _Series(NamedTuple):
    problem: str
    variable: str
    label: str
    look: style.Options


_SERIES = (
    _Series(
        "aging",
        "slip_rate_error",
        "aging law, slip rate",
        _AGING | {"ls": "-"},
    ),
    _Series(
        "aging",
        "log_state_error",
        "aging law, state",
        _AGING | {"ls": "--"},
    ),
    _Series(
        "slip",
        "slip_rate_error",
        "slip law, slip rate",
        _SLIP | {"ls": "-"},
    ),
    _Series(
        "slip",
        "log_state_error",
        "slip law, state",
        _SLIP | {"ls": "--"},
    ),
    _Series(
        "elastodynamics",
        "displacement_error",
        "elastodynamics, displacement",
        _BODY,
    ),
)


class _Panel(NamedTuple):
    refinement: str
    spacing: str  # variable of the dataset
    unit: float  # of the abscissa, in SI units
    label: str
    title: str
    order: int


_PANELS = (
    _Panel(
        refinement="mesh",
        spacing="element_size",
        unit=1e-3,
        label="Element size $h$ (mm)",
        title="(a) mesh",
        order=2,
    ),
    _Panel(
        refinement="step",
        spacing="step_size",
        unit=1e-6,
        label=r"Time step $\Delta t$ (µs)",
        title="(b) step, waves resolved",
        order=2,
    ),
    _Panel(
        refinement="quasi_static_step",
        spacing="quasi_static_step_size",
        unit=1e-3,
        label=r"Time step $\Delta t$ (ms)",
        title="(c) step, quasi-static",
        order=3,
    ),
)


@style.styled
def draw(convergence: xr.Dataset) -> Figure:
    """Draw errors against ``h`` and ``dt``, with the slopes of the expected orders.

    Parameters
    ----------
    convergence : Dataset
        From :func:`nucleation.verification.orders.convergence_dataset`: dimensionless errors on
        (problem, refinement, level); ``element_size`` (m), ``step_size`` and
        ``quasi_static_step_size`` (s) on level.

    Returns
    -------
    Figure
        Three panels.
    """
    figure, panels = style.panels(1, len(_PANELS), 8.2, sharey=True)
    for axes, panel in zip(panels, _PANELS, strict=True):
        spacing = convergence[panel.spacing].values / panel.unit
        axes.set_title(panel.title, loc="left")
        axes.set(xscale="log", yscale="log", xlabel=panel.label)
        axes.set_xticks(spacing, [f"{value:.3g}" for value in spacing])
        axes.minorticks_off()
        errors = convergence.sel(refinement=panel.refinement)
        for problem, variable, label, look in _SERIES:
            error = errors[variable].sel(problem=problem).values
            if np.isfinite(error).all():
                axes.plot(spacing, error, linewidth=1.0, label=label, **look)
        _draw_slope(axes, spacing, panel.order)
    panels[0].set_ylabel("Error over the solution's scale")
    handles = panels[0].get_legend_handles_labels()
    figure.legend(*handles, loc="outside lower center", ncols=3)
    return figure


def _draw_slope(axes: Axes, spacing: Array, order: int) -> None:
    """A line of the expected order below the errors."""
    lowest = min(np.min(np.asarray(line.get_ydata())) for line in axes.get_lines())
    ends = np.array([spacing.min(), 0.5 * spacing.max()])
    line = 0.35 * lowest * (ends / ends[0]) ** order
    axes.plot(ends, line, color=style.GUIDE, linewidth=1.0, linestyle=":")
    axes.annotate(
        f"slope {order}",
        (np.sqrt(ends.prod()), np.sqrt(line.prod())),
        (5, -5),
        textcoords="offset points",
        va="top",
        color=style.GUIDE,
        fontsize=style.SMALL,
    )
