"""Snapshots of the slip rate along the interface, from creep to the event (inset of Fig. 3)."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from numpy.typing import NDArray

from ..figures import style

CREEP_FRACTIONS = (0.25, 0.5, 0.75, 1.0)  # of the onset time
EVENT_FRACTIONS = (0.4, 0.8)  # of the way, in log slip rate, from the onset to the peak
EVENT_COLOURS = (style.ORANGE, style.VERMILLION)
EVENT_DASHES = ("--", "-.")
LOWEST_RATE = 1e-9  # m/s: below this the interface sticks
SHOWN_LENGTHS = 1.4  # width of the panel in critical lengths


def choose_times(simulation: xr.Dataset, onset: float) -> tuple[NDArray, NDArray]:
    """Indices of the output times to show, up to the onset and after it.

    Parameters
    ----------
    simulation : Dataset
        With ``slip_rate(time, x)`` (m/s).
    onset : float
        Time at which the event sets in (s).

    Returns
    -------
    tuple of int arrays
        Outputs nearest to :data:`CREEP_FRACTIONS` of the onset time; and the first outputs
        after it whose largest slip rate has made :data:`EVENT_FRACTIONS` of its rise to the
        first peak. An output chosen twice comes once.
    """
    time = simulation["time"].values
    creep = [int(np.abs(time - fraction * onset).argmin()) for fraction in CREEP_FRACTIONS]
    start = creep[-1]
    largest = simulation["slip_rate"].max("x").values[start:]
    rise = np.log(np.maximum(largest, LOWEST_RATE) / max(largest[0], LOWEST_RATE))
    highest = rise.max()
    event = [start + int(np.argmax(rise >= fraction * highest)) for fraction in EVENT_FRACTIONS]
    after = np.unique([i for i in event if i > start])
    return np.unique(creep), after.astype(int)


def draw(axes: Axes, simulation: xr.Dataset, row: xr.Dataset) -> None:
    """Draw the snapshots and mark the extracted length.

    Parameters
    ----------
    axes : Axes
        The panel, small type is assumed.
    simulation : Dataset
        With ``slip_rate(time, x)`` (m/s).
    row : Dataset
        With ``onset_time`` (s) and ``length`` (m).
    """
    time = simulation["time"].values
    onset, length = float(row["onset_time"]), float(row["length"])
    if not np.isfinite(onset):  # nothing happened: only the creep can be shown
        onset = float(time[-1])
    creep, event = choose_times(simulation, onset)
    decimals = max(0, 3 - int(np.ceil(np.log10(onset))))
    labels = [f"{time[i]:.{decimals}f} s" for i in creep]
    labels[-1] = f"$t_c={time[creep[-1]]:.{decimals}f}$ s"
    shades = colormaps[style.SEQUENCE](np.linspace(0.0, 0.85, creep.size))
    for i, shade, label in zip(creep, shades, labels, strict=True):
        _curve(axes, simulation, i, shade, "-", label)
    for i, colour, dashes in zip(event, EVENT_COLOURS, EVENT_DASHES, strict=False):
        later = 1e3 * (time[i] - time[creep[-1]])
        _curve(axes, simulation, i, colour, dashes, f"$t_c+{later:#.3g}$ ms")
    _limits(axes, simulation, np.concatenate([creep, event]), length)
    if np.isfinite(length):
        _mark_length(axes, length)
    axes.legend(
        title="time $t$",
        title_fontsize=style.SMALL,
        fontsize=style.SMALL,
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
        labelspacing=0.35,
        handlelength=1.8,
    )


def _curve(
    axes: Axes, simulation: xr.Dataset, index: int, colour: Any, dashes: str, label: str
) -> None:
    """The slip rate at one output time; where nothing slips the logarithm leaves a gap."""
    rate = simulation["slip_rate"].isel(time=index).values
    shown = np.where(rate > 0.0, rate, np.nan)
    axes.plot(simulation["x"].values, shown, dashes, color=colour, linewidth=1.1, label=label)


def _limits(axes: Axes, simulation: xr.Dataset, shown: NDArray, length: float) -> None:
    """Logarithmic axis from sticking to the fastest snapshot; small labels."""
    highest = float(simulation["slip_rate"].isel(time=shown).max())
    axes.set_yscale("log")
    axes.set_ylim(LOWEST_RATE, 10.0 ** np.ceil(np.log10(max(3.0 * highest, 10.0 * LOWEST_RATE))))
    axes.set_xlim(0.0, np.nanmin([SHOWN_LENGTHS * length, float(simulation["x"].max())]))
    axes.tick_params(labelsize=style.SMALL)
    axes.set_xlabel("$x$ (m)", fontsize=8.5, labelpad=1.0)
    axes.set_ylabel("$v$ (m/s)", fontsize=8.5, labelpad=1.0)


def _mark_length(axes: Axes, length: float) -> None:
    """A vertical dashed line at the length, and a double-headed arrow from x = 0 to it."""
    axes.axvline(length, color=style.GUIDE, linestyle="--", linewidth=0.9, zorder=1.0)
    across = axes.get_xaxis_transform()
    style.arrow(axes, (0.0, 0.12), (length, 0.12), kind="<->", xycoords=across, textcoords=across)
    # The creeping patch's first snapshots end right of this.
    axes.text(0.2 * length, 0.15, "$L_c$", transform=across, ha="center", fontsize=8.5)
