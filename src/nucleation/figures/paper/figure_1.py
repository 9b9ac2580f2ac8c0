"""Figure 1: the two set-ups, long bodies in sliding contact and the block pushed from its side."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from ...figures import style

LOAD = style.BLACK
MOTION = style.VERMILLION


@style.styled
def draw() -> Figure:
    """Draw the sketch of both systems; it depends on no data.

    Returns
    -------
    Figure
        Two columns wide: long bodies on the left, the finite block on a rigid base on the right.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 5.9 * style.CENTIMETRE)
    left, right = figure.subplots(1, 2)
    for axes in (left, right):
        axes.set_axis_off()
    _long_bodies(left)
    _block_on_rigid_base(right)
    for axes in (left, right):
        axes.set_xlim(-5.6, 5.6)
        axes.set_ylim(-3.45, 3.85)
    return figure


def _long_bodies(axes: Axes) -> None:
    """The left panel: two essentially infinite bodies, pressed and sheared."""
    half, upper, lower = 5.2, 2.3, 1.9
    _faded_body(axes, (-half, half), (0.0, upper), style.UPPER_BODY)
    _faded_body(axes, (-half, half), (-lower, 0.0), style.LOWER_BODY)
    _pressure(axes, np.linspace(-3.6, 3.6, 7), upper, downward=True)
    _pressure(axes, np.linspace(-3.6, 3.6, 7), -lower, downward=False)
    _text(axes, 0.45, upper + 1.15, r"$\sigma_0$")
    _text(axes, 0.45, -lower - 1.15, r"$\sigma_0$")
    _text(axes, 0.9, upper / 2.0, r"$\mu^{(1)},\ \nu^{(1)}$")
    _text(axes, 0.9, -lower / 2.0, r"$\mu^{(2)},\ \nu^{(2)}$")
    _dimension(axes, (3.6, 0.0), (3.6, upper), r"$H^{(1)}$", (-0.55, 0.0))
    _dimension(axes, (3.6, -lower), (3.6, 0.0), r"$H^{(2)}$", (-0.55, 0.0))
    _velocity(axes, (-1.9, 1.65), (-0.3, 1.65), (-1.1, 2.0))
    _arrow(axes, (-3.3, 0.0), (-2.0, 0.0), style.BLACK)
    _arrow(axes, (-3.3, 0.0), (-3.3, 1.3), style.BLACK)
    _text(axes, -2.0, 0.36, "$x$")
    _text(axes, -3.0, 1.2, "$y$")
    _text(axes, -5.2, 3.5, "(a)")


def _block_on_rigid_base(axes: Axes) -> None:
    """The right panel: the finite block, pushed at its left edge over a rigid body."""
    start, end, height, depth = -3.7, 4.0, 2.3, 1.1
    axes.add_patch(
        Rectangle(
            (start, 0.0),
            end - start,
            height,
            facecolor=_tint(style.UPPER_BODY, 0.55),
            edgecolor=style.BLACK,
            linewidth=0.9,
        )
    )
    _faded_body(axes, (-5.2, 5.2), (-depth, 0.0), style.RIGID_BODY)
    _pressure(axes, np.linspace(start + 0.35, end - 0.35, 8), height, downward=True)
    _text(axes, (start + end) / 2.0, height + 1.15, r"$\sigma_0$")
    _text(axes, 0.75, height / 2.0, r"$\mu,\ \nu$")
    _text(axes, 0.15, -depth / 2.0, r"rigid, $\mu^{(2)}\!\to\infty$")
    for y in np.linspace(0.35, height - 0.35, 4):
        _arrow(axes, (start - 1.0, y), (start - 0.04, y), MOTION)
    _text(axes, start - 1.35, height / 2.0, "$V$", color=MOTION)
    _dimension(axes, (end - 0.75, 0.0), (end - 0.75, height), "$H$", (-0.4, 0.0))
    _dimension(axes, (start, -depth - 0.45), (end, -depth - 0.45), "$L$", (0.0, -0.4))
    _text(axes, end + 0.35, height / 2.0, "free", rotation=90)
    _arrow(axes, (end, 0.0), (end + 1.2, 0.0), style.BLACK)
    _arrow(axes, (start, height), (start, height + 1.0), style.BLACK)
    _text(axes, end + 1.45, 0.0, "$x$")
    _text(axes, start - 0.3, height + 0.9, "$y$")
    _text(axes, -5.2, 3.5, "(b)")


def _tint(colour: str, strength: float) -> tuple[float, float, float]:
    """A colour mixed with white: `strength` one is the colour itself, zero is white."""
    red, green, blue = (1.0 - strength * (1.0 - c) for c in to_rgb(colour))
    return red, green, blue


def _faded_body(axes: Axes, x: tuple[float, float], y: tuple[float, float], colour: str) -> None:
    """A body without ends: its colour, and the lines along its edges, fade to either side."""
    _faded_band(axes, x, y, _tint(colour, 0.55), order=0.0)
    for edge in y:
        width = 0.06 if edge == 0.0 else 0.03  # the interface is the heavier line
        _faded_band(axes, x, (edge - width / 2.0, edge + width / 2.0), (0.0,) * 3, order=1.0)


def _faded_band(
    axes: Axes,
    x: tuple[float, float],
    y: tuple[float, float],
    colour: tuple[float, ...],
    order: float,
) -> None:
    """A horizontal band that is opaque inside and transparent at its ends."""
    position = np.linspace(-1.0, 1.0, 512)
    image = np.empty((1, position.size, 4))
    image[..., :3] = colour
    image[..., 3] = np.clip((1.0 - np.abs(position)) / 0.3, 0.0, 1.0)
    axes.imshow(image, extent=(*x, *y), aspect="equal", interpolation="bilinear", zorder=order)


def _arrow(
    axes: Axes, tail: tuple[float, float], head: tuple[float, float], colour: str, kind: str = "-|>"
) -> None:
    """An arrow in data coordinates; `kind` is a matplotlib arrow style."""
    axes.annotate(
        "",
        xy=head,
        xytext=tail,
        arrowprops={
            "arrowstyle": f"{kind},head_length=0.35,head_width=0.17",
            "color": colour,
            "linewidth": 1.0,
            "shrinkA": 0.0,
            "shrinkB": 0.0,
        },
    )


def _pressure(axes: Axes, positions: np.ndarray, edge: float, *, downward: bool) -> None:
    """A row of arrows that press on a horizontal edge from outside."""
    outside = edge + (0.8 if downward else -0.8)
    for x in positions:
        _arrow(axes, (x, outside), (x, edge), LOAD)


def _dimension(
    axes: Axes,
    start: tuple[float, float],
    end: tuple[float, float],
    label: str,
    offset: tuple[float, float],
) -> None:
    """A double-headed arrow between two points, its label moved from its middle by `offset`."""
    _arrow(axes, start, end, style.GUIDE, kind="<|-|>")
    middle = ((start[0] + end[0]) / 2.0 + offset[0], (start[1] + end[1]) / 2.0 + offset[1])
    _text(axes, *middle, label)


def _velocity(
    axes: Axes, tail: tuple[float, float], head: tuple[float, float], at: tuple[float, float]
) -> None:
    """The arrow of the relative sliding velocity V."""
    _arrow(axes, tail, head, MOTION)
    _text(axes, *at, "$V$", color=MOTION)


def _text(axes: Axes, x: float, y: float, label: str, **options: Any) -> None:
    """A centred label."""
    axes.text(x, y, label, ha="center", va="center", fontsize=10.0, **options)
