"""Warnings about implausible magnitudes, which often are numbers in units other than SI."""

import warnings

import numpy as np
from numpy.typing import ArrayLike

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
    "density": (0.0, 3e4),
    "critical_length": (0.0, 3e4),  # the largest faults have some 20 km of crust
}
"""Known magnitudes (SI units) by parameter."""


def warn_of_implausible(name: str, value: ArrayLike, entry: Quantity) -> None:
    """Warn if finite values are outside :data:`RANGES`.

    Parameters
    ----------
    name : str
        Name of the parameter; ``second_shear_modulus`` and ``zone_shear_modulus`` have the
        range of ``shear_modulus``.
    value : float or array_like
        Values in SI units, of any shape; infinite ones are ignored.
    entry : Quantity
        The declaration.

    Warns
    -----
    ImplausibleWarning
        With the first implausible value.
    """
    known = RANGES.get(name.removeprefix("second_").removeprefix("zone_"))
    if known is None:
        return
    low, high = known
    values = np.ravel(np.asarray(value, dtype=float))
    outside = (values < low) | (values > high)
    odd = values[np.isfinite(values) & outside]
    if odd.size:
        unit = entry.unit_suffix
        warnings.warn(
            f"{name} = {odd[0]:g}{unit} is implausible: {entry.description} is known "
            f"between {low:g} and {high:g}{unit}; are the units right?",
            ImplausibleWarning,
            stacklevel=2,
        )
