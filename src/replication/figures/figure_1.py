"""Figure 1: the two set-ups, long bodies in sliding contact and the block pushed from its side."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from nucleation.pictures import style
from nucleation.pictures.style import Point
from nucleation.types import Array

_MOTION = style.VERMILLION
_Colour = tuple[float, ...]


@style.styled
def draw() -> Figure:
    """Draw the sketch of both systems; it depends on no data."""
    figure, (left, right) = style.panels(1, 2, 5.9)
    _long_bodies(left)
    _block_on_rigid_base(right)
    for axes in (left, right):
        axes.set_axis_off()
        axes.set(xlim=(-5.6, 5.6), ylim=(-3.45, 3.85))
    return figure


def _long_bodies(axes: Axes) -> None:
    """The left panel: two very long bodies, pressed and sheared."""
    sides = (-5.2, 5.2)
    upper = 2.3
    lower = 1.9
    _faded_body(axes, sides, (0.0, upper), style.UPPER_BODY)
    _faded_body(axes, sides, (-lower, 0.0), style.LOWER_BODY)
    arrows = np.linspace(-3.6, 3.6, 7)
    _pressure(axes, arrows, upper, 1.0)
    _pressure(axes, arrows, -lower, -1.0)
    _text(axes, 0.45, upper + 1.15, r"$\sigma_0$")
    _text(axes, 0.45, -lower - 1.15, r"$\sigma_0$")
    _text(axes, 0.9, upper / 2.0, r"$\mu^{(1)},\ \nu^{(1)}$")
    _text(axes, 0.9, -lower / 2.0, r"$\mu^{(2)},\ \nu^{(2)}$")
    _dimension(
        axes,
        (3.6, 0.0),
        (3.6, upper),
        r"$H^{(1)}$",
        (-0.55, 0.0),
    )
    _dimension(
        axes,
        (3.6, -lower),
        (3.6, 0.0),
        r"$H^{(2)}$",
        (-0.55, 0.0),
    )
    style.arrow(
        axes,
        (-1.9, 1.65),
        (-0.3, 1.65),
        _MOTION,
    )
    _text(axes, -1.1, 2.0, "$V$", color=_MOTION)
    style.arrow(
        axes,
        (-3.3, 0.0),
        (-2.0, 0.0),
        style.BLACK,
    )
    style.arrow(
        axes,
        (-3.3, 0.0),
        (-3.3, 1.3),
        style.BLACK,
    )
    _text(axes, -2.0, 0.36, "$x$")
    _text(axes, -3.0, 1.2, "$y$")
    _text(axes, -5.2, 3.5, "(a)")


def _block_on_rigid_base(axes: Axes) -> None:
    """The right panel: the finite block, pushed at its left edge over a rigid body."""
    start = -3.7
    end = 4.0
    height = 2.3
    depth = 1.1
    block = Rectangle(
        (start, 0.0),
        end - start,
        height,
        facecolor=_tint(style.UPPER_BODY),
        edgecolor=style.BLACK,
        linewidth=0.9,
    )
    axes.add_patch(block)
    _faded_body(
        axes,
        (-5.2, 5.2),
        (-depth, 0.0),
        style.RIGID_BODY,
    )
    _pressure(
        axes,
        np.linspace(
            start + 0.35,
            end - 0.35,
            8,
        ),
        height,
        1.0,
    )
    _text(axes, (start + end) / 2.0, height + 1.15, r"$\sigma_0$")
    _text(axes, 0.75, height / 2.0, r"$\mu,\ \nu$")
    _text(axes, 0.15, -depth / 2.0, r"rigid, $\mu^{(2)}\!\to\infty$")
    for y in np.linspace(0.35, height - 0.35, 4):
        style.arrow(
            axes,
            (start - 1.0, y),
            (start - 0.04, y),
            _MOTION,
        )
    _text(axes, start - 1.35, height / 2.0, "$V$", color=_MOTION)
    _dimension(
        axes,
        (end - 0.75, 0.0),
        (end - 0.75, height),
        "$H$",
        (-0.4, 0.0),
    )
    _dimension(
        axes,
        (start, -depth - 0.45),
        (end, -depth - 0.45),
        "$L$",
        (0.0, -0.4),
    )
    _text(axes, end + 0.35, height / 2.0, "free", rotation=90)
    style.arrow(
        axes,
        (end, 0.0),
        (end + 1.2, 0.0),
        style.BLACK,
    )
    style.arrow(
        axes,
        (start, height),
        (start, height + 1.0),
        style.BLACK,
    )
    _text(axes, end + 1.45, 0.0, "$x$")
    _text(axes, start - 0.3, height + 0.9, "$y$")
    _text(axes, -5.2, 3.5, "(b)")


def _tint(colour: str) -> _Colour:
    """A body's colour, mixed with white."""
    return tuple(1.0 - 0.55 * (1.0 - c) for c in to_rgb(colour))


def _faded_body(
    axes: Axes,
    x: Point,
    y: Point,
    colour: str,
) -> None:
    """A body without ends: its colour and its edges fade to either side."""
    _faded_band(axes, x, y, _tint(colour), order=0.0)
    black = (0.0, 0.0, 0.0)
    for edge in y:
        width = 0.06 if edge == 0.0 else 0.03  # the interface is the heavier line
        _faded_band(
            axes,
            x,
            (edge - width / 2.0, edge + width / 2.0),
            black,
            order=1.0,
        )


def _faded_band(
    axes: Axes,
    x: Point,
    y: Point,
    colour: _Colour,
    order: float,
) -> None:
    """A horizontal band that is opaque inside and transparent at its ends."""
    position = np.linspace(-1.0, 1.0, 512)
    image = np.empty((1, position.size, 4))
    image[..., :3] = colour
    image[..., 3] = np.clip(
        (1.0 - np.abs(position)) / 0.3,
        0.0,
        1.0,
    )
    axes.imshow(
        image,
        extent=(*x, *y),
        aspect="equal",
        interpolation="bilinear",
        zorder=order,
    )


def _pressure(
    axes: Axes,
    positions: Array,
    edge: float,
    outwards: float,
) -> None:
    """A row of arrows that press on a horizontal edge from outside."""
    for x in positions:
        style.arrow(
            axes,
            (x, edge + 0.8 * outwards),
            (x, edge),
        )


def _dimension(
    axes: Axes,
    start: Point,
    end: Point,
    label: str,
    offset: Point,
) -> None:
    """A double-headed arrow between two points, with a label at an offset from its middle."""
    style.arrow(axes, start, end, style.GUIDE, "<|-|>")
    x, y = np.mean([start, end], axis=0) + offset
    _text(axes, x, y, label)


def _text(axes: Axes, x: float, y: float, label: str, **options: Any) -> None:
    """A centred label."""
    axes.text(
        x,
        y,
        label,
        ha="center",
        va="center",
        fontsize=10.0,
        **options,
    )
