"""Names of parameters on axes and in legends, and the scales of axes."""

import numpy as np
from matplotlib import ticker
from matplotlib.axes import Axes

from nucleation.model.quantities import Quantity
from nucleation.types import Array

_WIDE = 4.0  # ratio of the largest to the smallest value above which an axis is logarithmic

_SYMBOLS = {
    "rho": r"\rho",
    "mu": r"\mu",
    "nu": r"\nu",
    "sigma0": r"\sigma_0",
    "tau0": r"\tau_0",
    "phi0": r"\phi_0",
    "L": r"\mathrm{block\ length}",  # L is the measured length here
    "zeta/a": r"\zeta/a",
    "zeta": r"\zeta",
    "phi*": r"\phi_*",
    "theta": r"\theta",
    "v*": "v_*",
    "v0": "v_0",
    "xi": r"\xi",
}

_WORDS = {
    "initial_state": "initial state",
    "zeta_over_a": "weakening over direct effect",
    "n_x": "elements along x",
    "n_y": "elements along y",
}
"""Names of parameters with a symbol for a name in studies."""


def named(name: str) -> str:
    """A parameter's name in words, as within a sentence."""
    words = _WORDS.get(name, name.rpartition(".")[2].replace("_", " "))
    return words[0].lower() + words[1:]


def symbol_of(entry: Quantity) -> str:
    """The TeX of a parameter's symbol; empty if it has none."""
    return _SYMBOLS.get(entry.symbol, entry.symbol)


def label_of(name: str, entry: Quantity) -> str:
    """The label of an axis."""
    words = named(name)
    symbol = symbol_of(entry)
    text = words[0].upper() + words[1:]
    if symbol:
        text += f" ${symbol}$"
    return text if entry.unit == "1" else f"{text} ({entry.unit})"


def is_logarithmic(values: Array) -> bool:
    """Whether an axis with these values is logarithmic."""
    return bool(values.size and values.min() > 0.0 and values.max() > _WIDE * values.min())


def set_scale(axes: Axes, which: str, values: Array) -> None:
    """Set the scale of an axis, with plain numbers at its ticks if it has less than two decades."""
    if not is_logarithmic(values):
        return
    axis = {"x": axes.xaxis, "y": axes.yaxis}[which]
    axes.set(**{f"{which}scale": "log"})
    if values.max() < 100.0 * values.min():
        axis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(ticker.StrMethodFormatter("{x:g}"))
        axis.set_minor_formatter(ticker.NullFormatter())


def edges(values: Array, logarithmic: bool | None = None) -> Array:
    """Edges of cells around values, between neighbours on the axis."""
    if values.size == 1:
        return np.array([0.9, 1.1]) * values
    if logarithmic is None:
        logarithmic = is_logarithmic(values)
    places = np.log(values) if logarithmic else values
    middle = 0.5 * (places[1:] + places[:-1])
    borders = np.r_[2.0 * places[0] - middle[0], middle, 2.0 * places[-1] - middle[-1]]
    return np.exp(borders) if logarithmic else borders
