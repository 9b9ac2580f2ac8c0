"""Names that other texts have for the parameters, and hints at the names that they have here."""

import difflib
from collections.abc import Collection, Iterable
from typing import NamedTuple


class Synonym(NamedTuple):
    """One quantity: its names in this project, and its names and symbols elsewhere."""

    names: tuple[str, ...]  # in the API, in commands and in configurations
    elsewhere: tuple[str, ...]  # without underscores, hyphens and capitals
    how: str = ""  # how to find its value, if it is not the same quantity


SYNONYMS = (
    Synonym(
        ("slip_distance", "characteristic_slip_distance"),
        ("d", "dc", "drs", "l", "lc", "ell", "criticalslipdistance", "stateevolutiondistance"),
    ),
    Synonym(
        ("normal_stress",),
        ("sigma", "sigma0", "sigman", "effectivenormalstress", "appliedstress", "pressure"),
    ),
    Synonym(("shear_modulus",), ("g", "mu", "rigidity", "modulusofrigidity")),
    Synonym(
        ("shear_modulus",),
        ("e", "young", "youngmodulus", "youngsmodulus", "elasticmodulus"),
        "mu = E/(2 (1 + nu))",
    ),
    Synonym(("poisson_ratio",), ("nu", "poisson", "poissonsratio")),
    Synonym(
        ("zeta", "velocity_weakening"),
        ("ab", "aminusb", "ba", "bminusa", "weakening", "ratedependence"),
        "zeta = b - a, which is positive where friction weakens",
    ),
    Synonym(("a", "direct_effect"), ("a", "directeffect")),
    Synonym(("b", "aging_coefficient"), ("b", "evolutioneffect", "agingcoefficient")),
    Synonym(
        ("friction", "friction_coefficient"),
        ("f", "f0", "mu0", "mus", "coefficientoffriction", "frictioncoefficient"),
    ),
    Synonym(("velocity",), ("v", "vp", "vpl", "v0", "platerate", "loadingrate", "sliprate")),
    Synonym(("height",), ("h", "thickness", "width", "depth")),
    Synonym(("density",), ("rho",)),
)


def hint(name: str, known: Collection[str]) -> str:
    """What to write in place of an unknown name, or nothing.

    Parameters
    ----------
    name : str
        The unknown name, with underscores or hyphens.
    known : collection of str
        The names that are allowed in its place, with underscores or hyphens.

    Returns
    -------
    str
        Such as ``did you mean slip_distance?``, or the formula by which its value follows.
    """
    plain = _plain(name)
    for synonym in SYNONYMS:
        if plain in synonym.elsewhere:
            here = _first_of(synonym.names, known)
            if here and synonym.how:
                return f"give {here}: {synonym.how}"
            if here:
                return f"did you mean {here}?"
    close = difflib.get_close_matches(name, [str(key) for key in known], n=1)
    return f"did you mean {close[0]}?" if close else ""


def _first_of(names: Iterable[str], known: Collection[str]) -> str | None:
    """The first known name that is one of some names, as it is written there."""
    written = {_plain(key): key for key in known}
    return next((written[_plain(name)] for name in names if _plain(name) in written), None)


def _plain(name: str) -> str:
    """A name without hyphens, underscores, quotes and capitals."""
    return "".join(letter for letter in name.lower() if letter.isalnum())
