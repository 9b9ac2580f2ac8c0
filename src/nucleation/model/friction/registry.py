"""The available friction laws and evolution laws: one file each, found by its name.

A law of the friction coefficient is a module of :mod:`nucleation.model.friction.laws` with one
class ``Law``, a :class:`~nucleation.model.friction.law.Friction`; an evolution of the state is a
module of :mod:`nucleation.model.friction.evolutions` with the three functions of
:class:`~nucleation.model.friction.evolution.StateEvolution`. The file's name is the law's name.

No module imports them by an import statement. So a run depends only on the laws that it uses, and
a new file does not affect the runs of other laws. :func:`plugins` gives the modules of a run.
"""

import dataclasses
import importlib
import traceback
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

from ..checked import Checked
from ..quantities import ParameterError, Quantity, declarations

USUAL_LAW = "product"
USUAL_EVOLUTION = "aging"


def _modules(package: str) -> tuple[str, ...]:
    """The names of a package's modules."""
    directory = Path(__file__).parent / package
    files = directory.glob("[!_]*.py")
    names = sorted(file.stem for file in files)
    return tuple(names)


LAWS = _modules("laws")
"""Laws of the friction coefficient, by name."""

EVOLUTIONS = _modules("evolutions")
"""Evolution laws of the state variable, by name."""


@cache
def module(
    package: str,
    name: str,
) -> ModuleType:
    """The module of one law.

    Parameters
    ----------
    package : {"laws", "evolutions"}
        The package of the law.
    name : str
        The law's name.

    Returns
    -------
    module

    Raises
    ------
    ParameterError
        If the file can't be loaded; the message names file and line.
    """
    try:
        return importlib.import_module(f"{__package__}.{package}.{name}")
    except Exception as error:
        place, line = _place(error)
        reason = getattr(error, "msg", None) or error
        raise ParameterError(
            f"{place}, line {line}: the law {name} can't be loaded: "
            f"{type(error).__name__}: {reason}"
        ) from error


def _place(error: Exception) -> tuple[str | None, int | None]:
    """File and line of an error in a law's file."""
    if isinstance(error, SyntaxError):
        return error.filename, error.lineno
    frames = traceback.extract_tb(error.__traceback__)
    while frames[-1].filename.startswith("<frozen"):
        frames.pop()
    last = frames[-1]
    return last.filename, last.lineno


def law_class(name: str) -> type[Checked]:
    """The subclass of :class:`~nucleation.model.friction.law.Friction` of a law."""
    return module("laws", name).Law


def plugins(friction: Any) -> tuple[str, str]:
    """The dotted names of the two modules that a friction law loads by name.

    A digest that follows import statements does not find them: the digest of a simulation's code
    starts from these modules too.
    """
    law = f"{__package__}.laws.{friction.law}"
    evolution = f"{__package__}.evolutions.{friction.evolution}"
    return law, evolution


def law_declarations() -> dict[str, Quantity]:
    """The declared parameters of all friction laws, by name; the default law's come first.

    The description of a parameter that only some laws have names these laws.

    Raises
    ------
    TypeError
        If two laws declare a parameter of the same name differently.
    """
    laws = [USUAL_LAW, *(law for law in LAWS if law != USUAL_LAW)]
    declared = {}
    for law in laws:
        cls = law_class(law)
        declared[law] = declarations(cls)
    found: dict[str, Quantity] = {}
    for law in laws:
        for key, entry in declared[law].items():
            first = found.setdefault(key, entry)
            if first != entry:
                raise TypeError(f"the friction law {law} declares {key} unlike another law")
    for key, entry in found.items():
        having = [law for law in laws if key in declared[law]]
        if len(having) == len(laws):
            continue
        word = "laws" if len(having) > 1 else "law"
        which = f"friction {word} {', '.join(having)}"
        found[key] = dataclasses.replace(
            entry,
            description=f"{entry.description} ({which})",
        )
    return found
