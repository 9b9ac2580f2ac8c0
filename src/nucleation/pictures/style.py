"""The style of all figures: sizes, fonts, colours by meaning, and reproducible files."""

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, LogLocator

from ..datasets.files import replacing

Options = dict[str, Any]
"""Keyword arguments of matplotlib's functions."""

Point = tuple[float, float]

SINGLE_COLUMN = 8.6  # cm
DOUBLE_COLUMN = 17.8  # cm

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
GUIDE = "#595959"  # lines that mark a value, and entries of legends for several sets of data
UPPER_BODY = SKY_BLUE
LOWER_BODY = ORANGE
RIGID_BODY = "#8C8C8C"

MARKERS = "osD^vP*X"
COLOURS = (VERMILLION, BLUE, BLACK, GREEN, PURPLE, ORANGE, SKY_BLUE, OLD_AGE, FULL_LAW)

SEQUENCE = "viridis"  # matplotlib's own: ordered families of curves, monotonic in lightness
SMALL = 7.5  # points: legends with many entries, panels inside panels

STYLE: dict[Any, Any] = {
    "font.family": ["STIXGeneral"],  # comes with matplotlib: the same on every machine
    "mathtext.fontset": "stix",
    "font.size": 9.0,
    "axes.labelsize": 9.0,
    "axes.titlesize": 9.0,
    "axes.titlelocation": "left",
    "axes.titlepad": 3.5,
    "legend.fontsize": 8.5,
    "legend.title_fontsize": 8.5,
    "legend.labelspacing": 0.35,
    "axes.linewidth": 0.7,
    "axes.formatter.use_mathtext": True,
    "xtick.major.pad": 4.5,
    "ytick.major.pad": 4.0,
    "axes.prop_cycle": f"cycler(color=['{GUIDE}'])",
    "lines.color": GUIDE,
    "xtick.top": True,
    "ytick.right": True,
    "lines.linewidth": 1.4,
    "lines.markersize": 4.2,
    "errorbar.capsize": 2.0,
    "legend.frameon": False,
    "legend.handlelength": 2.0,
    "legend.borderaxespad": 0.6,
    "savefig.dpi": 300.0,
    "figure.constrained_layout.w_pad": 0.03,
    "figure.constrained_layout.h_pad": 0.03,
    "pdf.fonttype": 42,  # TrueType, embedded: text stays text
}
for _ticks in ("xtick", "ytick"):
    STYLE[f"{_ticks}.labelsize"] = 8.5
    STYLE[f"{_ticks}.direction"] = "in"
    STYLE[f"{_ticks}.major.width"] = 0.7
    STYLE[f"{_ticks}.minor.width"] = 0.5
    STYLE[f"{_ticks}.minor.visible"] = True

BOXED: Options = {
    "fontsize": SMALL,
    "frameon": True,
    "framealpha": 1.0,
    "edgecolor": "0.8",
    "fancybox": False,
}
"""A legend among scattered points; without the box its marks might be taken for data."""


@contextmanager
def styled() -> Iterator[None]:
    """Within this context, or decorator, :data:`STYLE` holds over matplotlib's defaults.

    A user's own settings, of a ``matplotlibrc`` for one, have no effect, and hold again afterwards.
    """
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(STYLE)
        yield


def panels(
    height: float, width: float = DOUBLE_COLUMN, rows: int = 1, columns: int = 1, **options: Any
) -> tuple[Figure, Any]:
    """A figure of some size (cm), unknown to pyplot, and its panels as of ``Figure.subplots``."""
    figure = Figure(figsize=(width / 2.54, height / 2.54), layout="constrained")
    return figure, figure.subplots(rows, columns, **options)


def look(number: int) -> tuple[str, str]:
    """Marker and colour of one of several kinds; the first 72 differ."""
    return MARKERS[number % len(MARKERS)], COLOURS[number % len(COLOURS)]


def shades(number: int, lightest: float = 0.85) -> list[tuple[float, ...]]:
    """Colours of an ordered family, from dark to light, up to a part of the colour map."""
    colours = mpl.colormaps[SEQUENCE]
    return [colours(lightest * i / max(number - 1, 1)) for i in range(number)]


def letters(*panels: Axes) -> None:
    """Letter panels, starting with (a)."""
    for axes, letter in zip(panels, "abcdef", strict=False):
        axes.set_title(f"({letter})")


def legend(owner: Figure | Axes, *panels: Axes, **options: Any) -> None:
    """A legend of the labels in some panels, each label once."""
    found: dict[str, Artist] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            found.setdefault(label, handle)
    owner.legend(found.values(), found, **options)


def number(value: float, digits: int = 4) -> str:
    r"""A number for TeX's mathematics, where ``1e+06`` would be a difference.

    >>> number(1e6), number(2.5e-9), number(0.25)
    ('10^{6}', '2.5\\times10^{-9}', '0.25')
    """
    mantissa, _, power = f"{value:.{digits}g}".partition("e")
    if not power:
        return mantissa
    return f"{mantissa}\\times10^{{{int(power)}}}".removeprefix("1\\times")


def plain_numbers(axis: Axis, ticks: Sequence[float] = ()) -> None:
    """Label a logarithmic axis without powers of ten, at some ticks or at 1, 2 and 5."""
    axis.set_major_locator(FixedLocator(ticks) if ticks else LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter("")


def note(axes: Axes, text: str, point: Point, offset: Point, **options: Any) -> None:
    """Write a small text beside a point, at an offset in points (1/72 inch)."""
    usual: Options = {"textcoords": "offset points", "fontsize": SMALL}
    axes.annotate(text, point, offset, **usual | options)


def save_one(figure: Figure, path: Path, key: str = "") -> None:
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
    with styled(), replacing(path) as temporary:
        figure.savefig(temporary, format=path.suffix[1:], metadata=metadata)


def save(figure: Figure, stem: str | os.PathLike[str], key: str = "") -> tuple[Path, Path]:
    """Write a figure as ``stem.pdf`` and ``stem.png``, then clear it."""
    pdf, png = Path(f"{os.fspath(stem)}.pdf"), Path(f"{os.fspath(stem)}.png")
    for path in (pdf, png):
        save_one(figure, path, key)
    figure.clear()
    return pdf, png
