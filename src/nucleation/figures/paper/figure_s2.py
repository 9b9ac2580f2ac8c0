"""Figure S2: space-time image of the interfacial shear stress, and the driving force."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ...analysis.lengths import row
from ...analysis.record import parameters_of
from ...figures import style

PIXELS = 1200  # pixel columns of the widest image: more could not be seen
EVENT_LEVEL = 0.01  # the event's panel shows slip rates above this part of the highest
KILO = 1e3

Window = tuple[float, float, float, float]
"""What a time axis shows: from, to and origin (s), and scale."""


@style.styled
def draw(simulation: xr.Dataset, row: xr.Dataset) -> Figure:
    """Draw ``tau / sigma_0`` over time and x, and the applied force below it.

    On the left all of the record, on the right the event in milliseconds; only x that the slip
    reached, and some beyond.

    Parameters
    ----------
    simulation : Dataset
        With ``shear_stress(time, x)`` (Pa), ``slip(time, x)`` (m), ``driving_force(step)``
        (N/m, negative in compression), ``maximal_slip_rate(step)`` (m/s), ``step_time(step)``
        (s), and the attribute ``parameters`` (JSON), for ``sigma_0``.
    row : Dataset
        The simulation's entry of the lengths: ``onset_time`` (s), and ``length``,
        ``length_low`` and ``length_high`` (m).
    """
    figure, panels = style.panels(2, 2, 10.2, sharex="col", width_ratios=(2.1, 1.0))
    panels[0, 1].sharey(panels[0, 0])
    ratio = simulation["shear_stress"] / parameters_of(simulation).loading.normal_stress
    ratio = ratio.sel(x=slice(None, slipped_extent(simulation)))
    norm = Normalize(min(0.0, float(ratio.quantile(0.001))), float(ratio.quantile(0.999)))
    time = simulation["time"].values
    start, peak, end = event_window(simulation, float(row["onset_time"]))
    windows = ((time[0], time[-1], 0.0, 1.0), (start, end, peak, KILO))  # seconds, milliseconds
    for (image, force), window in zip(panels.T, windows, strict=True):
        first, last, origin, scale = window
        part = ratio.isel(time=thin(time, first, last, PIXELS)).transpose("x", "time")
        # cells end half way between their centres, and at the outer centres
        at, x = (
            np.r_[own[0], (own[1:] + own[:-1]) / 2.0, own[-1]]
            for own in (part["time"].values, part["x"].values)
        )
        edges = (at - origin) * scale, x
        mesh = image.pcolormesh(*edges, part.values, norm=norm, rasterized=True)
        draw_force(force, simulation, window, 0.0 if origin == 0.0 else np.inf)
        _mark(image, force, row, window)
    figure.colorbar(mesh, ax=panels[0, :], label=r"$\tau/\sigma_0$", pad=0.01, extend="both")
    _label(panels, row)
    return figure


def slipped_extent(simulation: xr.Dataset) -> float:
    """The x (m) up to which the slip from x = 0 reached by the end, with a third added."""
    slip = simulation["slip"].isel(time=-1).values
    sticking = np.flatnonzero(slip < 0.005 * np.nanmax(slip))
    x = simulation["x"].values
    if sticking.size == 0 or sticking[0] == 0:
        return float(x[-1])
    return float(min(1.33 * x[sticking[0]], x[-1]))


def event_window(simulation: xr.Dataset, onset: float) -> tuple[float, float, float]:
    """Start (with a margin), time of the highest slip rate, and end of the first event (s)."""
    time = simulation["step_time"].values
    rate = simulation["maximal_slip_rate"].values
    after = ~(time < onset)  # all of the record if there is no onset
    fast = np.flatnonzero(after & (rate >= EVENT_LEVEL * np.max(rate[after])))
    # The first run of fast steps: a later event, or a reflection, starts after a gap.
    gap = np.flatnonzero(np.diff(time[fast]) > 0.1)
    fast = fast[: gap[0] + 1] if gap.size else fast
    start, end = float(time[fast[0]]), float(time[fast[-1]])
    margin = max(0.5 * (end - start), 1e-6)
    return start - margin, float(time[fast[np.argmax(rate[fast])]]), end + margin


def thin(time: NDArray, start: float, end: float, columns: int) -> NDArray:
    """Indices of the increasing times to draw from `start` to `end` with so many columns of pixels.

    Of the times that fall into one column the first is kept, so that a fast event stays a step at
    its true time. One time beyond either end is kept, to fill the panel.
    """
    first = max(int(np.searchsorted(time, start, side="right")) - 1, 0)
    last = min(int(np.searchsorted(time, end, side="left")) + 1, time.size)
    column = np.floor((time[first:last] - start) / (end - start) * columns)
    return first + np.flatnonzero(np.diff(column, prepend=-np.inf) > 0.0)


def draw_force(axes: Axes, record: xr.Dataset, window: Window, least: float = np.inf) -> None:
    """The driving force, counted positive in compression (kN/m), with limits for a window.

    `least` is a force that is shown as well.
    """
    start, end, origin, scale = window
    time, force = record["step_time"].values, -record["driving_force"].values / KILO
    axes.plot((time - origin) * scale, force, color=style.DRIVE, linewidth=1.2)
    seen = force[(time >= start) & (time <= end)]
    low, high = min(least, seen.min()), seen.max()
    margin = 0.08 * (high - low)
    if margin > 0.0:
        axes.set_ylim(low - (margin if low else 0.0), high + margin)
    if end > start:
        axes.set_xlim((start - origin) * scale, (end - origin) * scale)


def _mark(image: Axes, force: Axes, row: xr.Dataset, window: Window) -> None:
    """The onset, dotted; the critical length, dashed, and its error bar at the onset."""
    onset = (float(row["onset_time"]) - window[2]) * window[3]
    length, low, high = (float(row[key]) for key in ("length", "length_low", "length_high"))
    thin_line: Any = {"color": "white", "linewidth": 0.9}
    image.axhline(length, linestyle="--", **thin_line)
    image.axvline(onset, linestyle=":", **thin_line)
    bars = [[length - low], [high - length]]
    image.errorbar([onset], [length], bars, marker="o", ms=3.5, color="white", elinewidth=0.9)
    force.axvline(onset, color=style.GUIDE, linestyle=":", linewidth=0.9)


def _label(panels: NDArray, row: xr.Dataset) -> None:
    """Axis labels, panel letters, and the names of the marks on the left."""
    (image, zoom), (force, last) = panels
    image.set_ylabel("Position $x$ (m)")
    force.set(xlabel="Time $t$ (s)", ylabel="Applied force $-f_d$ (kN/m)")
    last.set_xlabel("Time from the highest slip rate (ms)")
    zoom.tick_params(labelleft=False)
    last.yaxis.set_ticks_position("both")
    last.tick_params(labelleft=False, labelright=True)
    for axes in (image, zoom):  # ticks inside would be lost on the dark image
        axes.tick_params(direction="out", top=False, right=False)
    style.letters(*panels.flat, pad=3.0)
    beside: Any = {"textcoords": "offset points", "va": "bottom"}
    if np.isfinite(row["length"]):
        place = (0.0, float(row["length"])), (5.0, 1.0), image.get_yaxis_transform()
        image.annotate("$L_c$", *place, color="white", **beside)
    if np.isfinite(row["onset_time"]):
        place = (float(row["onset_time"]), 0.0), (-4.0, 5.0), force.get_xaxis_transform()
        force.annotate("onset", *place, color=style.GUIDE, ha="right", **beside)


def draw_run(lengths: xr.Dataset, simulation: xr.Dataset, id: str) -> Figure:
    """The step ``draw_figure_s2``: one of the runs of a table."""
    return draw(simulation, row(lengths, id))
