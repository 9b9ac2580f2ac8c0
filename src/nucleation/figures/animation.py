"""The animation of creep, nucleation and rupture, as a GIF."""

from __future__ import annotations

import io
import os
from collections.abc import Iterator

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from ..files import replacing
from ..parameters import Parameters
from . import style

LOWEST_RATE = 1e-9  # m/s: below this the interface sticks
LEVELS = 17  # of the stress: few colours make a small file
DOTS = 100.0  # per inch
COLOURS = 64
PAUSE = 80  # ms that a frame is shown
LAST_PAUSE = 1500
EXTENT = 0.99  # the stress's colours span this part of its values


def frames(film: xr.Dataset, row: xr.Dataset) -> Iterator[Image.Image]:
    """Draw one image for every time of a film.

    Parameters
    ----------
    film : Dataset
        Of :func:`nucleation.film.film_dataset`.
    row : Dataset
        Its simulation's entry of the table of lengths.
    """
    parameters = Parameters.from_json(film.attrs["parameters"])
    ratio = film["block_shear_stress"].values / parameters.loading.normal_stress
    levels = np.linspace(0.0, float(np.quantile(ratio, EXTENT)), LEVELS)
    with mpl.rc_context(style.STYLE):
        for i in range(film.sizes["time"]):
            figure = _draw(film, row, parameters, ratio[i], levels, i)
            buffer = io.BytesIO()
            figure.savefig(buffer, format="png", dpi=DOTS)
            yield Image.open(buffer).convert("RGB")


def save(images: Iterator[Image.Image], path: str | os.PathLike[str]) -> None:
    """Write a GIF that repeats for ever, whole or not at all."""
    small = [
        image.quantize(COLOURS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
        for image in images
    ]
    pauses = [PAUSE] * (len(small) - 1) + [LAST_PAUSE]
    with replacing(path) as temporary:
        small[0].save(
            temporary, format="GIF", save_all=True, append_images=small[1:], duration=pauses,
            loop=0, optimize=True,
        )  # fmt: skip


def _draw(
    film: xr.Dataset,
    row: xr.Dataset,
    parameters: Parameters,
    ratio: np.ndarray,
    levels: np.ndarray,
    index: int,
) -> Figure:
    """One frame: slip rate, stress in the block, and the force with the moment marked."""
    figure = style.new_figure(7.2, 4.3)
    rate, block, force = figure.subplots(3, 1, height_ratios=(1.2, 1.0, 1.0))
    time = float(film["time"][index])
    _draw_rate(rate, film, row, index)
    _draw_block(block, film, ratio, levels, parameters)
    _draw_force(force, film, row, index)
    onset = float(row["onset_time"])
    rate.set_title(_clock(time, onset), loc="left", family="monospace")
    rate.sharex(block)
    rate.tick_params(labelbottom=False)
    return figure


def _clock(time: float, onset: float) -> str:
    """The time, and how far the onset is, in text of constant width."""
    if not np.isfinite(onset) or time < onset - 0.1:
        return f"t = {time:7.3f} s"
    return f"t = {time:7.3f} s   {1e3 * (time - onset):+9.3f} ms from the onset"


def _draw_rate(axes: Axes, film: xr.Dataset, row: xr.Dataset, index: int) -> None:
    values = film["slip_rate"].values
    axes.plot(film["x"], np.maximum(values[index], 1e-3 * LOWEST_RATE), color=style.VERMILLION)
    axes.axvline(float(row["length"]), color=style.GUIDE, linestyle="--", linewidth=0.9)
    axes.set_yscale("log")
    axes.set_ylim(LOWEST_RATE, 3.0 * values.max())
    axes.set_ylabel("Slip rate (m/s)")


def _draw_block(
    axes: Axes, film: xr.Dataset, ratio: np.ndarray, levels: np.ndarray, parameters: Parameters
) -> None:
    """Filled contours of the shear stress over the normal stress; heights are stretched."""
    image = axes.contourf(film["x"], film["y"], ratio, levels, extend="both", cmap=style.SEQUENCE)
    bar = axes.figure.colorbar(image, ax=axes, pad=0.01, aspect=8, ticks=levels[::8])
    bar.ax.set_yticklabels([f"{level:.2f}" for level in levels[::8]])
    bar.set_label(r"$\sigma_{xy}/\sigma_0$")
    axes.set_ylim(0.0, parameters.geometry.height)
    axes.set_xlabel("$x$ (m)", labelpad=1.0)
    axes.set_ylabel("$y$ (m)")


def _draw_force(axes: Axes, film: xr.Dataset, row: xr.Dataset, index: int) -> None:
    time, force = film["step_time"].values, -film["driving_force"].values / 1e3
    now = float(film["time"][index])
    axes.plot(time, force, color=style.DRIVE, linewidth=1.1)
    axes.plot(now, np.interp(now, time, force), "o", color=style.VERMILLION)
    axes.axvline(float(row["onset_time"]), color=style.GUIDE, linestyle=":", linewidth=0.9)
    axes.set_xlim(0.0, float(film["time"][-1]))
    axes.set_ylim(0.0, None)
    axes.set_xlabel("$t$ (s)", labelpad=1.0)
    axes.set_ylabel("$-f_d$ (kN/m)")
