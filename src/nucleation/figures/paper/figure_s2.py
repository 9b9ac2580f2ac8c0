"""Figure S2: space-time image of the interfacial shear stress, and the driving force."""

import json

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from ...analysis.lengths import row
from ...figures import space_time, style
from ...model.parameters import Parameters

PIXELS = 1200  # pixel columns of the widest image: more could not be seen
EVENT_LEVEL = 0.01  # the event's panel shows slip rates above this part of the highest
MILLI = 1e3  # ms in a second
KILO = 1e3


@style.styled
def draw(simulation: xr.Dataset, row: xr.Dataset) -> Figure:
    """Draw ``tau / sigma_0`` over time and x, and the applied force below it.

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
    ratio = simulation["shear_stress"] / _normal_stress(simulation)
    ratio = ratio.sel(x=slice(None, slipped_extent(simulation)))
    norm = Normalize(min(0.0, float(ratio.quantile(0.001))), float(ratio.quantile(0.999)))
    time = simulation["time"].values
    start, peak, end = event_window(simulation, float(row["onset_time"]))
    # Interval, origin and scale of either column's time axis: seconds, and milliseconds.
    columns = ((time[0], time[-1], 0.0, 1.0), (start, end, peak, MILLI))
    for (image, force), (first, last, origin, scale) in zip(panels.T, columns, strict=True):
        part = ratio.isel(time=space_time.thin(time, first, last, PIXELS))
        mesh = space_time.draw(image, part, norm, origin=origin, scale=scale)
        _draw_force(force, simulation, (first, last), origin, scale)
        _mark(image, force, row, origin, scale)
        force.set_xlim((first - origin) * scale, (last - origin) * scale)
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


def _normal_stress(simulation: xr.Dataset) -> float:
    """The applied normal stress ``sigma_0`` (Pa)."""
    parameters = Parameters.from_dict(json.loads(simulation.attrs["parameters"]))
    return parameters.loading.normal_stress


def _draw_force(
    axes: Axes, simulation: xr.Dataset, interval: tuple[float, float], origin: float, scale: float
) -> None:
    """The compressive driving force at every step, counted positive; limits for `interval`."""
    time = simulation["step_time"].values
    force = -simulation["driving_force"].values / KILO
    axes.plot((time - origin) * scale, force, color=style.DRIVE, linewidth=1.2)
    seen = force[(time >= interval[0]) & (time <= interval[1])]
    low, high = (min(0.0, seen.min()) if origin == 0.0 else seen.min()), seen.max()
    above = 0.08 * (high - low)
    axes.set_ylim(low - (above if low else 0.0), high + above)


def _mark(image: Axes, force: Axes, row: xr.Dataset, origin: float, scale: float) -> None:
    """The onset, dotted; the critical length, dashed, and its error bar at the onset."""
    onset = (float(row["onset_time"]) - origin) * scale
    length, low, high = (float(row[key]) for key in ("length", "length_low", "length_high"))
    image.axhline(length, color="white", linestyle="--", linewidth=0.9)
    image.axvline(onset, color="white", linestyle=":", linewidth=0.9)
    image.errorbar(
        [onset], [length], [[length - low], [high - length]], marker="o", markersize=3.5,
        color="white", elinewidth=0.9,
    )  # fmt: skip
    force.axvline(onset, color=style.GUIDE, linestyle=":", linewidth=0.9)


def _label(panels: np.ndarray, row: xr.Dataset) -> None:
    """Axis labels, panel letters, and the names of the marks on the left."""
    (image, zoom), (force, last) = panels
    image.set_ylabel("Position $x$ (m)")
    force.set_ylabel("Applied force $-f_d$ (kN/m)")
    force.set_xlabel("Time $t$ (s)")
    last.set_xlabel("Time from the highest slip rate (ms)")
    zoom.tick_params(labelleft=False)
    last.yaxis.tick_right()
    last.yaxis.set_ticks_position("both")
    last.tick_params(labelleft=False, labelright=True)
    for axes in (image, zoom):  # ticks inside would be lost on the dark image
        axes.tick_params(direction="out", top=False, right=False)
    for axes, letter in zip(panels.flat, "abcd", strict=True):
        axes.set_title(f"({letter})", loc="left", pad=3.0)
    beside = {"textcoords": "offset points", "va": "bottom"}
    if np.isfinite(row["length"]):
        across = image.get_yaxis_transform()
        place = {"xy": (0.0, float(row["length"])), "xycoords": across, "xytext": (5.0, 1.0)}
        image.annotate("$L_c$", color="white", **place, **beside)
    if np.isfinite(row["onset_time"]):
        across = force.get_xaxis_transform()
        place = {"xy": (float(row["onset_time"]), 0.0), "xycoords": across, "xytext": (-4.0, 5.0)}
        force.annotate("onset", color=style.GUIDE, ha="right", **place, **beside)


def draw_run(lengths: xr.Dataset, simulation: xr.Dataset, id: str) -> Figure:
    """The step ``draw_figure_s2``: one of the runs of a table."""
    return draw(simulation, row(lengths, id))
