"""Picture of nucleation lengths over one or two parameters of a fault."""

import textwrap

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import Normal, Stroke
from matplotlib.ticker import FuncFormatter

from nucleation.model.quantities import ParameterError
from nucleation.pictures import style
from nucleation.types import Array

from .beyond.parameter_axes import edges

LOOKS = {
    "critical_length": ("$L_c$, homogeneous sliding", style.BLUE, "-", ""),
    "stability_length": ("$L_s$, creeping patch", style.GREEN, "--", ""),
    "expected_length": ("$L$, the force drops", style.VERMILLION, ":", "o"),
}
"""Label, colour, dashes and marker of each length; dashes differ for colour-blind readers."""

WIDE = 10.0  # ratio of the values above which an axis is logarithmic
SHORT = 100.0  # ratio up to which minor ticks of a logarithmic axis have labels
MISSING = "0.88"  # grey of points without a length


@style.styled
def draw(
    found: xr.Dataset,
    specimen: float | None = None,
    band: str = "",
) -> Figure:
    """Draw lengths over one parameter as lines, or one length over two as a map.

    Parameters
    ----------
    found : Dataset
        From :func:`replication.figures.lengths_over.lengths_over`.
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
    found = found.assign(length=found["length"].where(np.isfinite(found["length"])))
    figure, axes = style.column(8.0)
    if len(over) == 1:
        handles = _draw_lines(axes, found, *over)
        if band:
            handles.append(
                Patch(
                    color=style.GUIDE,
                    alpha=0.3,
                    linewidth=0.0,
                    label=band,
                )
            )
        if specimen is not None:
            axes.axhline(specimen, color=style.BLACK, linewidth=0.9)
            label = f"specimen, {specimen:.3g} m"
            handles.append(style.key(label, "", "-", style.BLACK, linewidth=0.9))
        _set_scale(
            axes,
            "y",
            np.concatenate([line.get_ydata() for line in axes.get_lines()]),
        )
        axes.set_ylabel("Length (m)")
    else:
        handles = _draw_map(axes, found, over, specimen)
        _set_scale(axes, "y", found[over[1]].values)
        axes.set_ylabel(_label(found[over[1]]))
    _set_scale(axes, "x", found[over[0]].values)
    axes.set_xlabel(_label(found[over[0]]))
    if handles:
        figure.legend(
            handles=handles,
            loc="outside upper left",
            ncols=2,
            fontsize=style.SMALL,
        )
    return figure


def _draw_lines(
    axes: Axes,
    found: xr.Dataset,
    over: str,
) -> list[Artist]:
    """The lengths over one parameter, with bands to their ends; open marks are doubtful."""
    x = found[over].values
    doubtful = found["doubtful"].values > 0.0
    handles: list[Artist] = []
    for key in found["key"].values.tolist():
        label, colour, dashes, marker = LOOKS[key]
        low, middle, high = found["length"].sel(key=key).transpose("end", over).values
        axes.plot(x, middle, color=colour, linestyle=dashes)
        handles.append(style.key(label, marker, dashes, colour))
        if np.nanmax(high / low, initial=1.0) > 1.0:
            axes.fill_between(x, low, high, color=colour, alpha=0.2, linewidth=0.0)
        if marker:
            axes.plot(x[~doubtful], middle[~doubtful], marker, color=colour)
            axes.plot(x[doubtful], middle[doubtful], marker, color=colour, **style.OPEN)
        if marker and doubtful.any():
            handles.append(style.key("not to be relied upon", marker, "", colour, **style.OPEN))
    return handles


def _draw_map(
    axes: Axes, found: xr.Dataset, over: list[str], specimen: float | None
) -> list[Artist]:
    """One length over two parameters, with contours at the specimen's length."""
    (key,) = found["key"].values.tolist()
    label, *_ = LOOKS[key]
    ends = found["length"].sel(key=key).transpose("end", over[1], over[0]).values
    middle = ends[1]
    known = middle[np.isfinite(middle)]
    x, y = (found[name].values for name in over)
    borders = (edges(values, _is_wide(values)) for values in (x, y))
    norm = "log" if _is_wide(known) else None
    axes.set_facecolor(MISSING)
    image = axes.pcolormesh(*borders, middle, norm=norm, rasterized=True)
    bar = axes.figure.colorbar(image, ax=axes, label=f"{label} (m)")
    if norm:
        _plain_numbers(bar.ax.yaxis, known)
    handles: list[Artist] = []
    if specimen is not None:
        handles += _specimen_lines(axes, x, y, ends, specimen)
    if known.size < middle.size:
        handles.append(Patch(color=MISSING, label="no length"))
    return handles


def _specimen_lines(
    axes: Axes,
    x: Array,
    y: Array,
    ends: Array,
    specimen: float,
) -> list[Line2D]:
    """Contours at the specimen's length: of the middle, and of ends that differ from it."""
    low, middle, high = ends
    drawn = [(middle, "-", f"specimen, {specimen:.3g} m")]
    if np.nanmax(high / low, initial=1.0) > 1.0:
        drawn += [(low, "--", "at 5 and 95 % of the draws"), (high, "--", "")]
    edge = [Stroke(linewidth=2.6, foreground=style.BLACK), Normal()]  # visible on any colour
    handles = []
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


def _is_wide(values: Array) -> bool:
    """Whether an axis with these values is logarithmic."""
    return bool(values.min() > 0.0 and values.max() >= WIDE * values.min())


def _set_scale(
    axes: Axes,
    direction: str,
    values: Array,
) -> None:
    """Set a logarithmic scale if positive values differ by a large factor."""
    known = values[np.isfinite(values)]
    if _is_wide(known):
        axes.set(**{f"{direction}scale": "log"})
        _plain_numbers(axes.xaxis if direction == "x" else axes.yaxis, known)


def _plain_numbers(axis: Axis, known: Array) -> None:
    """Labels of a logarithmic axis without powers of ten; if it is short also of 2 and 5."""
    axis.set_major_formatter("{x:g}")
    is_short = known.max() < SHORT * known.min()
    axis.set_minor_formatter(FuncFormatter(lambda value, _: _minor(value) if is_short else ""))


def _minor(value: float) -> str:
    """The label of a minor tick of a short logarithmic scale: only 2 and 5 have one."""
    return f"{value:g}" if f"{value:.0e}"[0] in "25" else ""


def _label(values: xr.DataArray) -> str:
    """Name and unit of a parameter."""
    text = values.attrs["long_name"]
    text = text if len(text) == 1 else text[0].upper() + text[1:]
    units = values.attrs["units"]
    return textwrap.fill(text if units == "1" else f"{text} ({units})", 36)
