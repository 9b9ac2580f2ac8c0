"""Verification: errors of manufactured solutions against element size and time step."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style

LINES = (("slip_rate_error", "slip rate", "-"), ("log_state_error", "state", "--"))
LAWS: Any = (
    ("aging", {"marker": "o", "color": style.AGING, "ms": 3.8}),
    ("slip", {"marker": "^", "color": style.SLIP, "mfc": "none", "ms": 6.5}),
)
SERIES: Any = [
    (law, name, f"{law} law, {of}", look | {"ls": line})
    for law, look in LAWS
    for name, of, line in LINES
]
BODY: Any = {"marker": "D", "color": style.BLUE, "ms": 3.8}
SERIES += [("elastodynamics", "displacement_error", "elastodynamics, displacement", BODY)]
"""Problem, variable, label and look."""

# refinement, its spacing in the dataset, unit of the abscissa, its label, title, order
STEP = r"Time step $\Delta t$ (ms)"
PANELS = (
    ("mesh", "element_size", 1e-3, "Element size $h$ (mm)", "(a) mesh", 2),
    ("step", "step_size", 1e-6, r"Time step $\Delta t$ (µs)", "(b) step, waves resolved", 2),
    ("quasi_static_step", "quasi_static_step_size", 1e-3, STEP, "(c) step, quasi-static", 3),
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
    """
    figure, panels = style.panels(1, len(PANELS), 8.2, sharey=True)
    for axes, (refinement, name, unit, label, title, order) in zip(panels, PANELS, strict=True):
        spacing = convergence[name].values / unit
        axes.set_title(title, loc="left")
        axes.set(xscale="log", yscale="log", xlabel=label)
        axes.set_xticks(spacing, [f"{value:.3g}" for value in spacing])
        axes.minorticks_off()
        errors = convergence.sel(refinement=refinement)
        for problem, variable, name, look in SERIES:
            error = errors[variable].sel(problem=problem).values
            if np.isfinite(error).all():
                axes.plot(spacing, error, linewidth=1.0, label=name, **look)
        _draw_slope(axes, spacing, order)
    panels[0].set_ylabel("Error over the solution's scale")
    handles = panels[0].get_legend_handles_labels()
    figure.legend(*handles, loc="outside lower center", ncols=3)
    return figure


def _draw_slope(axes: Axes, spacing: np.ndarray, order: int) -> None:
    """A line of the expected order below the errors."""
    lowest = min(np.min(np.asarray(line.get_ydata())) for line in axes.get_lines())
    ends = np.array([spacing.min(), 0.5 * spacing.max()])
    line = 0.35 * lowest * (ends / ends[0]) ** order
    axes.plot(ends, line, color=style.GUIDE, linewidth=1.0, linestyle=":")
    middle = np.sqrt(ends.prod()), np.sqrt(line.prod())
    look: Any = {"va": "top", "color": style.GUIDE, "fontsize": style.SMALL}
    axes.annotate(f"slope {order}", middle, (5, -5), textcoords="offset points", **look)
