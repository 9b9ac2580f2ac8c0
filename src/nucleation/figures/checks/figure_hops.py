"""Why a coarse mesh nucleates early: the front's hops from node to node perturb the patch."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style

SHOWN_TIME = (-5.0, 0.12)  # s about the onset
SHOWN_RATE = 1.25  # largest slip rate shown over V, above which curves would cross
SHIFT = 1.1  # between the curves of slip rate, over V


@style.styled
def draw(hops: Sequence[xr.Dataset], patch: xr.Dataset) -> Figure:
    """Draw the slip rate in a patch, its oscillation, and the frequencies of hops and patch.

    Parameters
    ----------
    hops : sequence of Dataset
        From :func:`nucleation.patch.hops.follow_hops`, of one height, from coarse to fine along x.
    patch : Dataset
        The stability of that height's patch: ``patch_length`` (m), ``oscillation_frequency``
        (1/s) on ``instant``, and ``stability_length`` (m).
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 10.0 * style.CENTIMETRE)
    panels = figure.subplot_mosaic("aa;bc", height_ratios=(1.1, 1.0))
    _draw_slip_rates(panels["a"], hops)
    _draw_amplitudes(panels["b"], hops)
    _draw_frequencies(panels["c"], hops, patch)
    style.letters(*panels.values())
    return figure


def _draw_slip_rates(axes: Axes, hops: Sequence[xr.Dataset]) -> None:
    """Slip rate half-way along the last patch, curves of different meshes one above another."""
    for i, (run, colour) in enumerate(zip(hops, style.shades(len(hops)), strict=True)):
        onset = float(run["onset_time"])
        time, rate = run["time"].values - onset, run["inner_slip_rate"].values
        scaled = rate / float(run["velocity"])
        shown = (time > SHOWN_TIME[0]) & (time < SHOWN_TIME[1]) & (scaled < SHOWN_RATE)
        axes.plot(time[shown], scaled[shown] + i * SHIFT, color=colour, linewidth=1.0)
        hop = run["hop_time"].values - onset
        hop = hop[hop > SHOWN_TIME[0]]
        axes.plot(
            hop, np.full(hop.size, i * SHIFT - 0.02), "|", color=colour, markersize=4.5,
            markeredgewidth=0.7,
        )  # fmt: skip
        axes.text(
            SHOWN_TIME[0] + 0.1, i * SHIFT + 0.72, f"$N_x={int(run['n_x'])}$", color=colour,
            fontsize=style.SMALL,
        )  # fmt: skip
    axes.set_xlim(*SHOWN_TIME)
    axes.set_ylim(-0.2, (len(hops) - 1) * SHIFT + SHOWN_RATE + 0.1)
    axes.set_xlabel("Time from the onset (s)")
    axes.set_ylabel("Slip rate $v/V$, shifted")


def _draw_amplitudes(axes: Axes, hops: Sequence[xr.Dataset]) -> None:
    """Amplitude of the slip rate's oscillation against time."""
    for run, colour in zip(hops, style.shades(len(hops)), strict=True):
        amplitude = run["oscillation_amplitude"].values / float(run["velocity"])
        axes.plot(run["sample_time"].values, amplitude, color=colour, linewidth=1.0)
    axes.set_yscale("log")
    axes.set_xlabel("Time $t$ (s)")
    axes.set_ylabel("Oscillation of $v/V$")


def _draw_frequencies(axes: Axes, hops: Sequence[xr.Dataset], patch: xr.Dataset) -> None:
    """Frequency of the hops on each mesh, and the patch's own, against the patch's length."""
    for run, colour in zip(hops, style.shades(len(hops)), strict=True):
        axes.plot(
            run["hop_length"].values, run["hop_frequency"].values, color=colour,
        )  # fmt: skip
    own = patch["oscillation_frequency"].values
    seen = own > 0.0  # a short patch has no oscillating mode
    axes.plot(
        patch["patch_length"].values[seen], own[seen], ".", color=style.BLACK, markersize=2.0,
        rasterized=True,
    )  # fmt: skip
    axes.axvline(float(patch["stability_length"]), color=style.GUIDE, linewidth=0.8, linestyle=":")
    axes.text(0.03, 0.05, "the patch's own", transform=axes.transAxes, fontsize=style.SMALL)
    axes.set_yscale("log")
    axes.set_ylim(5.0, 300.0)
    axes.set_yticks([10.0, 100.0], ["10", "100"])
    axes.set_xlabel("Patch length $L$ (m)")
    axes.set_ylabel("Angular frequency (1/s)")
