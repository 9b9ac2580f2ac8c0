"""Recipes: everything a job needs to know to make a result.

A rule names the function that makes its result (``call``), the modules that this function loads by
name (``loads``), its other arguments, and its sources. The recipe collects these; its digest is the
key. It is stored as JSON, so that a job on any machine makes the result that was planned.
"""

import json
import re
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from . import code
from .entries import STEM
from .keys import PATTERN, as_json, key, key_of_file
from .store import Store

_MANIFEST = re.compile(rf'\{{("[^"]+": "{PATTERN}"(, )?)*\}}\n')

Sources = dict[str, str | list[str]]
"""Paths of the sources, by the function's argument: files in the store, or other files."""


class PartFailed(Exception):
    """A part of a batch has failed; the other parts are made."""


class _Ingredients(NamedTuple):
    name: str  # of the result, below the directory of results, without suffix: figures/figure_3
    files: list[str]  # outputs of the rule, which people open
    results: str  # the directory of results
    call: str  # the function that makes it, MODULE:NAME; empty for a batch without a table
    loads: list[str]  # modules that this function loads by name
    values: dict[str, Any]  # its other arguments
    sources: Sources
    parts: "list[Recipe]"  # recipes of a batch


class Recipe(_Ingredients):
    """How a result is made, and the key that follows from it."""

    @cached_property
    def key(self) -> str:
        """The key of the result; a recipe that was read from a file has its planned key."""
        return self.key_now()

    def key_now(self) -> str:
        """Digest of the present code, the arguments and the present keys of the sources."""
        if not self.call:
            return key("", {}, {"parts": [part.key for part in self.parts]})
        function = self.call.partition(":")[2]
        return key(self.code, {"": function, **self.values}, self.source_keys)

    @property
    def source_keys(self) -> dict[str, list[str]]:
        """Keys of the sources, by the function's argument."""
        found = {}
        for role, paths in self.sources.items():
            found[role] = [key_of_file(path) for path in listed(paths)]
        return found

    @property
    def roots(self) -> tuple[str, ...]:
        """The modules that its code begins with."""
        if not self.call:
            return ()
        return (self.call.partition(":")[0], *code.ALWAYS, *self.loads)

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
        """The recipes of the results that must be in the store: for a batch its parts."""
        return [self] if self.call else self.parts

    def stored(self, file: str) -> str:
        """The path in the store of one of the result's files."""
        suffix = file.removeprefix(f"{self.results}/{self.name}")
        return f"{self.results}/store/{self.key}/{STEM}{suffix}"

    def manifest(self) -> str:
        """The text in the file of a batch: the keys of its parts, by their names."""
        return as_json({part.name: part.key for part in self.parts}) + "\n"

    def text(self, planned: str = "") -> str:
        """The recipe as JSON, the key first.

        Parameters
        ----------
        planned : str
            Distinguishes two files of the same recipe.

        Returns
        -------
        str
            The text.
        """
        values = {"key": self.key, "planned": planned, **self._plain()}
        return as_json(values, sort_keys=False)

    def _plain(self) -> dict[str, Any]:
        parts = [{"key": part.key, **part._plain()} for part in self.parts]
        return self._asdict() | {"parts": parts}


def is_manifest(text: str | None) -> bool:
    """Whether a text has the form of :meth:`Recipe.manifest`."""
    return text is not None and re.fullmatch(_MANIFEST, text) is not None


def listed(paths: str | Iterable[object]) -> list[str]:
    """One path, or several, as a list of plain texts."""
    if isinstance(paths, str):
        return [str(paths)]
    return [str(path) for path in paths]


def read(path: str | Path) -> Recipe:
    """Read a recipe; it and its parts have the keys with which they were planned."""
    return _from_plain(json.loads(Path(path).read_text("utf-8")))


def _from_plain(values: Mapping[str, Any]) -> Recipe:
    given = {name: values[name] for name in Recipe._fields}
    given["parts"] = [_from_plain(part) for part in values["parts"]]
    recipe = Recipe(**given)
    vars(recipe)["key"] = values["key"]
    return recipe
