"""Suggestions for unknown names of parameters, also for names in the literature."""

import difflib
from collections.abc import Collection, Iterable
from typing import NamedTuple


class _Synonym(NamedTuple):
    """The names of one quantity in this project and elsewhere."""

    names: tuple[str, ...]  # in the API, in commands and in configurations
    elsewhere: tuple[str, ...]  # names and symbols in plain form
    conversion: str = ""  # how the value follows, if the quantities differ


_SYNONYMS = (
    _Synonym(
        names=("slip_distance",),
        elsewhere=(
            *("d", "dc", "drs", "l", "lc", "ell"),
            *("criticalslipdistance", "characteristicslipdistance"),
            "stateevolutiondistance",
        ),
    ),
    _Synonym(
        names=("normal_stress",),
        elsewhere=(
            *("sigma", "sigma0", "sigman"),
            *("effectivenormalstress", "appliedstress", "pressure"),
        ),
    ),
    _Synonym(
        names=("shear_modulus",),
        elsewhere=("g", "mu", "rigidity", "modulusofrigidity"),
    ),
    _Synonym(
        names=("shear_modulus",),
        elsewhere=("e", "young", "youngmodulus", "youngsmodulus", "elasticmodulus"),
        conversion="mu = E/(2 (1 + nu))",
    ),
    _Synonym(
        names=("poisson_ratio",),
        elsewhere=("nu", "poisson", "poissonsratio"),
    ),
    _Synonym(
        names=("zeta",),
        elsewhere=("ab", "aminusb", "ba", "bminusa", "weakening", "ratedependence"),
        conversion="zeta = b - a, which is positive where friction weakens",
    ),
    _Synonym(
        names=("a",),
        elsewhere=("a", "directeffect"),
    ),
    _Synonym(
        names=("b", "aging_coefficient"),
        elsewhere=("b", "evolutioneffect", "agingcoefficient"),
    ),
    _Synonym(
        names=("friction",),
        elsewhere=(
            *("f", "f0", "mu0", "mus"),
            *("coefficientoffriction", "frictioncoefficient"),
        ),
    ),
    _Synonym(
        names=("velocity",),
        elsewhere=("v", "vp", "vpl", "v0", "platerate", "loadingrate", "sliprate"),
    ),
    _Synonym(
        names=("height",),
        elsewhere=("h", "thickness", "width", "depth"),
    ),
    _Synonym(
        names=("density",),
        elsewhere=("rho",),
    ),
)


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
    for synonym in _SYNONYMS:
        if plain not in synonym.elsewhere:
            continue
        here = _first_known(synonym.names, known)
        if here and synonym.conversion:
            return f"give {here}: {synonym.conversion}"
        if here:
            return f"did you mean {here}?"
    words = [str(key) for key in known]
    close = difflib.get_close_matches(name, words, n=1)
    return f"did you mean {close[0]}?" if close else ""


def _first_known(names: Iterable[str], known: Collection[str]) -> str | None:
    """The first of some names that is known, in the spelling of the known one."""
    spelling = {_plain(key): key for key in known}
    for name in names:
        plain = _plain(name)
        if plain in spelling:
            return spelling[plain]
    return None


def _plain(name: str) -> str:
    """A name without hyphens, underscores, quotes and capitals."""
    letters = [letter for letter in name.lower() if letter.isalnum()]
    return "".join(letters)
