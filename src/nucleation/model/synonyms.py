"""Suggestions for unknown names of parameters, also for names in the literature."""

import difflib
from collections.abc import Collection

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
    "shear_modulus": (
        "e young youngmodulus youngsmodulus elasticmodulus",
        "mu = E/(2 (1 + nu))",
    ),
    "zeta": (
        "ab aminusb ba bminusa weakening ratedependence",
        "zeta = b - a, which is positive where friction weakens",
    ),
}
"""Quantities of the literature from which one of ours follows, and how it does."""


def hint(name: str, known: Collection[str]) -> str:
    """A suggestion for an unknown name.

    Parameters
    ----------
    name : str
        The unknown name, with underscores or hyphens.
    known : collection of str
        The allowed names, with underscores or hyphens.

    Returns
    -------
    str
        Such as ``did you mean slip_distance?``, or the conversion to an allowed parameter; empty
        if no allowed name is similar.
    """
    plain = _plain(name)
    spelling = {_plain(key): key for key in known}
    for own, (elsewhere, conversion) in _CONVERTED.items():
        if plain in elsewhere.split() and _plain(own) in spelling:
            return f"give {spelling[_plain(own)]}: {conversion}"
    for own, elsewhere in _ELSEWHERE.items():
        if plain in elsewhere.split() and _plain(own) in spelling:
            return f"did you mean {spelling[_plain(own)]}?"
    words = [str(key) for key in known]
    close = difflib.get_close_matches(name, words, n=1)
    return f"did you mean {close[0]}?" if close else ""


def _plain(name: str) -> str:
    """A name without hyphens, underscores, quotes and capitals."""
    letters = [letter for letter in name.lower() if letter.isalnum()]
    return "".join(letters)
