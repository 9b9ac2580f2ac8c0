"""The animation of creep, nucleation and rupture, as a GIF."""

import os
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from ...analysis.film import event_interval
from ...analysis.lengths import row
from ...analysis.record import parameters_of
from ...datasets.files import replacing
from ...figures import style
from ...model.parameters import Parameters
from ..paper import figure_s2

LOWEST_RATE = 1e-9  # m/s: below this the interface sticks
LEVELS = 25  # of the stress: few colours make a small file
SPAN = 0.995  # part of the stress's values that the colours tell apart
DOTS = 125.0  # per inch
COLOURS = 128
PAUSE = 80  # ms that a frame is shown
LAST_PAUSE = 1500
KILO = 1e3

Update = Callable[[int], object]
"""Changes one panel to the frame of a number."""


def frames(film: xr.Dataset, row: xr.Dataset) -> Iterator[Image.Image]:
    """Draw one image for every time of a film, :func:`nucleation.analysis.film.film_dataset`.

    `row` is its simulation's entry of the table of lengths, of which ``onset_time`` (s) and
    ``length`` (m) are marked.
    """
    with mpl.rc_context(style.STYLE):
        figure, updates = _panels(film, row)
        for i in range(film.sizes["time"]):
            for update in updates:
                update(i)
            figure.set_dpi(DOTS)
            figure.canvas.draw()
            if i == 0:
                figure.set_layout_engine("none")  # nothing may move from frame to frame
            yield Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")  # type: ignore[attr-defined]


def save(images: Iterable[Image.Image], path: str | os.PathLike[str]) -> None:
    """Write a GIF that repeats for ever, whole or not at all."""
    images = list(images)
    palette = images[-1].quantize(COLOURS, Image.Quantize.MAXCOVERAGE)  # keeps white white
    first, *others = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    film: Any = {"append_images": others, "duration": [PAUSE] * len(others) + [LAST_PAUSE]}
    with replacing(path) as temporary:
        first.save(temporary, format="GIF", save_all=True, loop=0, optimize=True, **film)


def _panels(film: xr.Dataset, row: xr.Dataset) -> tuple[Figure, list[Update]]:
    """Slip rate above the stress in the bodies above the force: whole, and near the event."""
    parameters = parameters_of(film)
    bodies = 1.0 if parameters.below is None else 1.5  # height of their panel
    figure = style.new_figure(7.2, 4.5 * (2.15 + bodies) / 3.15)
    panels = figure.subplot_mosaic("aa;bb;cd", height_ratios=(1.15, bodies, 1.0))
    rate, block, whole, near = panels.values()
    onset = float(row["onset_time"])
    interval = event_interval(film, onset)
    title = rate.set_title("", loc="left")
    times = film["time"].values
    updates = [
        lambda i: title.set_text(_clock(float(times[i]), onset)),
        _rate_panel(rate, film, float(row["length"])),
        _block_panel(block, film, parameters),
        _force_panel(whole, film, (0.0, float(times[-1]), 0.0, 1.0)),
        _force_panel(near, film, (*interval, onset if np.isfinite(onset) else 0.0, KILO)),
    ]
    whole.set_xlabel("$t$ (s)", labelpad=1.0)
    whole.set_ylabel("$-f_d$ (kN/m)")
    near.set_xlabel("from the onset (ms)", labelpad=1.0)
    return figure, updates


def _clock(time: float, onset: float) -> str:
    """The time, and near the onset how far that is."""
    if not np.isfinite(onset) or time < onset - 0.1:
        return f"$t$ = {time:.2f} s"
    return f"$t$ = {time:.4f} s: {KILO * (time - onset):+.2f} ms from the onset"


def _rate_panel(axes: Axes, film: xr.Dataset, length: float) -> Update:
    """The slip rate on a logarithmic axis, the critical length dashed."""
    x, values = film["x"].values, np.maximum(film["slip_rate"].values, 1e-3 * LOWEST_RATE)
    (line,) = axes.plot(x, values[0], color=style.VERMILLION)
    if np.isfinite(length):
        axes.axvline(length, color=style.GUIDE, linestyle="--", linewidth=0.9)
        axes.annotate("$L_c$", (length, 0.06), (4, 0), axes.get_xaxis_transform(), "offset points")
    axes.set_yscale("log")
    axes.set_ylim(LOWEST_RATE, 3.0 * values.max())
    axes.set_xlim(x[0], x[-1])
    axes.set_ylabel("Slip rate (m/s)")
    axes.tick_params(labelbottom=False)
    return lambda i: line.set_ydata(values[i])


def _block_panel(axes: Axes, film: xr.Dataset, parameters: Parameters) -> Update:
    """Filled contours of the shear stress over the normal stress; heights are stretched.

    Of two bodies each is drawn on its own side of the interface, which is a line then.
    """
    x, y = film["x"].values, film["y"].values
    ratio = film["block_shear_stress"].values / parameters.loading.normal_stress
    colours = np.linspace(0.0, float(np.quantile(ratio, SPAN)), LEVELS)
    first = int(np.searchsorted(y, 0.0, side="right")) - 1  # of the upper body: y = 0 is its last
    bodies = [slice(0, first), slice(first, None)] if first else [slice(None)]

    def draw(i: int) -> Any:
        while axes.collections:
            axes.collections[0].remove()
        for own in bodies:
            field = x, y[own], ratio[i, own]
            drawn = axes.contourf(*field, colours, extend="both", cmap=style.SEQUENCE)
        return drawn

    bar = axes.figure.colorbar(draw(0), ax=axes, pad=0.01, aspect=8, ticks=colours[:: LEVELS // 2])
    bar.ax.set_yticklabels([f"{level:.2f}" for level in colours[:: LEVELS // 2]])
    bar.set_label(r"$\sigma_{xy}/\sigma_0$")
    below = parameters.below
    axes.set_ylim(-below.geometry.height if below else 0.0, parameters.geometry.height)
    if below:
        axes.axhline(0.0, color="white", linewidth=1.2)
    axes.set_xlabel("$x$ (m)", labelpad=1.0)
    axes.set_ylabel("$y$ (m)")
    return draw


def _force_panel(axes: Axes, film: xr.Dataset, window: figure_s2.Window) -> Update:
    """The driving force over a window, with a point at the moment if it is in there."""
    figure_s2.draw_force(axes, film, window)
    drawn = np.asarray(axes.lines[0].get_xydata())
    (point,) = axes.plot([], [], "o", color=style.VERMILLION)
    now = (film["time"].values - window[2]) * window[3]
    return lambda i: point.set_data([now[i]], [np.interp(now[i], *drawn.T)])


def of_run(film: xr.Dataset, lengths: xr.Dataset, id: str) -> dict[str, Any]:
    """The step ``draw_animation``: a GIF."""
    images = frames(film, row(lengths, id))
    return {".gif": lambda path: save(images, path)}
