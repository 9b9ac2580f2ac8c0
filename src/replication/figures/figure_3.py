"""Figure 3: the critical length against the block's height, theory and simulations.

:func:`draw_extended` has the length at which the patch becomes unstable, too. :func:`figure_s2`
shows one of the runs in space and time.
"""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.transforms import ScaledTranslation
from numpy.typing import NDArray

from nucleation.pictures import run, style

from ..tables.lengths import over_realisations
from ..tables.lengths import row as row_of
from . import laws

_ABOVE = 1.12  # the axes end at this multiple of the highest simulated block

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

_JUDGED = "converged"


@style.styled()
def draw(theory: xr.Dataset, lengths: xr.Dataset, simulation: xr.Dataset, id: str) -> Figure:
    """Draw L_c over H, the paper's simulations, and slip rates of one of them in an inset.

    Of the realisations of one fault the mean is drawn.
    """
    figure, axes = style.panels(12.4)
    height = theory["height"]
    thin = theory["thin_limit_length"]
    axes.plot(height, theory["critical_length"], color=style.THEORY, label="theory")
    label = r"theory, $Hk\to 0$"
    axes.plot(height, thin, "--", color=style.THEORY, linewidth=1.1, label=label)
    means = over_realisations(lengths)
    drawn = laws.where(means, np.isfinite(means["length"]), role="paper")
    for name, old, (marker, size, colour, right), runs in laws.kinds(drawn):
        aside = ScaledTranslation(right / 72.0, 0.0, figure.dpi_scale_trans)
        marks: style.Options = {"marker": marker, "ms": size, "color": colour}
        marks |= {"transform": axes.transData + aside, "zorder": 4.0 - 0.1 * size}
        for same in laws.groups(runs.sortby("initial_state"), "initial_state"):
            label = f"FEM, {name}"
            if old:
                age = float(same["initial_state"][0])
                power = np.log10(age)
                short = power >= 3.0 and power == round(power)
                number = f"10^{{{power:.0f}}}" if short else f"{age:g}"
                label += f", $\\phi(t\\!=\\!0)={number}$ s"
            laws.draw(axes, "height", same, "length", label=label, **marks)
    highest = _ABOVE * float((drawn if drawn.sizes["run"] else theory)["height"].max())
    top = 1.04 * float(np.interp(highest, height, thin))
    axes.set(xlabel="Height $H$ (m)", xlim=(0.0, highest))
    axes.set(ylabel="Critical nucleation length $L_c$ (m)", ylim=(0.0, top))
    axes.legend(loc="upper left")
    # up to the lowest point above the inset
    above = drawn["length_low"].values[drawn["height"].values > (_INSET_LEFT - 0.02) * highest]
    room = np.nanmin([*above, top]) / top - _INSET_BOTTOM - 0.03
    place = (_INSET_LEFT, _INSET_BOTTOM, _INSET_WIDTH, float(np.clip(room, *_INSET_HEIGHTS)))
    _draw_snapshots(axes.inset_axes(place), simulation, row_of(lengths, id))
    return figure


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
    rates = simulation["slip_rate"].values[shown]
    for rate, (colour, dashes), label in zip(rates, looks, labels, strict=False):
        moving = np.where(rate > 0.0, rate, np.nan)  # a gap where nothing slips
        axes.plot(x, moving, dashes, color=colour, linewidth=1.1, label=label)
    top = 10.0 ** np.ceil(np.log10(max(3.0 * rates.max(), 10.0 * LOWEST_RATE)))
    axes.set(yscale="log", ylim=(LOWEST_RATE, top))
    axes.set_xlim(0.0, np.nanmin([_SHOWN_LENGTHS * length, x.max()]))
    axes.tick_params(labelsize=style.SMALL)
    axes.set_xlabel("$x$ (m)", fontsize=8.5, labelpad=1.0)
    axes.set_ylabel("$v$ (m/s)", fontsize=8.5, labelpad=1.0)
    if np.isfinite(length):
        axes.axvline(length, linestyle="--", linewidth=0.9, zorder=1.0)
        up = axes.get_xaxis_transform()
        both: style.Options = {"arrowstyle": "<->", "shrinkA": 0.0, "shrinkB": 0.0}
        axes.annotate("", (length, 0.12), (0.0, 0.12), up, up, arrowprops=both)
        # the first snapshots of the patch end right of this text
        axes.text(0.2 * length, 0.15, "$L_c$", transform=up, ha="center", fontsize=8.5)
    place: style.Options = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)}
    axes.legend(title="time $t$", fontsize=style.SMALL, title_fontsize=style.SMALL, **place)


def figure_s2(lengths: xr.Dataset, simulation: xr.Dataset, id: str) -> Figure:
    """Stress in space and time of a run in a table of lengths; its length is L_c, as there."""
    return run.draw(simulation, row_of(lengths, id), "$L_c$")


@style.styled()
def draw_extended(theory: xr.Dataset, lengths: xr.Dataset, table: xr.Dataset) -> Figure:
    """Draw lengths against height, and the same over the theory's.

    `table` has L_s of the same runs.
    """
    length = lengths["length"]  # with one definition: ranges are those of realisations
    lengths = over_realisations(lengths.assign(length_low=length, length_high=length))
    figure, (left, right) = style.panels(8.2, columns=2)
    _draw_lengths(left, theory, lengths, table)
    _draw_lengths(right, *map(_over_theory, (theory, lengths, table)))
    highest = _ABOVE * float(lengths["height"].max())
    top = 1.6 * float(np.interp(highest, theory["height"], theory["critical_length"]))
    left.set(xlim=(0.0, highest), ylim=(0.0, top), ylabel="Length $L$ (m)")
    left.legend(loc="upper left")
    marks = []
    for name, old, (marker, *_), _ in laws.kinds(lengths):
        older = ", older interface" if old else ""
        marks += right.plot([], [], marker, label=name + older)
    right.set(xscale="log", xlim=(0.8 * lengths["height"].min(), highest), ylim=(0.4, 1.2))
    right.set_ylabel("Length over theory $L/L_c$")
    right.legend(handles=marks, loc="upper left")
    style.letters(left, right)
    return figure


def _over_theory(table: xr.Dataset) -> xr.Dataset:
    """A table with its lengths over the theory's."""
    names = [name for name in table.data_vars if "length" in str(name)]
    return table.assign({name: table[name] / table["critical_length"] for name in names})


def _draw_lengths(axes: Axes, theory: xr.Dataset, lengths: xr.Dataset, table: xr.Dataset) -> None:
    """Theory, half of it, and all sets of lengths."""
    height, critical = theory["height"], theory["critical_length"]
    axes.plot(height, critical, color=style.THEORY, label="theory $L_c$")
    axes.plot(height, 0.5 * critical, "--", color=style.THEORY, label="theory $L_c/2$")
    role = _JUDGED if _JUDGED in table["role"].values else "paper"
    open_marks: style.Options = {"ms": 4.8, "mfc": "white"}
    stability: style.Options = {"ms": 4.8, "color": style.STABILITY}
    for own, column, text, look in (
        (
            laws.where(lengths, role="paper"),
            "length",
            "drop, quiet, on the paper's mesh",
            {"ms": 3.0},
        ),
        (
            laws.where(lengths, role=_JUDGED),
            "length",
            r"drop, load steady to $10^{-5}$",
            open_marks,
        ),
        (
            laws.where(table, role=role),
            "stability_length",
            "patch turns unstable, $L_s$",
            stability,
        ),
    ):
        label = text
        known = laws.where(own, np.isfinite(own[column]))
        for _, _, (marker, _, colour, _), runs in laws.kinds(known):
            marks: style.Options = {"marker": marker, "color": colour}
            laws.draw(axes, "height", runs, column, label=label, **marks | look)
            label = ""  # one entry of the legend for all kinds
    axes.set_xlabel("Height $H$ (m)")
