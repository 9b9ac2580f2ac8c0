"""Where the text of a drawn figure lies, to check that nothing overlaps or is cut off."""

from itertools import combinations

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from nucleation.pictures import style


def all_axes(figure: Figure) -> list[Axes]:
    """The axes of a figure, insets included."""
    return [axes for outer in figure.axes for axes in (outer, *outer.child_axes)]


def visible_texts(figure: Figure) -> list[Text]:
    """All text that is drawn: tick labels only where they lie within the axis."""
    hidden = set()
    for axes in all_axes(figure):
        for axis, number in ((axes.xaxis, 0), (axes.yaxis, 1)):
            low, high = sorted(axis.get_view_interval())
            for label in axis.get_ticklabels(which="both"):
                inside = low <= label.get_position()[number] <= high
                if not (inside and axes.axison and axis.get_visible()):
                    hidden.add(label)
    texts = figure.findobj(Text)
    return [t for t in texts if t not in hidden and t.get_visible() and t.get_text().strip()]


def boxes(figure: Figure) -> list[tuple[str, Bbox]]:
    """Text and bounding box (pixels) of all visible text, after laying the figure out."""
    with mpl.rc_context(style.STYLE):
        figure.draw_without_rendering()
        found = [(t.get_text(), t.get_window_extent()) for t in visible_texts(figure)]
    return [(text, box) for text, box in found if box.width > 0]


def points_inside(axes: Axes, x: np.ndarray, y: np.ndarray, box: Bbox) -> int:
    """How many of the data points lie within a box given in pixels."""
    pixels = axes.transData.transform(np.column_stack([x, y]))
    return int(np.count_nonzero([box.contains(*point) for point in pixels]))


def require_legible(figure: Figure) -> None:
    """Fail unless all text of a figure is large enough, whole and free of other text."""
    found = boxes(figure)
    margin = 1.5 * figure.dpi / 72.0  # the blank margin of a line of type
    for (first, a), (second, b) in combinations(found, 2):
        shared = Bbox.intersection(a, b)
        apart = shared is None or min(shared.width, shared.height) <= margin
        assert apart, f"{first} and {second} overlap"
    width, height = figure.get_size_inches() * figure.dpi + 0.5
    for text, box in found:
        assert min(box.x0, box.y0) >= -0.5 and box.x1 <= width and box.y1 <= height, text
    assert min(text.get_fontsize() for text in visible_texts(figure)) >= 7.5  # points
