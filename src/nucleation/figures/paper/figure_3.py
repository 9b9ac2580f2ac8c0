"""Figure 3: the critical length against the block's height, theory and simulations."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...analysis.lengths import over_realisations, row
from ...figures import laws, points, slip_rate_snapshots, style
from ...figures.laws import Look


class Study(NamedTuple):
    """How the points of one role are filled, and what the legend adds for them."""

    filled: bool
    suffix: str


BESIDE = 1.8
"""Points (1/72 inch) by which the bars of filled and open markers stand apart, of one height."""

Series = tuple[Study, str, Look, xr.Dataset]  # style, legend, marker, entries of the table

# The inset, in parts of the axes: the points rise to the right and leave this corner free.
INSET_LEFT, INSET_BOTTOM, INSET_WIDTH = 0.515, 0.1, 0.315
INSET_HEIGHTS = (0.2, 0.4)

# By role: only studies with these are drawn; a table of lengths may hold others.
STUDIES: dict[str, Study] = {
    "paper": Study(filled=True, suffix=""),
    "converged": Study(filled=False, suffix=r", load $\pm 10^{-5}$"),
}


@style.styled
def draw(
    theory: xr.Dataset,
    lengths: xr.Dataset,
    inset_simulation: xr.Dataset,
    inset_row: xr.Dataset,
    studies: Mapping[str, Study] = STUDIES,
) -> Figure:
    """Draw ``L_c(H)`` with the simulations as points, and slip-rate snapshots as an inset.

    Parameters
    ----------
    theory : Dataset
        With ``critical_length(height)`` and ``thin_limit_length(height)`` (m).
    lengths : Dataset
        One entry on dimension ``run`` per simulation, with ``role``, ``evolution``, ``height`` (m),
        ``phi0`` (s) and ``length``, ``length_low``, ``length_high`` (m); entries without a
        finite length are left out, and realisations of one fault drawn by their mean.
    inset_simulation : Dataset
        The simulation whose slip rate the inset shows.
    inset_row : Dataset
        Its entry of `lengths`, of which ``onset_time`` (s) and ``length`` (m) are marked.
    studies : mapping
        The studies to draw, by role.
    """
    figure, axes = style.panels(1, 1, 12.4)
    draw_theory(axes, theory)
    drawn = list(_series(over_realisations(lengths), studies))
    for series in drawn:
        _draw_points(axes, *series)
    _limits(axes, theory, drawn)
    axes.set_xlabel("Height $H$ (m)")
    axes.set_ylabel("Critical nucleation length $L_c$ (m)")
    axes.legend(loc="upper left", labelspacing=0.35)
    inset = axes.inset_axes((INSET_LEFT, INSET_BOTTOM, INSET_WIDTH, _inset_height(axes, drawn)))
    slip_rate_snapshots.draw(inset, inset_simulation, inset_row)
    return figure


def draw_theory(axes: Axes, theory: xr.Dataset) -> None:
    """The prediction, solid, and its limit for thin blocks, dashed."""
    for name, look in (
        ("critical_length", {"label": "theory"}),
        ("thin_limit_length", {"label": r"theory, $Hk\to 0$", "linestyle": "--", "linewidth": 1.1}),
    ):
        axes.plot(theory["height"].values, theory[name].values, color=style.THEORY, **look)


def _limits(axes: Axes, theory: xr.Dataset, drawn: list[Series]) -> None:
    """Axes from zero to a little beyond the highest block that was simulated."""
    simulated = [float(runs["height"].max()) for *_, runs in drawn]
    highest = 1.12 * max(simulated, default=float(theory["height"].max()))
    longest = np.interp(highest, theory["height"].values, theory["thin_limit_length"].values)
    axes.set_xlim(0.0, highest)
    axes.set_ylim(0.0, 1.04 * float(longest))
    axes.minorticks_on()


def _inset_height(axes: Axes, drawn: list[Series]) -> float:
    """Height of the inset, in parts of the axes: up to the lowest point above it."""
    left = (INSET_LEFT - 0.02) * axes.get_xlim()[1]
    above = [runs["length_low"].where(runs["height"] > left).min() for *_, runs in drawn]
    lowest = np.nanmin([*map(float, above), axes.get_ylim()[1]])
    room = lowest / axes.get_ylim()[1] - INSET_BOTTOM - 0.03
    return float(np.clip(room, *INSET_HEIGHTS))


def _series(lengths: xr.Dataset, studies: Mapping[str, Study]) -> Iterator[Series]:
    """The sets of points that share role, law and initial state: style, label and entries."""
    usable = points.where(lengths, np.isfinite(lengths["length"].values))
    for role, study in studies.items():
        for (_, old), kind, runs in laws.kinds(usable):
            own = points.where(runs, role=role).sortby("phi0")
            for same in points.groups(own, "phi0"):
                age = _number(float(same["phi0"][0]))
                state = f", $\\phi(t\\!=\\!0)={age}$ s" if old else ""
                yield study, f"FEM, {kind.label}{state}{study.suffix}", kind, same


def _draw_points(axes: Axes, study: Study, label: str, kind: Look, runs: xr.Dataset) -> None:
    """One set of points with error bars from the lowest to the highest length."""
    look: Any = {"marker": kind.marker, "markersize": kind.size, "color": kind.colour}
    look["markerfacecolor"] = kind.colour if study.filled else "white"
    look["transform"] = style.aside(axes, -BESIDE if study.filled else BESIDE)
    order = 4.0 - 0.1 * kind.size
    points.draw(axes, runs["height"].values, runs, "length", label=label, zorder=order, **look)


def _number(value: float) -> str:
    """A number as TeX, a power of ten where that is shorter."""
    exponent = np.log10(value)
    if exponent >= 3.0 and exponent == round(exponent):
        return f"10^{{{exponent:.0f}}}"
    return f"{value:g}"


def draw_run(theory: xr.Dataset, lengths: xr.Dataset, simulation: xr.Dataset, id: str) -> Figure:
    """The step ``draw_figure_3``: with one of the runs in the inset."""
    return draw(theory, lengths, simulation, row(lengths, id))
