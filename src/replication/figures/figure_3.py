"""Figure 3: the critical length against the block's height, theory and simulations."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.transforms import ScaledTranslation
from numpy.typing import NDArray

from nucleation.pictures import style

from ..tables.lengths import over_realisations, row
from . import laws

# The inset, in parts of the axes: the points rise to the right and leave this corner free.
_INSET_LEFT = 0.515
_INSET_BOTTOM = 0.1
_INSET_WIDTH = 0.315
_INSET_HEIGHTS = (0.2, 0.4)

_CREEP_FRACTIONS = (0.25, 0.5, 0.75, 1.0)  # of the onset time
_EVENT_FRACTIONS = (0.4, 0.8)  # of the way, in log slip rate, from the onset to the peak
_EVENT_LOOKS = ((style.ORANGE, "--"), (style.VERMILLION, "-."))
LOWEST_RATE = 1e-9  # m/s: below this the interface sticks
_SHOWN_LENGTHS = 1.4  # width of the inset in critical lengths


@style.styled
def draw(
    theory: xr.Dataset, lengths: xr.Dataset, simulation: xr.Dataset, shown: xr.Dataset
) -> Figure:
    """Draw L_c over H, the paper's simulations, and slip rates of one of them in an inset.

    `shown` is the simulation's row of lengths; of the realisations of one fault the mean is drawn.
    """
    figure, axes = style.panels(1, 1, 12.4)
    height = theory["height"]
    axes.plot(height, theory["critical_length"], color=style.THEORY, label="theory")
    thin: style.Options = {"label": r"theory, $Hk\to 0$", "linewidth": 1.1}
    axes.plot(
        height,
        theory["thin_limit_length"],
        "--",
        color=style.THEORY,
        **thin,
    )
    means = over_realisations(lengths)
    drawn = laws.where(
        means,
        np.isfinite(means["length"]),
        role="paper",
    )
    _draw_points(axes, drawn)
    # from zero to slightly more than the highest simulated block
    simulated = drawn if drawn.sizes["run"] else theory
    highest = 1.12 * float(simulated["height"].max())
    longest = np.interp(highest, height, theory["thin_limit_length"])
    axes.set(xlim=(0.0, highest), ylim=(0.0, 1.04 * float(longest)))
    axes.minorticks_on()
    axes.set(xlabel="Height $H$ (m)", ylabel="Critical nucleation length $L_c$ (m)")
    axes.legend(loc="upper left", labelspacing=0.35)
    # up to the lowest point above the inset
    above = drawn["length_low"].values[drawn["height"].values > (_INSET_LEFT - 0.02) * highest]
    top = axes.get_ylim()[1]
    room = np.nanmin([*above, top]) / top - _INSET_BOTTOM - 0.03
    place = (_INSET_LEFT, _INSET_BOTTOM, _INSET_WIDTH, float(np.clip(room, *_INSET_HEIGHTS)))
    _draw_snapshots(axes.inset_axes(place), simulation, shown)
    return figure


def draw_run(
    theory: xr.Dataset,
    lengths: xr.Dataset,
    simulation: xr.Dataset,
    id: str,
) -> Figure:
    """The figure with one run of the table in the inset."""
    return draw(theory, lengths, simulation, row(lengths, id))


def _draw_points(axes: Axes, lengths: xr.Dataset) -> None:
    """Points of each law and initial state, with bars from the lowest to the highest."""
    for kind, runs in laws.kinds(lengths):
        aside = ScaledTranslation(kind.aside / 72.0, 0.0, axes.figure.dpi_scale_trans)
        look: style.Options = {
            "marker": kind.marker,
            "markersize": kind.size,
            "color": kind.colour,
            "transform": axes.transData + aside,
            "zorder": 4.0 - 0.1 * kind.size,
        }
        for same in laws.groups(runs.sortby("initial_state"), "initial_state"):
            age = _number(float(same["initial_state"][0]))
            state = f", $\\phi(t\\!=\\!0)={age}$ s" if kind.old else ""
            label = f"FEM, {kind.label}{state}"
            laws.draw(axes, "height", same, "length", label=label, **look)


def choose_times(simulation: xr.Dataset, onset: float) -> tuple[NDArray, NDArray]:
    """The outputs that are shown: up to the onset (s), and first in the rise to the peak."""
    time = simulation["time"].values
    creep = [int(np.abs(time - fraction * onset).argmin()) for fraction in _CREEP_FRACTIONS]
    start = creep[-1]
    largest = np.maximum(simulation["slip_rate"].max("x").values[start:], LOWEST_RATE)
    rise = np.log(largest / largest[0])
    event = [start + int(np.argmax(rise >= part * rise.max())) for part in _EVENT_FRACTIONS]
    after = [i for i in event if i > start]
    return np.unique(creep), np.unique(after).astype(int)


def _draw_snapshots(axes: Axes, simulation: xr.Dataset, row: xr.Dataset) -> None:
    """The slip rate along the interface from creep to the event, and the extracted length."""
    time = simulation["time"].values
    x = simulation["x"].values
    onset = float(row["onset_time"])
    length = float(row["length"])
    if not np.isfinite(onset):  # without an event only the creep can be shown
        onset = float(time[-1])
    creep, event = choose_times(simulation, onset)
    start = time[creep[-1]]
    decimals = max(0, 3 - int(np.ceil(np.log10(onset))))
    labels = [f"{time[i]:.{decimals}f} s" for i in creep[:-1]]
    labels += [f"$t_c={start:.{decimals}f}$ s"]
    labels += [f"$t_c+{1e3 * (time[i] - start):.3g}$ ms" for i in event]
    looks = [*((shade, "-") for shade in style.shades(creep.size)), *_EVENT_LOOKS]
    shown = np.concatenate([creep, event])
    for i, (colour, dashes), label in zip(
        shown,
        looks,
        labels,
        strict=False,
    ):
        rate = simulation["slip_rate"].values[i]
        moving = np.where(rate > 0.0, rate, np.nan)  # a gap where nothing slips
        axes.plot(
            x,
            moving,
            dashes,
            color=colour,
            linewidth=1.1,
            label=label,
        )
    highest = float(simulation["slip_rate"].isel(time=shown).max())
    top = 10.0 ** np.ceil(np.log10(max(3.0 * highest, 10.0 * LOWEST_RATE)))
    axes.set(yscale="log", ylim=(LOWEST_RATE, top))
    axes.set_xlim(0.0, np.nanmin([_SHOWN_LENGTHS * length, x.max()]))
    axes.tick_params(labelsize=style.SMALL)
    axes.set_xlabel("$x$ (m)", fontsize=8.5, labelpad=1.0)
    axes.set_ylabel("$v$ (m/s)", fontsize=8.5, labelpad=1.0)
    if np.isfinite(length):
        style.vertical(axes, length, zorder=1.0)
        up = axes.get_xaxis_transform()
        ends = (0.0, 0.12), (length, 0.12)
        style.arrow(axes, *ends, kind="<->", xycoords=up, textcoords=up)
        # the first snapshots of the patch end right of this text
        axes.text(
            0.2 * length,
            0.15,
            "$L_c$",
            transform=up,
            ha="center",
            fontsize=8.5,
        )
    small: style.Options = {"fontsize": style.SMALL, "title_fontsize": style.SMALL}
    place: style.Options = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)}
    axes.legend(
        title="time $t$",
        handlelength=1.8,
        labelspacing=0.35,
        **place,
        **small,
    )


def _number(value: float) -> str:
    """A number as TeX, as a power of ten if that is shorter."""
    exponent = np.log10(value)
    if exponent >= 3.0 and exponent == round(exponent):
        return f"10^{{{exponent:.0f}}}"
    return f"{value:g}"
