"""The one style of all figures: sizes, fonts, colours by meaning, and reproducible files."""

import functools
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, ParamSpec

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.transforms import ScaledTranslation, Transform

from ..datasets.files import replacing

P = ParamSpec("P")

CENTIMETRE = 1.0 / 2.54  # inch
SINGLE_COLUMN = 8.6 * CENTIMETRE
DOUBLE_COLUMN = 17.8 * CENTIMETRE

# The colour-blind safe palette of Okabe and Ito, without the yellow that vanishes on paper.
BLACK = "#000000"
ORANGE = "#E69F00"
SKY_BLUE = "#56B4E9"
GREEN = "#009E73"
BLUE = "#0072B2"
VERMILLION = "#D55E00"
PURPLE = "#CC79A7"

# Colours by meaning. Wherever colours could be confused, shapes or dashes differ as well.
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
    STYLE |= {f"{_ticks}.labelsize": 8.5, f"{_ticks}.direction": "in"}
    STYLE |= {f"{_ticks}.major.width": 0.7, f"{_ticks}.minor.width": 0.5}

BOXED: dict[str, Any] = {
    "fontsize": SMALL,
    "frameon": True,
    "framealpha": 1.0,
    "edgecolor": "0.8",
    "fancybox": False,
    "labelspacing": 0.3,
}
"""A legend among scattered points, whose marks could be taken for data."""

OPEN: dict[str, Any] = {"markerfacecolor": "white"}

KEY = "Key"
"""Entry of a PNG that holds the key of what it was made from."""


def styled(draw: Callable[P, Figure]) -> Callable[P, Figure]:
    """Decorator: call `draw` under :data:`STYLE`, leaving matplotlib's own settings alone."""

    @functools.wraps(draw)
    def wrapper(*args: P.args, **kwargs: P.kwargs) -> Figure:
        with mpl.rc_context(STYLE):
            return draw(*args, **kwargs)

    return wrapper


def new_figure(width: float, height: float) -> Figure:
    """An empty figure of a size in inches, on the Agg canvas and unknown to pyplot."""
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def column(height: float) -> tuple[Figure, Axes]:
    """A figure one column wide with one panel; `height` in centimetres."""
    figure = new_figure(SINGLE_COLUMN, height * CENTIMETRE)
    return figure, figure.add_subplot()


def panels(rows: int, columns: int, height: float, **how: Any) -> tuple[Figure, Any]:
    """A figure two columns wide with its panels; `height` in centimetres."""
    figure = new_figure(DOUBLE_COLUMN, height * CENTIMETRE)
    return figure, figure.subplots(rows, columns, **how)


def look(number: int) -> tuple[str, str]:
    """Marker and colour of one of several kinds; none of 72 has another's."""
    return MARKERS[number % len(MARKERS)], COLOURS[number % len(COLOURS)]


def shades(number: int, lightest: float = 0.85) -> list[tuple[float, ...]]:
    """Colours of an ordered family, from dark to light."""
    return [mpl.colormaps[SEQUENCE](lightest * i / max(number - 1, 1)) for i in range(number)]


def key(label: str, marker: str = "", line: Any = "", colour: Any = GUIDE, **look: Any) -> Line2D:
    """An entry of a legend that stands for more than one set of data."""
    return Line2D([], [], marker=marker, linestyle=line, color=colour, label=label, **look)


def letters(*panels: Axes, minor: bool = False, **how: Any) -> None:
    """Letters panels, (a) first; `minor` has them minor ticks."""
    for axes, letter in zip(panels, "abcdefghijklmnopqrstuvwxyz", strict=False):
        axes.set_title(f"({letter})", loc="left", **how)
        if minor:
            axes.minorticks_on()


def entries(*panels: Axes) -> dict[str, Any]:
    """What the legend of some panels has, by label, each label once."""
    found: dict[str, Any] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            found.setdefault(label, handle)
    return found


def level(axes: Axes, y: float, line: Any = "-", width: float = 0.7, **how: Any) -> None:
    """A horizontal line that marks a value."""
    axes.axhline(y, **{"color": GUIDE, "linestyle": line, "linewidth": width} | how)


def band(axes: Axes, low: float, high: float, label: str) -> None:
    """A horizontal band within which values agree."""
    axes.axhspan(low, high, color=GUIDE, alpha=0.15, linewidth=0.0, label=label)


def arrow(
    axes: Axes, tail: Any, head: Any, colour: str = BLACK, kind: str = "-|>", **where: Any
) -> None:
    """An arrow between two points; `kind` is one of matplotlib's styles."""
    look = {"arrowstyle": f"{kind},head_length=0.35,head_width=0.17", "linewidth": 1.0}
    ends = {"color": colour, "shrinkA": 0.0, "shrinkB": 0.0}
    axes.annotate("", head, tail, arrowprops=look | ends, **where)


def aside(axes: Axes, points: float) -> Transform:
    """Where data are drawn, moved to the right by some points (1/72 inch)."""
    figure = axes.get_figure(root=True)
    assert figure is not None
    return axes.transData + ScaledTranslation(points / 72.0, 0.0, figure.dpi_scale_trans)


def save(figure: Figure, stem: str | os.PathLike[str], key: str = "") -> tuple[Path, Path]:
    """Write a figure as ``stem.pdf`` and ``stem.png``, then drop its contents.

    The same figure gives the same bytes: the files carry no date and no program version, only the
    `key` of what it was made from (:func:`nucleation.pipeline.keys.key`). Each is written under a
    temporary name beside its place and moved there whole; missing directories are made.
    """
    stem = Path(stem)
    unstated = dict.fromkeys(("CreationDate", "ModDate", "Producer", "Creator"))
    metadata: dict[str, dict[str, Any]] = {
        "pdf": unstated | {"Keywords": key or None},
        "png": {"Software": None} | ({KEY: key} if key else {}),
    }
    paths = []
    with mpl.rc_context(STYLE):
        for suffix, said in metadata.items():
            path = stem.with_name(f"{stem.name}.{suffix}")
            with replacing(path) as temporary:
                figure.savefig(temporary, format=suffix, metadata=said)
            paths.append(path)
    figure.clear()
    return paths[0], paths[1]
