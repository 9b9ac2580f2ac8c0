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
import os
import pkgutil
import traceback
from collections.abc import Collection, Iterator
from functools import cache, lru_cache
from pathlib import Path
from types import ModuleType
from typing import Any

from ..checked import Checked
from ..quantities import ParameterError, Quantity, declarations

USUAL_LAW = "product"
USUAL_EVOLUTION = "aging"


class Files(Collection[str]):
    """The names of a package's modules, read from its directories whenever they are asked for."""

    def __init__(self, package: str) -> None:
        self.package = f"{__package__}.{package}"

    def __iter__(self) -> Iterator[str]:
        states = tuple((place, os.stat(place).st_mtime_ns) for place in self._directories())
        return iter(_modules_in(states))

    def __bool__(self) -> bool:
        return True  # without reading directories

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __contains__(self, name: object) -> bool:
        return (
            isinstance(name, str)
            and name.isidentifier()
            and any(Path(place, f"{name}.py").is_file() for place in self._directories())
        )

    def _directories(self) -> list[str]:
        return list(importlib.import_module(self.package).__path__)


@lru_cache(maxsize=16)  # asked for with every run of a study
def _modules_in(directories: tuple[tuple[str, int], ...]) -> tuple[str, ...]:
    """The names of the modules in directories, each given with the time of its last change."""
    found = pkgutil.iter_modules([place for place, _ in directories])
    return tuple(sorted(module.name for module in found))


LAWS = Files("laws")
"""Laws of the friction coefficient, by name."""

EVOLUTIONS = Files("evolutions")
"""Evolution laws of the state variable, by name."""


@cache
def module(package: str, name: str) -> ModuleType:
    """The module of one law.

    Raises
    ------
    ParameterError
        If its file can't be loaded, naming file and line.
    """
    try:
        return importlib.import_module(f"{package}.{name}")
    except Exception as error:
        place, line = _origin(error)
        raise ParameterError(
            f"{place}, line {line}: the law {name} can't be loaded: {type(error).__name__}: "
            f"{getattr(error, 'msg', None) or error}"
        ) from error


def _origin(error: Exception) -> tuple[str, int | None]:
    """File and line at which a module's loading ended."""
    if isinstance(error, SyntaxError):
        return str(error.filename), error.lineno
    frames = traceback.extract_tb(error.__traceback__)
    last = [frame for frame in frames if not frame.filename.startswith("<frozen")][-1]
    return last.filename, last.lineno


def law_class(name: str) -> type[Checked]:
    """The class, of :class:`~nucleation.model.friction.law.Friction`, of the law with a name."""
    return module(LAWS.package, name).Law


def plugins(parameters: Any) -> tuple[str, ...]:
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
    return f"{LAWS.package}.{friction.law}", f"{EVOLUTIONS.package}.{friction.evolution}"


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
