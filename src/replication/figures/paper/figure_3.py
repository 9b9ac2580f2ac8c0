"""Figure 3: the critical length against the block's height, theory and simulations."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.transforms import ScaledTranslation
from numpy.typing import NDArray

from nucleation.pictures import style

from ...tables.lengths import over_realisations, row
from .. import laws

_ASIDE = {("slip", False): -4.0, ("aging", True): 4.0, ("slip", True): 8.0}
"""Points (1/72 inch) by which a law, and an older interface, are moved aside of the usual ones."""

# The inset, in parts of the axes: the points rise to the right and leave this corner free.
_INSET_LEFT = 0.515
_INSET_BOTTOM = 0.1
_INSET_WIDTH = 0.315
_INSET_HEIGHTS = (0.2, 0.4)

_DRAWN = "paper"  # role of the study; other studies are in figure_3_extended

CREEP_FRACTIONS = (0.25, 0.5, 0.75, 1.0)  # of the onset time
# of the way, in log slip rate, from the onset to the peak
EVENT_FRACTIONS = (0.4, 0.8)
_EVENT_LOOKS = ((style.ORANGE, "--"), (style.VERMILLION, "-."))
LOWEST_RATE = 1e-9  # m/s: below this the interface sticks
_SHOWN_LENGTHS = 1.4  # width of the inset in critical lengths


@style.styled
def draw(
    theory: xr.Dataset, lengths: xr.Dataset, inset_simulation: xr.Dataset, inset_row: xr.Dataset
) -> Figure:
    """Draw ``L_c(H)`` with the simulations as points, and slip-rate snapshots as an inset.

    Parameters
    ----------
    theory : Dataset
        With ``critical_length(height)`` and ``thin_limit_length(height)`` (m).
    lengths : Dataset
        One entry on dimension ``run`` per simulation, with ``role``, ``evolution``, ``height`` (m),
        ``initial_state`` (s) and ``length``, ``length_low``, ``length_high`` (m). Entries
        without a finite length are left out; of the realisations of one fault the mean is drawn.
    inset_simulation : Dataset
        The simulation in the inset, with its slip rate.
    inset_row : Dataset
        Its entry of `lengths`, with ``onset_time`` (s) and ``length`` (m).

    Returns
    -------
    Figure
        One panel with an inset.
    """
    figure, axes = style.panels(1, 1, 12.4)
    height = theory["height"]
    axes.plot(height, theory["critical_length"], color=style.THEORY, label="theory")
    thin: style.Options = {"label": r"theory, $Hk\to 0$", "linewidth": 1.1}
    axes.plot(height, theory["thin_limit_length"], "--", color=style.THEORY, **thin)
    means = over_realisations(lengths)
    usable = np.isfinite(means["length"].values) & (means["role"].values == _DRAWN)
    drawn = laws.where(means, usable)
    _draw_points(axes, drawn)
    # from zero to slightly more than the highest simulated block
    simulated = drawn if drawn.sizes["run"] else theory
    highest = 1.12 * float(simulated["height"].max())
    longest = np.interp(highest, height, theory["thin_limit_length"])
    axes.set(xlim=(0.0, highest), ylim=(0.0, 1.04 * float(longest)))
    axes.minorticks_on()
    axes.set(xlabel="Height $H$ (m)", ylabel="Critical nucleation length $L_c$ (m)")
    axes.legend(loc="upper left", labelspacing=0.35)
    place = (_INSET_LEFT, _INSET_BOTTOM, _INSET_WIDTH, _inset_height(axes, drawn))
    _draw_snapshots(axes.inset_axes(place), inset_simulation, inset_row)
    return figure


def _inset_height(axes: Axes, drawn: xr.Dataset) -> float:
    """Height of the inset, in parts of the axes: up to the lowest point above it."""
    left = (_INSET_LEFT - 0.02) * axes.get_xlim()[1]
    top = axes.get_ylim()[1]
    above = drawn["length_low"].values[drawn["height"].values > left]
    room = np.nanmin([*above, top]) / top - _INSET_BOTTOM - 0.03
    return float(np.clip(room, *_INSET_HEIGHTS))


def _draw_points(axes: Axes, lengths: xr.Dataset) -> None:
    """Points of one law and initial state, with bars from the lowest to the highest."""
    for (law, old), kind, runs in laws.kinds(lengths):
        points = _ASIDE.get((law, old), 0.0)
        aside = ScaledTranslation(points / 72.0, 0.0, axes.figure.dpi_scale_trans)
        look: style.Options = {
            "marker": kind.marker,
            "markersize": kind.size,
            "color": kind.colour,
            "transform": axes.transData + aside,
            "zorder": 4.0 - 0.1 * kind.size,
        }
        for same in laws.groups(runs.sortby("initial_state"), "initial_state"):
            age = _number(float(same["initial_state"][0]))
            state = f", $\\phi(t\\!=\\!0)={age}$ s" if old else ""
            label = f"FEM, {kind.label}{state}"
            laws.draw(axes, "height", same, "length", label=label, **look)


def choose_times(simulation: xr.Dataset, onset: float) -> tuple[NDArray, NDArray]:
    """Choose the output times that are shown.

    Parameters
    ----------
    simulation : Dataset
        With ``slip_rate(time, x)`` (m/s).
    onset : float
        Onset time (s).

    Returns
    -------
    array of int
        Up to the onset: the outputs nearest to :data:`CREEP_FRACTIONS` of the onset time.
    array of int
        After it: the first outputs at which the largest slip rate has made
        :data:`EVENT_FRACTIONS` of its rise to the first peak.
    """
    time = simulation["time"].values
    creep = [int(np.abs(time - fraction * onset).argmin()) for fraction in CREEP_FRACTIONS]
    start = creep[-1]
    largest = np.maximum(simulation["slip_rate"].max("x").values[start:], LOWEST_RATE)
    rise = np.log(largest / largest[0])
    event = [start + int(np.argmax(rise >= part * rise.max())) for part in EVENT_FRACTIONS]
    after = [i for i in event if i > start]
    return np.unique(creep), np.unique(after).astype(int)


def _draw_snapshots(
    axes: Axes,
    simulation: xr.Dataset,
    row: xr.Dataset,
) -> None:
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
    for i, (colour, dashes), label in zip(shown, looks, labels, strict=False):
        rate = simulation["slip_rate"].values[i]
        moving = np.where(rate > 0.0, rate, np.nan)  # a gap where nothing slips
        axes.plot(x, moving, dashes, color=colour, linewidth=1.1, label=label)
    highest = float(simulation["slip_rate"].isel(time=shown).max())
    top = 10.0 ** np.ceil(np.log10(max(3.0 * highest, 10.0 * LOWEST_RATE)))
    axes.set(yscale="log", ylim=(LOWEST_RATE, top))
    axes.set_xlim(0.0, np.nanmin([_SHOWN_LENGTHS * length, x.max()]))
    axes.tick_params(labelsize=style.SMALL)
    axes.set_xlabel("$x$ (m)", fontsize=8.5, labelpad=1.0)
    axes.set_ylabel("$v$ (m/s)", fontsize=8.5, labelpad=1.0)
    if np.isfinite(length):
        _mark_length(axes, length)
    axes.legend(
        title="time $t$",
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
        handlelength=1.8,
        fontsize=style.SMALL,
        title_fontsize=style.SMALL,
        labelspacing=0.35,
    )


def _mark_length(axes: Axes, length: float) -> None:
    """A dashed line at the length, and an arrow from x = 0 to it."""
    style.vertical(axes, length, zorder=1.0)
    up = axes.get_xaxis_transform()
    style.arrow(
        axes,
        (0.0, 0.12),
        (length, 0.12),
        kind="<->",
        xycoords=up,
        textcoords=up,
    )
    # the first snapshots of the patch end right of this text
    axes.text(0.2 * length, 0.15, "$L_c$", transform=up, ha="center", fontsize=8.5)


def _number(value: float) -> str:
    """A number as TeX, as a power of ten if that is shorter."""
    exponent = np.log10(value)
    if exponent >= 3.0 and exponent == round(exponent):
        return f"10^{{{exponent:.0f}}}"
    return f"{value:g}"


def draw_run(
    theory: xr.Dataset,
    lengths: xr.Dataset,
    simulation: xr.Dataset,
    id: str,
) -> Figure:
    """Draw the figure with one run in the inset (rule ``figure_3``).

    Parameters
    ----------
    theory, lengths : Dataset
        As of :func:`draw`.
    simulation : Dataset
        Record of the run.
    id : str
        Its name in `lengths`.

    Returns
    -------
    Figure
        As of :func:`draw`.
    """
    return draw(theory, lengths, simulation, row(lengths, id))
