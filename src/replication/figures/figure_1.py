"""Figure 1: the two set-ups, long bodies in sliding contact and the block pushed from its side."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from nucleation.pictures import style

_MOTION = style.VERMILLION
_INK = 0.55  # opacity of a body's colour
_SIDE = 5.2  # x of the letters


@style.styled()
def draw() -> Figure:
    """Draw the sketch of both systems; it depends on no data."""
    figure, (left, right) = style.panels(5.9, columns=2)
    for axes in (left, right):
        axes.set_axis_off()
    _draw_long_bodies(left)
    _draw_block_on_rigid_base(right)
    for axes, letter in ((left, "(a)"), (right, "(b)")):
        _draw_texts(axes, (-_SIDE, 3.5, letter))
        axes.set(xlim=(-5.6, 5.6), ylim=(-3.45, 3.85))
    return figure


def _draw_long_bodies(axes: Axes) -> None:
    """The left panel: two very long bodies, pressed and sheared."""
    _draw_body(axes, 0.0, 2.3, style.UPPER_BODY)
    _draw_body(axes, -1.9, 0.0, style.LOWER_BODY)
    pressed = np.linspace(-3.6, 3.6, 7)
    _draw_arrows(axes, *((x, 3.1, x, 2.3) for x in pressed))
    _draw_arrows(axes, *((x, -2.7, x, -1.9) for x in pressed))
    _draw_arrows(axes, (-3.3, 0.0, -2.0, 0.0), (-3.3, 0.0, -3.3, 1.3))
    _draw_arrows(axes, (-1.9, 1.65, -0.3, 1.65), colour=_MOTION)
    heights = (3.6, 0.0, 3.6, 2.3), (3.6, -1.9, 3.6, 0.0)
    _draw_arrows(axes, *heights, colour=style.GUIDE, kind="<|-|>")
    _draw_texts(axes, (-1.1, 2.0, "$V$"), color=_MOTION)
    _draw_texts(
        axes,
        (0.45, 3.45, r"$\sigma_0$"),
        (0.45, -3.05, r"$\sigma_0$"),
        (0.9, 1.15, r"$\mu^{(1)},\ \nu^{(1)}$"),
        (0.9, -0.95, r"$\mu^{(2)},\ \nu^{(2)}$"),
        (3.05, 1.15, "$H^{(1)}$"),
        (3.05, -0.95, "$H^{(2)}$"),
        (-2.0, 0.36, "$x$"),
        (-3.0, 1.2, "$y$"),
    )


def _draw_block_on_rigid_base(axes: Axes) -> None:
    """The right panel: the finite block, pushed at its left edge over a rigid body."""
    axes.add_patch(
        Rectangle((-3.7, 0.0), 7.7, 2.3, facecolor=(style.UPPER_BODY, _INK), edgecolor=style.BLACK)
    )
    _draw_body(axes, -1.1, 0.0, style.RIGID_BODY)
    _draw_arrows(axes, *((x, 3.1, x, 2.3) for x in np.linspace(-3.35, 3.65, 8)))
    _draw_arrows(axes, (4.0, 0.0, 5.2, 0.0), (-3.7, 2.3, -3.7, 3.3))
    pushed = np.linspace(0.35, 1.95, 4)
    _draw_arrows(axes, *((-4.7, y, -3.74, y) for y in pushed), colour=_MOTION)
    sizes = (3.25, 0.0, 3.25, 2.3), (-3.7, -1.55, 4.0, -1.55)
    _draw_arrows(axes, *sizes, colour=style.GUIDE, kind="<|-|>")
    _draw_texts(axes, (-5.05, 1.15, "$V$"), color=_MOTION)
    _draw_texts(axes, (4.35, 1.15, "free"), rotation=90)
    _draw_texts(
        axes,
        (0.15, 3.45, r"$\sigma_0$"),
        (0.75, 1.15, r"$\mu,\ \nu$"),
        (0.15, -0.55, r"rigid, $\mu^{(2)}\!\to\infty$"),
        (2.85, 1.15, "$H$"),
        (0.15, -1.95, "$L$"),
        (5.0, 0.36, "$x$"),
        (-4.0, 3.2, "$y$"),
    )


def _draw_body(axes: Axes, low: float, high: float, colour: str) -> None:
    """A body without ends, across the whole panel."""
    axes.axhspan(low, high, facecolor=(colour, _INK), linewidth=0.0)
    for edge in (low, high):
        axes.axhline(edge, color=style.BLACK, linewidth=0.9 if edge else 1.8)  # heavier interface


def _draw_arrows(
    axes: Axes, *ends: Iterable[float], colour: str = style.BLACK, kind: str = "-|>"
) -> None:
    """Arrows, each from the first point (x, y) to the second."""
    look: style.Options = {"arrowstyle": f"{kind},head_length=0.35,head_width=0.17"}
    look |= {"color": colour, "linewidth": 1.0, "shrinkA": 0.0, "shrinkB": 0.0}
    for x, y, head_x, head_y in ends:
        axes.annotate("", (head_x, head_y), (x, y), arrowprops=look)


def _draw_texts(axes: Axes, *texts: tuple[float, float, str], **look: Any) -> None:
    """Centred labels, each at a point (x, y)."""
    for x, y, text in texts:
        axes.text(x, y, text, ha="center", va="center", fontsize=10.0, **look)
