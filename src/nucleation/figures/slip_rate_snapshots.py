"""Snapshots of the slip rate along the interface, from creep to the event (inset of Fig. 3)."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import NDArray

from ..figures import style

CREEP_FRACTIONS = (0.25, 0.5, 0.75, 1.0)  # of the onset time
EVENT_FRACTIONS = (0.4, 0.8)  # of the way, in log slip rate, from the onset to the peak
EVENT_LOOKS = ((style.ORANGE, "--"), (style.VERMILLION, "-."))
LOWEST_RATE = 1e-9  # m/s: below this the interface sticks
SHOWN_LENGTHS = 1.4  # width of the panel in critical lengths


def choose_times(simulation: xr.Dataset, onset: float) -> tuple[NDArray, NDArray]:
    """Indices of the output times to show, up to the onset (s) and after it, each once.

    Outputs nearest to :data:`CREEP_FRACTIONS` of the onset time; and the first outputs after it
    whose largest slip rate has made :data:`EVENT_FRACTIONS` of its rise to the first peak.
    """
    time = simulation["time"].values
    creep = [int(np.abs(time - fraction * onset).argmin()) for fraction in CREEP_FRACTIONS]
    start = creep[-1]
    largest = np.maximum(simulation["slip_rate"].max("x").values[start:], LOWEST_RATE)
    rise = np.log(largest / largest[0])
    event = [start + int(np.argmax(rise >= part * rise.max())) for part in EVENT_FRACTIONS]
    return np.unique(creep), np.unique([i for i in event if i > start]).astype(int)


def draw(axes: Axes, simulation: xr.Dataset, row: xr.Dataset) -> None:
    """Draw the snapshots and mark the extracted length, in small type.

    Parameters
    ----------
    axes : Axes
        The panel.
    simulation : Dataset
        With ``slip_rate(time, x)`` (m/s).
    row : Dataset
        With ``onset_time`` (s) and ``length`` (m).
    """
    time, x = simulation["time"].values, simulation["x"].values
    onset, length = float(row["onset_time"]), float(row["length"])
    if not np.isfinite(onset):  # nothing happened: only the creep can be shown
        onset = float(time[-1])
    creep, event = choose_times(simulation, onset)
    start = time[creep[-1]]
    decimals = max(0, 3 - int(np.ceil(np.log10(onset))))
    labels = [f"{time[i]:.{decimals}f} s" for i in creep[:-1]]
    labels += [f"$t_c={start:.{decimals}f}$ s"]
    labels += [f"$t_c+{1e3 * (time[i] - start):#.3g}$ ms" for i in event]
    looks: Any = [(shade, "-") for shade in style.shades(creep.size)]
    shown = np.concatenate([creep, event])
    for i, (colour, dashes), label in zip(shown, [*looks, *EVENT_LOOKS], labels, strict=False):
        rate = simulation["slip_rate"].values[i]
        moving = np.where(rate > 0.0, rate, np.nan)  # where nothing slips there is a gap
        axes.plot(x, moving, dashes, color=colour, linewidth=1.1, label=label)
    highest = float(simulation["slip_rate"].isel(time=shown).max())
    top = 10.0 ** np.ceil(np.log10(max(3.0 * highest, 10.0 * LOWEST_RATE)))
    axes.set(yscale="log", ylim=(LOWEST_RATE, top))
    axes.set_xlim(0.0, np.nanmin([SHOWN_LENGTHS * length, x.max()]))
    axes.tick_params(labelsize=style.SMALL)
    axes.set_xlabel("$x$ (m)", fontsize=8.5, labelpad=1.0)
    axes.set_ylabel("$v$ (m/s)", fontsize=8.5, labelpad=1.0)
    if np.isfinite(length):
        _mark_length(axes, length)
    look: Any = {"fontsize": style.SMALL, "title_fontsize": style.SMALL, "labelspacing": 0.35}
    place: Any = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5), "handlelength": 1.8}
    axes.legend(title="time $t$", **place, **look)


def _mark_length(axes: Axes, length: float) -> None:
    """A vertical dashed line at the length, and a double-headed arrow from x = 0 to it."""
    axes.axvline(length, color=style.GUIDE, linestyle="--", linewidth=0.9, zorder=1.0)
    across = axes.get_xaxis_transform()
    style.arrow(axes, (0.0, 0.12), (length, 0.12), kind="<->", xycoords=across, textcoords=across)
    # The creeping patch's first snapshots end right of this.
    axes.text(0.2 * length, 0.15, "$L_c$", transform=across, ha="center", fontsize=8.5)
