"""The style of all figures: sizes, fonts, colours by meaning, and reproducible files."""

import functools
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, ParamSpec

import matplotlib as mpl
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

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
STABILITY = GREEN  # L_s, the length at which the creeping patch turns unstable
AGING = VERMILLION
SLIP = BLACK
OLD_AGE = "#6B3E12"  # the paper's brown, dark enough to differ from AGING in grey
FULL_LAW = "#8E4585"  # the palette's purple, darkened for thin lines
GUIDE = "#595959"  # lines that mark a value
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


@contextmanager
def applied() -> Iterator[None]:
    """Within this context :data:`STYLE` holds over matplotlib's defaults.

    A user's own settings, of a ``matplotlibrc`` for one, have no effect, and hold again afterwards.
    """
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(STYLE)
        yield


def styled(draw: Callable[P, Figure]) -> Callable[P, Figure]:
    """Decorator: call `draw` in the style of the project."""

    @functools.wraps(draw)
    def wrapper(*args: P.args, **kwargs: P.kwargs) -> Figure:
        with applied():
            return draw(*args, **kwargs)

    return wrapper


def new_figure(height: float, width: float = DOUBLE_COLUMN) -> Figure:
    """A figure without panels, unknown to pyplot; `height` in centimetres, `width` in inches."""
    figure = Figure(figsize=(width, height * CENTIMETRE), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def panels(rows: int, columns: int, height: float, **options: Any) -> tuple[Figure, Any]:
    """A figure of two columns' width and its panels, with options of ``Figure.subplots``."""
    figure = new_figure(height)
    return figure, figure.subplots(rows, columns, **options)


def column(height: float) -> tuple[Figure, Axes]:
    """A figure of one column's width with one panel."""
    figure = new_figure(height, SINGLE_COLUMN)
    return figure, figure.add_subplot()


def look(number: int) -> tuple[str, str]:
    """Marker and colour of one of several kinds; the first 72 differ."""
    return MARKERS[number % len(MARKERS)], COLOURS[number % len(COLOURS)]


def shades(number: int, lightest: float = 0.85) -> list[tuple[float, ...]]:
    """Colours of an ordered family, from dark to light, up to a part of the colour map."""
    colours = mpl.colormaps[SEQUENCE]
    return [colours(lightest * i / max(number - 1, 1)) for i in range(number)]


def key(
    label: str, marker: str = "", line: Any = "", colour: Any = GUIDE, **options: Any
) -> Line2D:
    """An entry of a legend for several sets of data."""
    return Line2D(
        [],
        [],
        marker=marker,
        linestyle=line,
        color=colour,
        label=label,
        **options,
    )


def letters(*panels: Axes, minor: bool = False, **options: Any) -> None:
    """Letter panels, starting with (a), with minor ticks if wanted."""
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
    """Draw a horizontal line that marks a value."""
    usual = {"color": GUIDE, "linestyle": line, "linewidth": width}
    axes.axhline(y, **usual | options)


def vertical(axes: Axes, x: float, line: Any = "--", width: float = 0.9, **options: Any) -> None:
    """Draw a vertical line that marks a value."""
    usual = {"color": GUIDE, "linestyle": line, "linewidth": width}
    axes.axvline(x, **usual | options)


def band(
    axes: Axes,
    low: float,
    high: float,
    label: str,
) -> None:
    """Draw a horizontal band of agreement."""
    axes.axhspan(
        low,
        high,
        color=GUIDE,
        alpha=0.15,
        linewidth=0.0,
        label=label,
    )


def arrow(
    axes: Axes, tail: Point, head: Point, colour: str = BLACK, kind: str = "-|>", **options: Any
) -> None:
    """Draw an arrow between two points."""
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


def write(figure: Figure, path: Path, key: str = "") -> None:
    """Write a figure as PDF or PNG by the name of `path`, completely or not at all.

    The same figure gives the same bytes: there is neither date nor version of a program in them.
    `key`, of a recipe of the workflow, is kept in the file's metadata.
    """
    metadata: Options = {"Software": None}
    entry = "Key"
    if path.suffix == ".pdf":
        metadata = dict.fromkeys(("CreationDate", "ModDate", "Producer", "Creator"))
        entry = "Keywords"
    if key:
        metadata[entry] = key
    with applied(), replacing(path) as temporary:
        figure.savefig(temporary, format=path.suffix[1:], metadata=metadata)


def save(figure: Figure, stem: str | os.PathLike[str], key: str = "") -> tuple[Path, Path]:
    """Write a figure as ``stem.pdf`` and ``stem.png``, then clear it."""
    pdf, png = Path(f"{os.fspath(stem)}.pdf"), Path(f"{os.fspath(stem)}.png")
    for path in (pdf, png):
        write(figure, path, key)
    figure.clear()
    return pdf, png
