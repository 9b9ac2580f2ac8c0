"""Recipes: all that a job has to know to make a result.

A rule says which function makes its result (``call``), what code this function loads by name
(``loads``), its other parameters, and what it reads. The recipe puts these together, and its key is
their digest. It is kept as JSON, so that a job makes what was planned, on whatever machine.
"""

import json
import re
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from . import code
from .store import PATTERN, STEM, Store, key, of_file, plain

MANIFEST = re.compile(rf'\{{("[^"]+": "{PATTERN}"(, )?)*\}}\n')

Sources = dict[str, str | list[str]]
"""What is read, by the names of a function's arguments: files in the store, or of others."""


class PartFailed(Exception):
    """A part of a batch that came to no result; the others go on."""


class _Ingredients(NamedTuple):
    name: str  # of the result in the directory of results, without a suffix: figures/figure_3
    files: list[str]  # the outputs of its rule, where people find it
    results: str  # the directory of results
    call: str  # the function that makes it, MODULE:NAME; empty of a batch, which is its parts
    loads: list[str]  # modules that this function loads by name
    values: dict[str, Any]  # its other arguments
    sources: Sources
    parts: "list[Recipe]"  # of a batch: the recipes of what its job makes


class Recipe(_Ingredients):
    """How a result is made, and the key that follows from it."""

    @cached_property
    def key(self) -> str:
        """The key of the result; of a recipe that was read the one that was planned."""
        return self.key_now()

    def key_now(self) -> str:
        """A digest of its code, its arguments and its sources' keys, as they are now."""
        if not self.call:
            return key("", {}, {"parts": [part.key for part in self.parts]})
        function = self.call.partition(":")[2]
        return key(self.code, {"": function, **self.values}, self.source_keys)

    @property
    def source_keys(self) -> dict[str, list[str]]:
        """Keys of what it is made from, by their role."""
        return {role: [*map(of_file, listed(paths))] for role, paths in self.sources.items()}

    @property
    def roots(self) -> tuple[str, ...]:
        """The modules that its code begins with."""
        return (self.call.partition(":")[0], *code.ALWAYS, *self.loads) if self.call else ()

    @property
    def code(self) -> str:
        """Digest of its code."""
        return code.digest(*self.roots)

    @property
    def store(self) -> Store:
        """The store of the directory of results."""
        return Store(f"{self.results}/store")

    @property
    def needed(self) -> "list[Recipe]":
        """The recipes of the results that a store must have: of a batch those of its parts."""
        return [self] if self.call else self.parts

    def stored(self, file: str) -> str:
        """Where the store has one of the result's files."""
        suffix = file.removeprefix(f"{self.results}/{self.name}")
        return f"{self.results}/store/{self.key}/{STEM}{suffix}"

    def manifest(self) -> str:
        """The text that the file of a batch has: the keys of its parts, by their names."""
        return plain({part.name: part.key for part in self.parts}) + "\n"

    def text(self, planned: str = "") -> str:
        """All of it as JSON, the key first; `planned` tells files of one recipe apart."""
        return plain({"key": self.key, "planned": planned, **self._plain()}, sort_keys=False)

    def _plain(self) -> dict[str, Any]:
        parts = [{"key": part.key, **part._plain()} for part in self.parts]
        return self._asdict() | {"parts": parts}


def is_manifest(text: str | None) -> bool:
    """Whether a text is that of :meth:`Recipe.manifest`, of whatever batch."""
    return text is not None and re.fullmatch(MANIFEST, text) is not None


def listed(paths: Any) -> list[str]:
    """One path, or several, as a list of plain texts."""
    return [str(paths)] if isinstance(paths, str) else [str(path) for path in paths]


def read(path: str | Path) -> Recipe:
    """The recipe in a file; it and its parts have the keys with which they were planned."""
    return _made(json.loads(Path(path).read_text("utf-8")))


def _made(values: Mapping[str, Any]) -> Recipe:
    given = {name: values[name] for name in Recipe._fields}
    recipe = Recipe(**given | {"parts": [*map(_made, values["parts"])]})
    vars(recipe)["key"] = values["key"]
    return recipe
