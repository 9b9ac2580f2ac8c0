"""The style of all figures: sizes, fonts, colours by meaning, and reproducible files."""

import functools
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, ParamSpec

import matplotlib as mpl
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.transforms import ScaledTranslation, Transform

from ..datasets.files import replacing

P = ParamSpec("P")

Options = dict[str, Any]
"""Keyword arguments of matplotlib's functions."""

Point = tuple[float, float]

CENTIMETRE = 1.0 / 2.54  # inch
SINGLE_COLUMN = 8.6 * CENTIMETRE
DOUBLE_COLUMN = 17.8 * CENTIMETRE

# The colour-blind safe palette of Okabe and Ito, without its yellow, which is too light for paper.
BLACK = "#000000"
ORANGE = "#E69F00"
SKY_BLUE = "#56B4E9"
GREEN = "#009E73"
BLUE = "#0072B2"
VERMILLION = "#D55E00"
PURPLE = "#CC79A7"

# Colours by meaning. If colours could be confused, shapes or dashes differ as well.
THEORY = BLUE
THIN_LIMIT = BLUE
AGING = VERMILLION
SLIP = BLACK
OLD_AGE = "#6B3E12"  # the paper's brown, dark enough to differ from AGING in grey
FULL_LAW = "#8E4585"  # the palette's purple, darkened for thin lines
LOGARITHMIC_LAW = BLUE
GUIDE = "#595959"  # lines that mark a value
DRIVE = BLUE
UPPER_BODY = SKY_BLUE
LOWER_BODY = ORANGE
RIGID_BODY = "#8C8C8C"

MARKERS = "osD^vP*X"
COLOURS = (VERMILLION, BLUE, BLACK, GREEN, PURPLE, ORANGE, SKY_BLUE, OLD_AGE, FULL_LAW)

SEQUENCE = "viridis"  # ordered families of curves and images: monotonic in lightness
SMALL = 7.5  # points: legends with many entries, panels inside panels

STYLE: dict[Any, Any] = {
    "font.family": ["STIXGeneral"],  # comes with matplotlib: the same on every machine
    "mathtext.fontset": "stix",
    "font.size": 9.0,
    "axes.labelsize": 9.0,
    "axes.titlesize": 9.0,
    "axes.titlelocation": "left",
    "legend.fontsize": 8.5,
    "axes.linewidth": 0.7,
    "axes.unicode_minus": True,
    "axes.formatter.use_mathtext": True,
    "xtick.major.pad": 4.5,
    "ytick.major.pad": 4.0,
    "xtick.top": True,
    "ytick.right": True,
    "lines.linewidth": 1.4,
    "lines.markersize": 5.0,
    "errorbar.capsize": 2.0,
    "legend.frameon": False,
    "legend.handlelength": 2.0,
    "legend.borderaxespad": 0.6,
    "figure.dpi": 100.0,
    "savefig.dpi": 300.0,
    "figure.constrained_layout.w_pad": 0.03,
    "figure.constrained_layout.h_pad": 0.03,
    "image.cmap": SEQUENCE,
    "pdf.fonttype": 42,  # TrueType, embedded: text stays text
    "pdf.compression": 6,
}
for _ticks in ("xtick", "ytick"):
    STYLE[f"{_ticks}.labelsize"] = 8.5
    STYLE[f"{_ticks}.direction"] = "in"
    STYLE[f"{_ticks}.major.width"] = 0.7
    STYLE[f"{_ticks}.minor.width"] = 0.5

BOXED: Options = {
    "fontsize": SMALL,
    "frameon": True,
    "framealpha": 1.0,
    "edgecolor": "0.8",
    "fancybox": False,
    "labelspacing": 0.3,
}
"""A legend among scattered points; without the box its marks might be taken for data."""

OPEN: Options = {"markerfacecolor": "white"}

KEY = "Key"
"""Entry of a PNG with the key of its recipe."""


def styled(draw: Callable[P, Figure]) -> Callable[P, Figure]:
    """Decorator: call `draw` with :data:`STYLE`; matplotlib's own settings stay unchanged."""

    @functools.wraps(draw)
    def wrapper(*args: P.args, **kwargs: P.kwargs) -> Figure:
        with mpl.rc_context(STYLE):
            return draw(*args, **kwargs)

    return wrapper


def new_figure(width: float, height: float) -> Figure:
    """An empty figure on the Agg canvas, unknown to pyplot.

    Parameters
    ----------
    width, height : float
        Size in inches.

    Returns
    -------
    Figure
        Without panels.
    """
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def column(height: float) -> tuple[Figure, Axes]:
    """A figure of one column's width with one panel; `height` in centimetres."""
    figure = new_figure(SINGLE_COLUMN, height * CENTIMETRE)
    return figure, figure.add_subplot()


def panels(rows: int, columns: int, height: float, **options: Any) -> tuple[Figure, Any]:
    """A figure of two columns' width with its panels.

    Parameters
    ----------
    rows, columns : int
        Number of panels.
    height : float
        Height of the figure in centimetres.
    **options
        Options of :meth:`matplotlib.figure.Figure.subplots`.

    Returns
    -------
    Figure
        The figure.
    Axes or array of Axes
        Its panels, as of ``subplots``.
    """
    figure = new_figure(DOUBLE_COLUMN, height * CENTIMETRE)
    return figure, figure.subplots(rows, columns, **options)


def look(number: int) -> tuple[str, str]:
    """Marker and colour of one of several kinds; the first 72 differ."""
    return MARKERS[number % len(MARKERS)], COLOURS[number % len(COLOURS)]


def shades(number: int, lightest: float = 0.85) -> list[tuple[float, ...]]:
    """Colours of an ordered family, from dark to light.

    Parameters
    ----------
    number : int
        Number of colours.
    lightest : float
        Position of the last colour in the colour map, from 0 to 1.

    Returns
    -------
    list of tuple
        Red, green, blue and opacity.
    """
    colours = mpl.colormaps[SEQUENCE]
    return [colours(lightest * i / max(number - 1, 1)) for i in range(number)]


def key(
    label: str, marker: str = "", line: Any = "", colour: Any = GUIDE, **options: Any
) -> Line2D:
    """An entry of a legend for several sets of data.

    Parameters
    ----------
    label : str
        Text of the entry.
    marker : str
        Marker of matplotlib.
    line : str or tuple
        Line style of matplotlib.
    colour : str or tuple
        Colour of marker and line.
    **options
        Further options of :class:`matplotlib.lines.Line2D`.

    Returns
    -------
    Line2D
        A handle for the legend.
    """
    return Line2D([], [], marker=marker, linestyle=line, color=colour, label=label, **options)


def letters(*panels: Axes, minor: bool = False, **options: Any) -> None:
    """Letter panels, starting with (a).

    Parameters
    ----------
    *panels : Axes
        The panels in their order.
    minor : bool
        Whether they get minor ticks.
    **options
        Options of :meth:`matplotlib.axes.Axes.set_title`.
    """
    for axes, letter in zip(panels, "abcdefghijklmnopqrstuvwxyz", strict=False):
        axes.set_title(f"({letter})", **options)
        if minor:
            axes.minorticks_on()


def entries(*panels: Axes) -> dict[str, Artist]:
    """The legend entries of some panels, by label, each label once."""
    found: dict[str, Artist] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            found.setdefault(label, handle)
    return found


def plain_numbers(axis: Axis, ticks: Sequence[float] = ()) -> None:
    """Label a logarithmic axis without powers of ten, at some ticks or at matplotlib's."""
    if ticks:
        axis.set_ticks(ticks)
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter("")


def level(axes: Axes, y: float, line: Any = "-", width: float = 0.7, **options: Any) -> None:
    """Draw a horizontal line that marks a value.

    Parameters
    ----------
    axes : Axes
        The panel.
    y : float
        The value.
    line : str or tuple
        Line style of matplotlib.
    width : float
        Width of the line in points.
    **options
        Further options of :meth:`matplotlib.axes.Axes.axhline`.
    """
    usual = {"color": GUIDE, "linestyle": line, "linewidth": width}
    axes.axhline(y, **usual | options)


def vertical(axes: Axes, x: float, line: Any = "--", width: float = 0.9, **options: Any) -> None:
    """Draw a vertical line that marks a value, with the options of :func:`level`."""
    axes.axvline(x, color=GUIDE, linestyle=line, linewidth=width, **options)


def band(
    axes: Axes,
    low: float,
    high: float,
    label: str,
) -> None:
    """Draw a horizontal band of agreement.

    Parameters
    ----------
    axes : Axes
        The panel.
    low, high : float
        Its edges.
    label : str
        Its text in the legend.
    """
    axes.axhspan(low, high, color=GUIDE, alpha=0.15, linewidth=0.0, label=label)


def arrow(
    axes: Axes, tail: Point, head: Point, colour: str = BLACK, kind: str = "-|>", **options: Any
) -> None:
    """Draw an arrow between two points.

    Parameters
    ----------
    axes : Axes
        The panel.
    tail, head : (float, float)
        The points.
    colour : str
        Colour of the arrow.
    kind : str
        Arrow style of matplotlib.
    **options
        Options of :meth:`matplotlib.axes.Axes.annotate`.
    """
    look: Options = {
        "arrowstyle": f"{kind},head_length=0.35,head_width=0.17",
        "linewidth": 1.0,
        "color": colour,
        "shrinkA": 0.0,
        "shrinkB": 0.0,
    }
    axes.annotate("", head, tail, arrowprops=look, **options)


def note(axes: Axes, text: str, point: Point, offset: Point, **options: Any) -> None:
    """Write a small text beside a point, at an offset in points (1/72 inch)."""
    usual: Options = {"textcoords": "offset points", "fontsize": SMALL}
    axes.annotate(text, point, offset, **usual | options)


def aside(axes: Axes, points: float) -> Transform:
    """The transform of the data, moved to the right.

    Parameters
    ----------
    axes : Axes
        The panel.
    points : float
        Distance in points (1/72 inch).

    Returns
    -------
    Transform
        For options of matplotlib's drawing functions.
    """
    figure = axes.get_figure(root=True)
    assert figure is not None
    return axes.transData + ScaledTranslation(
        points / 72.0,
        0.0,
        figure.dpi_scale_trans,
    )


def save(
    figure: Figure,
    stem: str | os.PathLike[str],
    key: str = "",
) -> tuple[Path, Path]:
    """Write a figure as ``stem.pdf`` and ``stem.png``, then clear it.

    The same figure gives the same bytes: the files contain neither date nor program version. Each
    file is written completely or not at all; missing directories are made.

    Parameters
    ----------
    figure : Figure
        The figure.
    stem : path
        Path of the files without suffix.
    key : str
        Key of the figure's recipe (:func:`replication.pipeline.keys.key`), for the files' metadata.

    Returns
    -------
    tuple of Path
        The PDF and the PNG.
    """
    stem = Path(stem)
    pdf: Options = dict.fromkeys(("CreationDate", "ModDate", "Producer", "Creator"))
    pdf["Keywords"] = key or None
    png: Options = {"Software": None}
    if key:
        png[KEY] = key
    paths = (stem.with_name(f"{stem.name}.pdf"), stem.with_name(f"{stem.name}.png"))
    with mpl.rc_context(STYLE):
        for path, metadata in zip(paths, (pdf, png), strict=True):
            with replacing(path) as temporary:
                figure.savefig(temporary, format=path.suffix[1:], metadata=metadata)
    figure.clear()
    return paths
