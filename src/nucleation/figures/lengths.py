"""Picture of nucleation lengths over one or two parameters of a fault."""

import math
import textwrap

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import Normal, Stroke
from matplotlib.ticker import FuncFormatter
from numpy.typing import NDArray

from ..model.quantities import ParameterError
from . import style

LOOKS = {
    "critical_length": (
        "$L_c$, homogeneous sliding",
        style.BLUE,
        "-",
        "",
    ),
    "stability_length": (
        "$L_s$, creeping patch",
        style.GREEN,
        "--",
        "",
    ),
    "expected_length": ("$L$, the force drops", style.VERMILLION, ":", "o"),
}
"""Label, colour, dashes and marker of each length; dashes differ for colour-blind readers."""

WIDE = 10.0  # ratio of the values above which an axis is logarithmic
SHORT = 100.0  # ratio up to which minor ticks of a logarithmic axis have labels
MISSING = "0.88"  # grey of points without a length


@style.styled
def draw(found: xr.Dataset, specimen: float | None = None, band: str = "") -> Figure:
    """Draw lengths over one parameter as lines, or one length over two as a map.

    Parameters
    ----------
    found : Dataset
        From :func:`nucleation.patch.lengths_over.lengths_over`.
    specimen : float, optional
        Length of a specimen (m). It is drawn as a horizontal line, or as a contour.
    band : str
        Meaning of the bands around lines, for the legend; empty without bands.

    Returns
    -------
    Figure
        One panel.

    Raises
    ------
    ParameterError
        If there is no length at any point.
    """
    middle = found["length"].sel(end="middle")
    if not np.isfinite(middle).any():
        raise ParameterError("there is no length to draw at any point")
    over = [str(name) for name in middle.dims if name != "key"]
    if len(over) == 1:
        return _lines(found, over[0], specimen, band)
    return _map(found, over, specimen)


def _lines(found: xr.Dataset, over: str, specimen: float | None, band: str) -> Figure:
    figure, axes = style.column(8.0)
    x = found[over].values
    handles: list[Line2D | Patch] = []
    for key in found["key"].values.tolist():
        label, colour, dashes, marker = LOOKS[key]
        low, middle, high = _finite(found["length"].sel(key=key).transpose("end", over).values)
        axes.plot(x, middle, color=colour, linestyle=dashes)
        if marker:
            doubtful = found["doubtful"].values > 0.0
            axes.plot(x[~doubtful], middle[~doubtful], marker, color=colour)
            axes.plot(
                x[doubtful],
                middle[doubtful],
                marker,
                color=colour,
                **style.OPEN,
            )
        if np.nanmax(high / low, initial=1.0) > 1.0:
            axes.fill_between(x, low, high, color=colour, alpha=0.2, linewidth=0.0)
        handles.append(style.key(label, marker, dashes, colour))
        if marker and doubtful.any():
            handles.append(
                style.key(
                    "not to be relied upon",
                    marker,
                    "",
                    colour,
                    **style.OPEN,
                )
            )
    if band:
        handles.append(Patch(color=style.GUIDE, alpha=0.3, linewidth=0.0, label=band))
    if specimen is not None:
        axes.axhline(specimen, color=style.BLACK, linewidth=0.9)
        handles.append(
            style.key(
                f"specimen, {specimen:.3g} m",
                "",
                "-",
                style.BLACK,
                linewidth=0.9,
            )
        )
    _scale(axes, "x", x)
    _scale(
        axes,
        "y",
        np.concatenate([line.get_ydata() for line in axes.get_lines()]),
    )
    axes.set_xlabel(_label(found, over))
    axes.set_ylabel("Length (m)")
    figure.legend(
        handles=handles,
        loc="outside upper left",
        ncols=2,
        fontsize=style.SMALL,
    )
    return figure


def _map(found: xr.Dataset, over: list[str], specimen: float | None) -> Figure:
    figure, axes = style.column(8.0)
    (key,) = found["key"].values.tolist()
    label, *_ = LOOKS[key]
    ends = found["length"].sel(key=key).transpose("end", over[1], over[0]).values
    low, middle, high = _finite(ends)
    x, y = (found[name].values for name in over)
    axes.set_facecolor(MISSING)
    known = middle[np.isfinite(middle)]
    wide = known.max() >= WIDE * known.min()
    norm = LogNorm() if wide else None
    image = axes.pcolormesh(_edges(x), _edges(y), middle, norm=norm, rasterized=True)
    bar = figure.colorbar(image, ax=axes, label=f"{label} (m)")
    if wide:
        _plain_numbers(bar.ax.yaxis, known)
    handles: list[Line2D | Patch] = []
    if specimen is not None:
        handles += _specimen_lines(axes, x, y, (low, middle, high), specimen)
    if not np.isfinite(middle).all():
        handles.append(Patch(color=MISSING, label="no length"))
    _scale(axes, "x", x)
    _scale(axes, "y", y)
    axes.set_xlabel(_label(found, over[0]))
    axes.set_ylabel(_label(found, over[1]))
    if handles:
        figure.legend(
            handles=handles,
            loc="outside upper left",
            ncols=2,
            fontsize=style.SMALL,
        )
    return figure


def _specimen_lines(
    axes: Axes,
    x: NDArray,
    y: NDArray,
    ends: tuple[NDArray, ...],
    specimen: float,
) -> list[Line2D]:
    """Contours at the specimen's length: of the middle, and of ends that differ from it."""
    low, middle, high = ends
    handles = []
    drawn = [(middle, "-", f"specimen, {specimen:.3g} m")]
    if np.nanmax(high / low, initial=1.0) > 1.0:
        drawn += [
            (low, "--", "at 5 and 95 % of the draws"),
            (high, "--", ""),
        ]
    edge = [
        Stroke(linewidth=2.6, foreground=style.BLACK),
        Normal(),
    ]  # visible on any colour
    for values, dashes, label in drawn:
        known = values[np.isfinite(values)]
        if known.size and known.min() < specimen < known.max():
            lines = axes.contour(
                x,
                y,
                values,
                [specimen],
                colors="white",
                linestyles=dashes,
            )
            lines.set_path_effects(edge)
        if label:
            handles.append(style.key(label, "", dashes, "white", path_effects=edge))
    return handles


def _edges(values: NDArray) -> NDArray:
    """The edges of cells around values that are evenly spaced, or whose logarithms are."""
    ratio = values[0] > 0.0 and values[-1] >= WIDE * values[0]
    even = np.log(values) if ratio else values
    half = 0.5 * (even[1] - even[0])
    edges = np.append(even - half, even[-1] + half)
    return np.exp(edges) if ratio else edges


def _finite(values: NDArray) -> NDArray:
    """The values with NaN for infinite ones, which can't be drawn."""
    return np.where(np.isfinite(values), values, np.nan)


def _scale(axes: Axes, direction: str, values: NDArray) -> None:
    """Set a logarithmic scale if positive values differ by a large factor."""
    known = np.asarray(values, dtype=float)
    known = known[np.isfinite(known)]
    if known.min() > 0.0 and known.max() >= WIDE * known.min():
        axes.set(**{f"{direction}scale": "log"})
        _plain_numbers(axes.xaxis if direction == "x" else axes.yaxis, known)


def _plain_numbers(axis: Axis, known: NDArray) -> None:
    """Labels of a logarithmic axis without powers of ten."""
    is_short = known.max() < SHORT * known.min()
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(FuncFormatter(lambda value, _: _minor(value) if is_short else ""))


def _minor(value: float) -> str:
    """The label of a minor tick of a short logarithmic scale: only 2 and 5 have one."""
    digit = round(value / 10.0 ** math.floor(math.log10(value)))
    return f"{value:g}" if digit in (2, 5) else ""


def _label(found: xr.Dataset, name: str) -> str:
    attributes = found[name].attrs
    units = attributes["units"]
    text = attributes["long_name"]
    text = text if len(text) == 1 else text[0].upper() + text[1:]
    text = text if units == "1" else f"{text} ({units})"
    return textwrap.fill(text, 36)
