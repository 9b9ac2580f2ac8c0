"""Hints about likely mistakes: other names of a parameter, and implausible magnitudes."""

import difflib
import warnings
from collections.abc import Collection

import numpy as np
from numpy.typing import ArrayLike

from .quantities import Quantity

_ELSEWHERE = {
    "slip_distance": "d dc drs l lc ell criticalslipdistance characteristicslipdistance "
    "stateevolutiondistance",
    "normal_stress": "sigma sigma0 sigman effectivenormalstress appliedstress pressure",
    "shear_modulus": "g mu rigidity modulusofrigidity",
    "poisson_ratio": "nu poisson poissonsratio",
    "a": "a directeffect",
    "b": "b evolutioneffect agingcoefficient",
    "aging_coefficient": "b evolutioneffect agingcoefficient",
    "friction": "f f0 mu0 mus coefficientoffriction frictioncoefficient",
    "velocity": "v vp vpl v0 platerate loadingrate sliprate",
    "height": "h thickness width depth",
    "density": "rho",
    "block_length": "length l",
    "friction_law": "law",
    "heterogeneity": "varies",
    "perturbation": "kind",
    "second_far_side": "secondbottom bottom",
}
"""Names and symbols of the same quantity in the literature, in plain form."""

_CONVERTED = {
    "shear_modulus": ("e young youngmodulus youngsmodulus elasticmodulus", "mu = E/(2 (1 + nu))"),
    "zeta": (
        "ab aminusb ba bminusa weakening ratedependence",
        "zeta = b - a, which is positive where friction weakens",
    ),
}
"""Quantities of the literature from which one of ours follows, and how it does."""


def hint(name: str, known: Collection[str]) -> str:
    """A suggestion among the known names for an unknown one, or how one follows from it; or ""."""
    plain = _plain(name)
    spelling = {_plain(key): key for key in known}
    for own, (elsewhere, conversion) in _CONVERTED.items():
        if plain in elsewhere.split() and _plain(own) in spelling:
            return f"give {spelling[_plain(own)]}: {conversion}"
    for own, words in _ELSEWHERE.items():
        if plain in words.split() and _plain(own) in spelling:
            return f"did you mean {spelling[_plain(own)]}?"
    close = difflib.get_close_matches(name, [str(key) for key in known], n=1)
    return f"did you mean {close[0]}?" if close else ""


def _plain(name: str) -> str:
    """A name without hyphens, underscores, quotes and capitals."""
    return "".join(filter(str.isalnum, name.lower()))


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
"""Known magnitudes (SI units) by parameter; those of second bodies and zones are the same."""


def warn_of_implausible(name: str, value: ArrayLike, entry: Quantity) -> None:
    """Warn of the first finite value (SI units) that is outside :data:`RANGES`."""
    low, high = RANGES.get(name.removeprefix("second_").removeprefix("zone_"), (-np.inf, np.inf))
    if isinstance(value, float) and (low <= value <= high or value == np.inf):
        return  # an array takes longer
    values = np.ravel(np.asarray(value, dtype=float))
    odd = values[np.isfinite(values) & ((values < low) | (values > high))]
    if odd.size:
        unit = entry.unit_suffix
        warnings.warn(
            f"{name} = {odd[0]:g}{unit} is implausible: {entry.description} is known "
            f"between {low:g} and {high:g}{unit}; are the units right?",
            ImplausibleWarning,
            stacklevel=2,
        )
