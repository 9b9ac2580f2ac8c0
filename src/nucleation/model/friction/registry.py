"""Which friction laws and evolution laws there are: one file each, found by its name.

A law of the friction coefficient is a module of :mod:`nucleation.model.friction.laws` with one
class ``Law``, a :class:`~nucleation.model.friction.law.Friction`; an evolution of the state is a
module of :mod:`nucleation.model.friction.evolutions` with the three functions of
:class:`~nucleation.model.friction.evolution.StateEvolution`. The file's name is the law's name.

No module imports them by statement: what a run depends on is the laws that it uses, not all that
there are, and a new file leaves the runs of the others as they are. :func:`plugins` names them.
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


def _files(package: str) -> tuple[str, ...]:
    """The names of a package's modules."""
    return tuple(sorted(file.stem for file in Path(__file__).parent.glob(f"{package}/[!_]*.py")))


LAWS = _files("laws")
"""Laws of the friction coefficient, by name."""

EVOLUTIONS = _files("evolutions")
"""Evolution laws of the state variable, by name."""


@cache
def module(package: str, name: str) -> ModuleType:
    """The module of one law, of the package ``laws`` or ``evolutions``.

    Raises
    ------
    ParameterError
        If its file can't be loaded, naming file and line.
    """
    try:
        return importlib.import_module(f"{__package__}.{package}.{name}")
    except Exception as error:
        if isinstance(error, SyntaxError):
            place, line = error.filename, error.lineno
        else:
            frames = traceback.extract_tb(error.__traceback__)
            last = [frame for frame in frames if not frame.filename.startswith("<frozen")][-1]
            place, line = last.filename, last.lineno
        raise ParameterError(
            f"{place}, line {line}: the law {name} can't be loaded: {type(error).__name__}: "
            f"{getattr(error, 'msg', None) or error}"
        ) from error


def law_class(name: str) -> type[Checked]:
    """The class, of :class:`~nucleation.model.friction.law.Friction`, of the law with a name."""
    return module("laws", name).Law


def plugins(parameters: Any) -> tuple[str, str]:
    """The dotted names of the modules that a run finds by name, and so imports by no statement.

    A digest that follows import statements misses them: whoever digests the code of something that
    is computed from parameters adds these modules to those it begins with, as in
    ``digest("nucleation.simulation.run", *plugins(run.parameters))``.

    Parameters
    ----------
    parameters : Parameters or Friction
        All parameters of a run, or its friction alone.

    Returns
    -------
    tuple of str
        Module of the friction law, module of its state evolution.
    """
    friction = getattr(parameters, "friction", parameters)
    return f"{__package__}.laws.{friction.law}", f"{__package__}.evolutions.{friction.evolution}"


def law_declarations() -> dict[str, Quantity]:
    """The declared parameters of all friction laws, by name; the usual law's first.

    Those that not all laws have say in their description which do.

    Raises
    ------
    TypeError
        If two laws declare a parameter of the same name differently.
    """
    laws = sorted(LAWS, key=lambda name: (name != USUAL_LAW, name))
    declared = {law: declarations(law_class(law)) for law in laws}
    found: dict[str, Quantity] = {}
    for law, entries in declared.items():
        for key, entry in entries.items():
            if found.setdefault(key, entry) != entry:
                raise TypeError(f"the friction law {law} declares {key} unlike another law")
    for key, entry in found.items():
        having = [law for law in laws if key in declared[law]]
        if len(having) < len(laws):
            which = f"friction law{'s'[: len(having) > 1]} {', '.join(having)}"
            found[key] = dataclasses.replace(entry, description=f"{entry.description} ({which})")
    return found
