"""Picture of a run: shear stress in space and time, and the driving force."""

import math
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..extraction.extraction import Record, parameters_of
from ..types import Array
from . import style

_PIXELS = 1200  # pixel columns of the widest image: more are invisible
_EVENT_LEVEL = 0.01  # the event's panel shows slip rates above this part of the highest
_GAP = 2.0  # D/V without fast slip, after which another event begins
_PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
_LONG_TIMES = (
    (2.0 * 365.25 * 86400.0, 365.25 * 86400.0, "years"),
    (2.0 * 86400.0, 86400.0, "days"),
    (7200.0, 3600.0, "h"),
)
"""Times (s) from which a unit is used, the unit (s), and its name."""


class Window(NamedTuple):
    """The limits of a time axis."""

    start: float  # s
    end: float  # s
    origin: float  # s
    scale: float  # units of the axis in a second
    unit: str  # of the axis

    def shown(self, time: Array) -> Array:
        """Times (s) on the axis."""
        return (time - self.origin) * self.scale


@style.styled
def draw(simulation: xr.Dataset, row: xr.Dataset, symbol: str = "$L$") -> Figure:
    """Draw ``tau / sigma_0`` over time and x, and the applied force below it.

    The left column shows the whole record, the right column the event. Positions that the slip did
    not reach are left out, except a margin. `row` has the event as of ``extract``: ``onset_time``
    (s), ``length``, ``length_low`` and ``length_high`` (m); `symbol` is the length's.
    """
    Record(simulation).require("slip", "shear_stress")
    figure, panels = style.panels(
        2,
        2,
        10.2,
        sharex="col",
        width_ratios=(2.1, 1.0),
    )
    panels[0, 1].sharey(panels[0, 0])
    ratio = simulation["shear_stress"] / parameters_of(simulation).fault.normal_stress
    ratio = ratio.sel(x=slice(None, slipped_extent(simulation)))
    norm = Normalize(min(0.0, float(ratio.quantile(0.001))), float(ratio.quantile(0.999)))
    time = simulation["time"].values
    start, peak, end = event_window(simulation, float(row["onset_time"]))
    record = Window(
        time[0],
        time[-1],
        0.0,
        *time_unit(time[-1]),
    )
    event = Window(
        start,
        end,
        peak,
        *time_unit(max(end - peak, peak - start)),
    )
    for (image, force), window in zip(
        panels.T,
        (record, event),
        strict=True,
    ):
        mesh = _draw_image(image, ratio, window, norm)
        _draw_force(force, simulation, window)
        _mark(image, force, row, window)
    figure.colorbar(
        mesh,
        ax=panels[0, :],
        label=r"$\tau/\sigma_0$",
        pad=0.01,
        extend="both",
    )
    _label(panels, row, (record, event), symbol)
    panels[1, 0].set_ylabel(f"Applied force $-f_d$ ({_force_unit(simulation)[1]})")
    return figure


def _draw_image(
    axes: Axes,
    ratio: xr.DataArray,
    window: Window,
    norm: Normalize,
) -> QuadMesh:
    times = thin(ratio["time"].values, window.start, window.end, _PIXELS)
    part = ratio.isel(time=times).transpose("x", "time")
    return axes.pcolormesh(
        window.shown(_edges(part["time"].values)),
        _edges(part["x"].values),
        part.values,
        norm=norm,
        rasterized=True,
    )


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


def thin(
    time: Array,
    start: float,
    end: float,
    columns: int,
) -> NDArray[np.intp]:
    """Indices of the times (s) that are drawn, at most one for each column of pixels.

    The first time in a column is kept, so that a fast event stays a step at its true time. One time
    beyond either end is kept to fill the panel.
    """
    first = max(
        int(
            np.searchsorted(
                time,
                start,
                side="right",
            )
        )
        - 1,
        0,
    )
    last = min(
        int(
            np.searchsorted(
                time,
                end,
                side="left",
            )
        )
        + 1,
        time.size,
    )
    column = np.floor((time[first:last] - start) / (end - start) * columns)
    return first + np.flatnonzero(np.diff(column, prepend=-np.inf) > 0.0)


def _force_unit(record: xr.Dataset) -> tuple[float, str]:
    """Factor and name of the unit of a record's driving force, from N/m."""
    return prefixed(float(np.abs(record["driving_force"]).max()), "N/m")


def _draw_force(axes: Axes, record: xr.Dataset, window: Window) -> None:
    """Draw the driving force, positive in compression; the axis of the whole run has its zero."""
    time = record["step_time"].values
    scale, _ = _force_unit(record)
    force = -scale * record["driving_force"].values
    axes.plot(
        window.shown(time),
        force,
        color=style.BLUE,
        linewidth=1.2,
    )
    seen = force[(time >= window.start) & (time <= window.end)]
    low = min(0.0, seen.min()) if window.origin == 0.0 else seen.min()
    high = seen.max()
    margin = 0.08 * (high - low)
    if margin > 0.0:
        axes.set_ylim(low - (margin if low else 0.0), high + margin)
    if window.end > window.start:
        axes.set_xlim(*window.shown(np.array([window.start, window.end])))


def _mark(
    image: Axes,
    force: Axes,
    row: xr.Dataset,
    window: Window,
) -> None:
    """The onset, dotted; the length, dashed, and its error bar at the onset."""
    onset = (float(row["onset_time"]) - window.origin) * window.scale
    length = float(row["length"])
    below = length - float(row["length_low"])
    above = float(row["length_high"]) - length
    white: style.Options = {"color": "white", "linewidth": 0.9}
    image.axhline(length, linestyle="--", **white)
    image.axvline(onset, linestyle=":", **white)
    image.errorbar(
        [onset], [length], [[below], [above]], marker="o", ms=3.5, color="white", elinewidth=0.9
    )
    style.vertical(force, onset, ":")


def _label(
    panels: NDArray[np.object_], row: xr.Dataset, windows: tuple[Window, Window], symbol: str
) -> None:
    """Axis labels, panel letters, and the names of the marks on the left."""
    (image, zoom), (force, last) = panels
    image.set_ylabel("Position $x$ (m)")
    record, event = windows
    force.set_xlabel(f"Time $t$ ({record.unit})")
    last.set_xlabel(f"Time from the highest slip rate ({event.unit})")
    zoom.tick_params(labelleft=False)
    last.yaxis.set_ticks_position("both")
    last.tick_params(labelleft=False, labelright=True)
    for axes in (image, zoom):  # ticks inside are invisible on the dark image
        axes.tick_params(direction="out", top=False, right=False)
    style.letters(*panels.flat, pad=3.0)
    beside: style.Options = {"textcoords": "offset points", "va": "bottom"}
    if np.isfinite(row["length"]):
        place = (0.0, float(row["length"]))
        across = image.get_yaxis_transform()
        image.annotate(
            symbol,
            place,
            (5.0, 1.0),
            across,
            color="white",
            **beside,
        )
    if np.isfinite(row["onset_time"]):
        place = (float(record.shown(row["onset_time"].values)), 0.0)
        up = force.get_xaxis_transform()
        look: style.Options = {"color": style.GUIDE, "ha": "right", **beside}
        force.annotate("onset", place, (-4.0, 5.0), up, **look)


def prefixed(largest: float, unit: str) -> tuple[float, str]:
    """Factor and name of a unit with the prefix that keeps values up to `largest` below 1000."""
    if not (math.isfinite(largest) and largest > 0.0):
        return 1.0, unit
    exponent = 3 * math.floor(math.log10(largest) / 3.0)
    exponent = min(max(exponent, min(_PREFIXES)), max(_PREFIXES))
    return 10.0**-exponent, _PREFIXES[exponent] + unit


def time_unit(longest: float) -> tuple[float, str]:
    """Factor and name of the unit of a time axis up to `longest` (s)."""
    if longest < 1.0:
        return prefixed(longest, "s")
    for least, unit, name in _LONG_TIMES:
        if longest >= least:
            return 1.0 / unit, name
    return 1.0, "s"
