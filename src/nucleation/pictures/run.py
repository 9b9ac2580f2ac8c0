"""Picture of a run: shear stress in space and time, and the driving force."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..extraction.extraction import Record, parameters_of
from ..model.units import sizes, unit_for
from ..types import Array
from . import style

_PIXELS = 1200  # pixel columns of the widest image: more are invisible
_EVENT_LEVEL = 0.01  # the event's panel shows slip rates above this part of the highest
_GAP = 2.0  # D/V without fast slip, after which another event begins
_LONG_TIMES = {"yr": "years", "d": "days", "h": "h"}  # from two of them on, and their names


@style.styled()
def draw(simulation: xr.Dataset, row: xr.Dataset, symbol: str = "$L$") -> Figure:
    """Draw ``tau / sigma_0`` over time and x, and the applied force below it.

    The left column shows the whole record, the right column the event. Positions that the slip did
    not reach are left out, except a margin. `row` has the event as of ``extract``: ``onset_time``
    (s), ``length``, ``length_low`` and ``length_high`` (m); `symbol` is the length's.
    """
    Record(simulation).require("slip", "shear_stress")
    figure, panels = style.panels(10.2, rows=2, columns=2, sharex="col", width_ratios=(2.1, 1.0))
    (image, zoom), (force, last) = panels
    style.letters(*panels.flat)
    zoom.sharey(image)
    ratio = simulation["shear_stress"] / parameters_of(simulation).fault.normal_stress
    ratio = ratio.sel(x=slice(None, slipped_extent(simulation))).transpose("x", "time")
    norm = Normalize(min(0.0, float(ratio.quantile(0.001))), float(ratio.quantile(0.999)))
    time = simulation["time"].values
    scale, unit = prefixed(float(np.abs(simulation["driving_force"]).max()), "N/m")
    force.set_ylabel(f"Applied force $-f_d$ ({unit})")
    onset = float(row["onset_time"])
    start, peak, end = event_window(simulation, onset)
    for column, span, label in (
        (panels[:, 0], (time[0], time[-1], 0.0), "Time $t$"),
        (panels[:, 1], (start, end, peak), "Time from the highest slip rate"),
    ):
        unit = _draw_span(column, simulation, scale, row, ratio, norm, span)
        column[1].set_xlabel(f"{label} ({unit})")
    colours = image.collections[0]
    figure.colorbar(colours, ax=panels[0], label=r"$\tau/\sigma_0$", pad=0.01, extend="both")
    image.set_ylabel("Position $x$ (m)")
    zoom.tick_params(labelleft=False)
    last.tick_params(labelleft=False, labelright=True)
    for axes in (image, zoom):  # ticks inside are invisible on the dark image
        axes.tick_params(which="both", direction="out", top=False, right=False)
    if np.isfinite(onset):
        across = {"xycoords": image.get_yaxis_transform(), "color": "white", "fontsize": 9.0}
        style.note(image, symbol, (0.0, float(row["length"])), (5.0, 2.5), **across)
        up = {"xycoords": force.get_xaxis_transform(), "ha": "right", "fontsize": 9.0}
        style.note(force, "onset", (onset * time_unit(time[-1])[0], 0.0), (-4.0, 6.5), **up)
    return figure


def _draw_span(
    column: Sequence[Axes],
    record: xr.Dataset,
    factor: float,
    row: xr.Dataset,
    ratio: xr.DataArray,
    norm: Normalize,
    span: tuple[float, float, float],
) -> str:
    """Stress, force and event over a span: start, end, and zero of its axis (s); its time unit.

    The force, by a factor from N/m, is positive in compression; the axis of the whole run has zero.
    """
    image, below = column
    start, end, origin = span
    scale, unit = time_unit(max(end - origin, origin - start))
    part = ratio.isel(time=thin(ratio["time"].values, start, end, _PIXELS))
    edges = (_edges(part["time"].values) - origin) * scale, _edges(part["x"].values)
    image.pcolormesh(*edges, part.values, norm=norm, rasterized=True)

    onset = (float(row["onset_time"]) - origin) * scale
    length = float(row["length"])
    bars = [[length - float(row["length_low"])], [float(row["length_high"]) - length]]
    image.axhline(length, ls="--", lw=0.9, color="white")
    image.axvline(onset, ls=":", lw=0.9, color="white")
    image.errorbar([onset], [length], bars, marker="o", lw=0.9, color="white")

    time = record["step_time"].values
    force = -factor * record["driving_force"].values
    below.plot((time - origin) * scale, force, color=style.BLUE, lw=1.2)
    below.axvline(onset, ls=":", lw=0.9)
    seen = force[(time >= start) & (time <= end)]
    low, high = seen.min(), seen.max()
    if origin == 0.0:
        low = min(0.0, low)
    margin = 0.08 * (high - low)
    if margin > 0.0:
        below.set_ylim(low - (margin if low else 0.0), high + margin)
    if end > start:
        below.set_xlim((start - origin) * scale, (end - origin) * scale)
    return unit


def _edges(centres: Array) -> Array:
    """Edges of cells: half way between their centres, and at the outer centres."""
    return np.r_[centres[0], (centres[1:] + centres[:-1]) / 2.0, centres[-1]]


def slipped_extent(simulation: xr.Dataset) -> float:
    """The x (m) up to which the slip from x = 0 reached by the end, with a third added."""
    slip = simulation["slip"].isel(time=-1).values
    sticking = np.flatnonzero(slip < 0.005 * np.nanmax(slip))
    x = simulation["x"].values
    if sticking.size == 0 or sticking[0] == 0:
        return float(x[-1])
    return float(min(1.33 * x[sticking[0]], x[-1]))


def event_window(simulation: xr.Dataset, onset: float) -> tuple[float, float, float]:
    """Start of the first event with a margin, its highest slip rate, and its end (s).

    If the onset (s) is NaN, the whole record is searched.
    """
    time = simulation["step_time"].values
    rate = simulation["maximal_slip_rate"].values
    after = ~(time < onset)
    fast = np.flatnonzero(after & (rate >= _EVENT_LEVEL * np.max(rate[after])))
    # only the first run of fast steps: a later event, or a reflection, begins after a gap
    memory_time = parameters_of(simulation).memory_time
    gap = np.flatnonzero(np.diff(time[fast]) > _GAP * memory_time)
    if gap.size:
        fast = fast[: gap[0] + 1]
    start = float(time[fast[0]])
    end = float(time[fast[-1]])
    peak = float(time[fast[np.argmax(rate[fast])]])
    margin = max(0.5 * (end - start), 2e-5 * memory_time)
    return start - margin, peak, end + margin


def thin(time: Array, start: float, end: float, columns: int) -> NDArray[np.intp]:
    """Indices of the times (s) that are drawn, at most one for each column of pixels.

    The first time in a column is kept, so that a fast event stays a step at its true time. One time
    beyond either end is kept to fill the panel.
    """
    first = max(int(np.searchsorted(time, start, side="right")) - 1, 0)
    last = int(np.searchsorted(time, end)) + 1
    column = np.floor((time[first:last] - start) / (end - start) * columns)
    return first + np.flatnonzero(np.diff(column, prepend=-np.inf) > 0.0)


def prefixed(largest: float, unit: str) -> tuple[float, str]:
    """Factor and name of the common unit in which values up to `largest` (SI unit) are shown."""
    name = unit_for(largest, unit)
    return float(1 / sizes(unit)[name]), name.replace("u", "µ")


def time_unit(longest: float) -> tuple[float, str]:
    """Factor and name of the unit of a time axis up to `longest` (s)."""
    for name, shown in _LONG_TIMES.items():
        size = float(sizes("s")[name])
        if longest >= 2.0 * size:
            return 1.0 / size, shown
    return prefixed(longest, "s")
