"""Magnitudes that are rarely meant: numbers in other units than SI units, most of the time."""

import warnings
from typing import Any

import numpy as np

from .quantities import Quantity


class ImplausibleWarning(UserWarning):
    """A parameter has a magnitude that no known fault or laboratory experiment has."""


RANGES = {
    "shear_modulus": (1e2, 1e12),  # gels to diamond
    "normal_stress": (1e2, 1e10),  # a block of two centimetres to the lower mantle
    "slip_distance": (1e-10, 3.0),  # an atom to the largest inferred for earthquakes
    "velocity": (1e-15, 1e2),
    "height": (1e-8, 3e6),
    "a": (1e-7, 0.3),
    "b": (-0.3, 0.3),
    "zeta": (-0.3, 0.3),
    "friction": (0.0, 5.0),
    "density": (1.0, 3e4),
}
"""Magnitudes that occur, in SI units, by the name of the parameter."""


def warn_of_implausible(name: str, value: Any, entry: Quantity) -> None:
    """Warn, with :class:`ImplausibleWarning`, of a value that is out of :data:`RANGES`.

    Parameters
    ----------
    name : str
        Of the parameter; ``second_shear_modulus`` has the range of ``shear_modulus``.
    value : float or array_like
        In SI units; infinite values are not looked at.
    entry : Quantity
        Its declaration.
    """
    bounds = RANGES.get(name.removeprefix("second_"))
    if bounds is None:
        return
    flat = np.ravel(np.asarray(value, dtype=float))
    odd = flat[np.isfinite(flat) & ((flat < bounds[0]) | (flat > bounds[1]))]
    if odd.size:
        unit = "" if entry.unit == "1" else f" {entry.unit}"
        warnings.warn(
            f"{name} = {odd[0]:g}{unit} is hardly what is meant: {entry.description} is known "
            f"between {bounds[0]:g} and {bounds[1]:g}{unit}; are the units right?",
            ImplausibleWarning,
            stacklevel=2,
        )
