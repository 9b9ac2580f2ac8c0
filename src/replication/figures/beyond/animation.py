"""The animation of creep, nucleation and rupture, as a GIF."""

import os
from collections.abc import Callable, Iterable, Iterator

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from PIL import Image

from nucleation.datasets.files import replacing
from nucleation.extraction.record import parameters_of
from nucleation.model.parameters import Parameters
from nucleation.pictures import style
from nucleation.pictures.units import time_unit

from ...tables.lengths import row
from ..film import event_interval
from ..paper import figure_s2

_LOWEST_RATE = 1e-4  # over V: below this the interface sticks
_NEAR = 2.0  # D/V before the onset from which the time is counted from it
_LEVELS = 25  # of the stress: few colours make a small file
_SPAN = 0.995  # part of the stress's values within the range of colours
_DOTS = 125.0  # per inch
_COLOURS = 128
_PAUSE = 80  # ms for each frame
_LAST_PAUSE = 1500

_Update = Callable[[int], object]
"""Changes one panel to the frame with this number."""


def frames(film: xr.Dataset, row: xr.Dataset) -> Iterator[Image.Image]:
    """Draw one image for every time of a film.

    Parameters
    ----------
    film : Dataset
        From :func:`replication.figures.film.film_dataset`.
    row : Dataset
        Its simulation's entry of the table of lengths, with ``onset_time`` (s) and ``length`` (m).

    Yields
    ------
    Image
        One frame.
    """
    with mpl.rc_context(style.STYLE):
        figure, updates = _panels(film, row)
        canvas = figure.canvas
        assert isinstance(canvas, FigureCanvasAgg)
        for i in range(film.sizes["time"]):
            for update in updates:
                update(i)
            figure.set_dpi(_DOTS)
            canvas.draw()
            if i == 0:
                figure.set_layout_engine("none")  # nothing may move from frame to frame
            pixels = np.asarray(canvas.buffer_rgba())
            yield Image.fromarray(pixels).convert("RGB")


def save(
    images: Iterable[Image.Image],
    path: str | os.PathLike[str],
    still: int = 0,
) -> None:
    """Write a GIF that repeats for ever, completely or not at all.

    Parameters
    ----------
    images : iterable of Image
        The frames.
    path : path
        The file; an older one is replaced.
    still : int
        Number of the frame that comes first, then all follow: on paper and where pictures don't
        move it is the only one.
    """
    images = list(images)
    images.insert(0, images[still])
    palette = images[-1].quantize(_COLOURS, Image.Quantize.MAXCOVERAGE)  # keeps white white
    first, *others = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    pauses = [_PAUSE] * len(others) + [_LAST_PAUSE]
    with replacing(path) as temporary:
        first.save(
            temporary,
            format="GIF",
            save_all=True,
            loop=0,
            optimize=True,
            append_images=others,
            duration=pauses,
        )


def _panels(film: xr.Dataset, row: xr.Dataset) -> tuple[Figure, list[_Update]]:
    """Slip rate, stress in the bodies, and force: the whole run, and near the event."""
    parameters = parameters_of(film)
    bodies = 1.0 if parameters.below is None else 1.5  # height of their panel
    figure = style.new_figure(7.2, 4.5 * (2.15 + bodies) / 3.15)
    panels = figure.subplot_mosaic("aa;bb;cd", height_ratios=(1.15, bodies, 1.0))
    rate, block, whole, near = panels.values()
    onset = float(row["onset_time"])
    start, end = event_interval(film, onset)
    title = rate.set_title("")
    times = film["time"].values
    last = float(times[-1])
    run = figure_s2.Window(0.0, last, 0.0, *time_unit(last))
    origin = onset if np.isfinite(onset) else 0.0
    event = figure_s2.Window(start, end, origin, *time_unit(max(end - origin, origin - start)))
    near_onset = onset - _NEAR * parameters.memory_time
    updates: list[_Update] = [
        lambda i: title.set_text(_clock(float(times[i]), near_onset, run, event)),
        _rate_panel(rate, film, float(row["length"]), parameters.loading.velocity),
        _block_panel(block, film, parameters),
        _force_panel(whole, film, run),
        _force_panel(near, film, event),
    ]
    whole.set_xlabel(f"$t$ ({run.unit})", labelpad=1.0)
    whole.set_ylabel(f"$-f_d$ ({figure_s2.force_unit(film)[1]})")
    near.set_xlabel(f"from the onset ({event.unit})", labelpad=1.0)
    return figure, updates


def _clock(
    time: float,
    near_onset: float,
    run: figure_s2.Window,
    event: figure_s2.Window,
) -> str:
    """The time (s), and near the onset the time from it, in the units of two panels."""
    shown = run.shown(np.array(time))
    if not time >= near_onset:
        return f"$t$ = {shown:.2f} {run.unit}"
    after = event.shown(np.array(time))
    return f"$t$ = {shown:.4f} {run.unit}: {after:+.2f} {event.unit} from the onset"


def _rate_panel(
    axes: Axes,
    film: xr.Dataset,
    length: float,
    velocity: float,
) -> _Update:
    """The slip rate on a logarithmic axis from far below V, the length at the drop dashed."""
    lowest = _LOWEST_RATE * velocity
    x = film["x"].values
    values = np.maximum(film["slip_rate"].values, 1e-3 * lowest)
    (line,) = axes.plot(x, values[0], color=style.VERMILLION)
    if np.isfinite(length):
        style.vertical(axes, length)
        up = axes.get_xaxis_transform()
        axes.annotate("$L$", (length, 0.06), (4, 0), up, "offset points")
    axes.set_yscale("log")
    axes.set_ylim(lowest, 3.0 * values.max())
    axes.set_xlim(x[0], x[-1])
    axes.set_ylabel("Slip rate (m/s)")
    axes.tick_params(labelbottom=False)
    return lambda i: line.set_ydata(values[i])


def _block_panel(
    axes: Axes,
    film: xr.Dataset,
    parameters: Parameters,
) -> _Update:
    """Filled contours of the shear stress over the normal stress; heights are stretched.

    Each of two bodies is drawn separately, with a line for the interface between them.
    """
    x = film["x"].values
    y = film["y"].values
    ratio = film["block_shear_stress"].values / parameters.loading.normal_stress
    colours = np.linspace(0.0, float(np.quantile(ratio, _SPAN)), _LEVELS)
    first = (
        int(
            np.searchsorted(
                y,
                0.0,
                side="right",
            )
        )
        - 1
    )  # the last of two y = 0: upper body
    bodies = [slice(0, first), slice(first, None)] if first else [slice(None)]

    def draw(i: int) -> QuadContourSet:
        while axes.collections:
            axes.collections[0].remove()
        for own in bodies:
            drawn = axes.contourf(
                x, y[own], ratio[i, own], colours, extend="both", cmap=style.SEQUENCE
            )
        return drawn

    ticks = colours[:: _LEVELS // 2]
    bar = axes.figure.colorbar(draw(0), ax=axes, pad=0.01, aspect=8, ticks=ticks)
    bar.ax.set_yticklabels([f"{level:.2f}" for level in ticks])
    bar.set_label(r"$\sigma_{xy}/\sigma_0$")
    below = parameters.below
    axes.set_ylim(-below.geometry.height if below else 0.0, parameters.geometry.height)
    if below:
        axes.axhline(0.0, color="white", linewidth=1.2)
    axes.set_xlabel("$x$ (m)", labelpad=1.0)
    axes.set_ylabel("$y$ (m)")
    return draw


def _force_panel(
    axes: Axes,
    film: xr.Dataset,
    window: figure_s2.Window,
) -> _Update:
    """The driving force in a window, with a point at the present time if it is inside."""
    figure_s2.draw_force(axes, film, window)
    drawn = np.asarray(axes.lines[0].get_xydata())
    (point,) = axes.plot([], [], "o", color=style.VERMILLION)
    now = window.shown(film["time"].values)
    return lambda i: point.set_data([now[i]], [np.interp(now[i], *drawn.T)])


def of_run(
    film: xr.Dataset,
    lengths: xr.Dataset,
    id: str,
) -> dict[str, Callable[[str], None]]:
    """The GIF by suffix, as a function that writes it (rule ``animation``).

    Parameters
    ----------
    film : Dataset
        From :func:`replication.figures.film.film_dataset`.
    lengths : Dataset
        Table of lengths.
    id : str
        Name of the run in the table.

    Returns
    -------
    dict
        It is called with the path.
    """
    run = row(lengths, id)
    images = frames(film, run)
    after = np.abs(film["time"].values - float(run["onset_time"]))
    onset = int(np.nanargmin(after)) if np.isfinite(after).any() else 0
    return {".gif": lambda path: save(images, path, onset)}
