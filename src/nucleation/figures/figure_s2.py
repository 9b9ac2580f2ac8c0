"""Figure S2: space-time image of the interfacial shear stress, and the driving force."""

from __future__ import annotations

import json

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from ..parameters import Parameters
from . import space_time, style

PIXELS = 1200  # pixel columns of the widest image: more could not be seen
EVENT_LEVEL = 0.03  # the event's panel shows slip rates above this part of the highest
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
        The simulation's entry of the lengths: ``onset_time`` (s) and ``length`` (m).

    Returns
    -------
    Figure
        Two columns wide: on the left all of the record, on the right the event in milliseconds.
        Only x that the slip reached is shown.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 10.2 * style.CENTIMETRE)
    panels = figure.subplots(2, 2, sharex="col", sharey="row", width_ratios=(2.1, 1.0))
    onset, length = float(row["onset_time"]), float(row["length"])
    ratio = simulation["shear_stress"] / _normal_stress(simulation)
    ratio = ratio.sel(x=slice(None, slipped_extent(simulation)))
    norm = Normalize(min(0.0, float(ratio.quantile(0.001))), float(ratio.quantile(0.999)))
    time = simulation["time"].values
    start, end = event_window(simulation, onset)
    zero = onset if np.isfinite(onset) else start
    # Interval, origin and scale of either column's time axis: seconds, and milliseconds.
    columns = ((time[0], time[-1], 0.0, 1.0), (start, end, zero, MILLI))
    for column, (start, end, origin, scale) in enumerate(columns):
        part = ratio.isel(time=space_time.thin(time, start, end, PIXELS))
        image, force = panels[:, column]
        mesh = space_time.draw(image, part, norm, origin=origin, scale=scale)
        _draw_force(force, simulation, origin, scale)
        _mark(image, force, (onset - origin) * scale, length)
        force.set_xlim((start - origin) * scale, (end - origin) * scale)
    figure.colorbar(mesh, ax=panels[0, :], label=r"$\tau/\sigma_0$", pad=0.01, extend="both")
    _label(panels, onset, length)
    return figure


def slipped_extent(simulation: xr.Dataset) -> float:
    """The x (m) up to which the slip from x = 0 reached by the end, with a fifth added."""
    slip = simulation["slip"].isel(time=-1).values
    sticking = np.flatnonzero(slip < 0.02 * np.nanmax(slip))
    x = simulation["x"].values
    if sticking.size == 0 or sticking[0] == 0:
        return float(x[-1])
    return float(min(1.2 * x[sticking[0]], x[-1]))


def event_window(simulation: xr.Dataset, onset: float) -> tuple[float, float]:
    """Start and end (s) of the fast part of the first event after `onset`, with margins."""
    time = simulation["step_time"].values
    rate = simulation["maximal_slip_rate"].values
    after = ~(time < onset)  # all of the record if there is no onset
    fast = np.flatnonzero(after & (rate >= EVENT_LEVEL * np.max(rate[after])))
    # The first run of fast steps: a later event, or a reflection, starts after a gap.
    gap = np.flatnonzero(np.diff(time[fast]) > 0.1)
    last = fast[gap[0]] if gap.size else fast[-1]
    start, end = float(time[fast[0]]), float(time[last])
    width = max(end - start, 1e-6)
    return start - 0.5 * width, end + 0.5 * width


def _normal_stress(simulation: xr.Dataset) -> float:
    """The applied normal stress ``sigma_0`` (Pa)."""
    parameters = Parameters.from_dict(json.loads(simulation.attrs["parameters"]))
    return parameters.loading.normal_stress


def _draw_force(axes: Axes, simulation: xr.Dataset, origin: float, scale: float) -> None:
    """The compressive driving force at every step, counted positive."""
    axes.plot(
        (simulation["step_time"].values - origin) * scale,
        -simulation["driving_force"].values / KILO,
        color=style.DRIVE,
        linewidth=1.2,
    )


def _mark(image: Axes, force: Axes, onset: float, length: float) -> None:
    """Dashed lines at the critical length, dotted ones at the onset."""
    image.axhline(length, color="white", linestyle="--", linewidth=0.9)
    image.axvline(onset, color="white", linestyle=":", linewidth=0.9)
    force.axvline(onset, color=style.GUIDE, linestyle=":", linewidth=0.9)


def _label(panels: np.ndarray, onset: float, length: float) -> None:
    """Axis labels, panel letters, and the names of the marks on the left."""
    (image, _), (force, last) = panels
    image.set_ylabel("Position $x$ (m)")
    force.set_ylabel("Applied force $-f_d$ (kN/m)")
    force.set_xlabel("Time $t$ (s)")
    last.set_xlabel("Time since onset (ms)")
    force.set_ylim(min(0.0, 1.08 * force.dataLim.ymin), 1.08 * force.dataLim.ymax)
    for axes in panels[0]:  # ticks inside would be lost on the dark image
        axes.tick_params(direction="out", top=False, right=False)
    for axes, letter in zip(panels.flat, "abcd", strict=True):
        axes.set_title(f"({letter})", loc="left", pad=3.0)
    beside = {"textcoords": "offset points", "va": "bottom"}
    if np.isfinite(length):
        image.annotate(
            "$L_c$",
            xy=(0.0, length),
            xycoords=image.get_yaxis_transform(),
            xytext=(5.0, 1.0),
            color="white",
            **beside,
        )
    if np.isfinite(onset):
        force.annotate(
            "onset",
            xy=(onset, 0.0),
            xycoords=force.get_xaxis_transform(),
            xytext=(-4.0, 5.0),
            ha="right",
            color=style.GUIDE,
            **beside,
        )
