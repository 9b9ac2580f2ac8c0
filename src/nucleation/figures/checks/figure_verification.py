"""Verification: errors of manufactured solutions against element size and time step."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style

# problem, variable, label, marker, line, colour, colour of the marker's face
SERIES = (
    ("aging", "slip_rate_error", "aging law, slip rate", "o", "-", style.AGING, style.AGING),
    ("aging", "log_state_error", "aging law, state", "o", "--", style.AGING, style.AGING),
    ("slip", "slip_rate_error", "slip law, slip rate", "^", "-", style.SLIP, "none"),
    ("slip", "log_state_error", "slip law, state", "^", "--", style.SLIP, "none"),
    ("elastodynamics", "displacement_error", "elastodynamics, displacement", "D", "-",
     style.BLUE, style.BLUE),
)  # fmt: skip
# refinement, its spacing in the dataset, unit of the abscissa, its label, title, order
PANELS = (
    ("mesh", "element_size", 1e-3, "Element size $h$ (mm)", "(a) mesh", 2),
    ("step", "step_size", 1e-6, r"Time step $\Delta t$ (µs)", "(b) step, waves resolved", 2),
    ("quasi_static_step", "quasi_static_step_size", 1e-3, r"Time step $\Delta t$ (ms)",
     "(c) step, quasi-static", 3),
)  # fmt: skip


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
        axes.set_xlabel(label)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xticks(spacing, [f"{value:.3g}" for value in spacing])
        axes.minorticks_off()
        _draw_errors(axes, convergence.sel(refinement=refinement), spacing)
        _draw_slope(axes, spacing, order)
    panels[0].set_ylabel("Error over the solution's scale")
    handles = panels[0].get_legend_handles_labels()
    figure.legend(*handles, loc="outside lower center", ncols=3)
    return figure


def _draw_errors(axes: Axes, errors: xr.Dataset, spacing: np.ndarray) -> None:
    for problem, variable, label, marker, line, colour, face in SERIES:
        error = errors[variable].sel(problem=problem).values
        if np.isfinite(error).all():
            axes.plot(
                spacing, error, marker, linestyle=line, color=colour, markerfacecolor=face,
                markersize=6.5 if face == "none" else 3.8, linewidth=1.0, label=label,
            )  # fmt: skip


def _draw_slope(axes: Axes, spacing: np.ndarray, order: int) -> None:
    """A line of the expected order below the errors."""
    lowest = min(np.min(np.asarray(line.get_ydata())) for line in axes.get_lines())
    ends = np.array([spacing.min(), 0.5 * spacing.max()])
    line = 0.35 * lowest * (ends / ends[0]) ** order
    axes.plot(ends, line, color=style.GUIDE, linewidth=1.0, linestyle=":")
    middle = np.sqrt(ends.prod()), np.sqrt(line.prod())
    axes.annotate(
        f"slope {order}", middle, xytext=(5, -5), textcoords="offset points", va="top",
        color=style.GUIDE, fontsize=style.SMALL,
    )  # fmt: skip
