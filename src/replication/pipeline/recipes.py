"""Recipes: everything a job needs to know to make a result.

A rule names the function that makes its result (``call``), the modules that this function loads by
name (``loads``), its other arguments, and its sources. The recipe collects these; its digest is the
key. It is stored as JSON, so that a job on any machine makes the result that was planned.
"""

import dataclasses
import hashlib
import json
import os
import re
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from nucleation.datasets import code

from .store import PATTERN, STEM, Store, digest_of_file

_IN_STORE = re.compile(rf"/({PATTERN})/[^/]+$")
_MANIFEST = re.compile(rf'\{{("[^"]+": "{PATTERN}"(, )?)*\}}\n')

Sources = dict[str, str | list[str]]
"""Paths of the sources, by the function's argument: files in the store, or other files."""


def as_json(values: Any) -> str:
    """Values as JSON, equal values as equal text; TypeError if one has no such form."""
    return json.dumps(values, sort_keys=True, default=_converted)


def _converted(value: Any) -> Any:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return dataclasses.asdict(value)
    if hasattr(value, "items"):
        return dict(value.items())
    if hasattr(value, "tolist"):  # NumPy
        return value.tolist()
    raise TypeError(f"{value!r} can't be part of a key")


def key_in(path: str | Path) -> str | None:
    """The key in the path of a file in a store; None for any other file."""
    found = _IN_STORE.search(str(path))
    return found[1] if found else None


def _key_of_file(path: str) -> str:
    """The key of a source: the key in its path, or else the digest of its bytes."""
    key = key_in(path)
    if key is not None:
        return key
    return digest_of_file(path) if os.path.isfile(path) else "missing"


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
        if self.call:
            function = self.call.partition(":")[2]
            content = [self.code, {"": function, **self.values}, self.source_keys]
        else:
            content = ["", {}, {"parts": [part.key for part in self.parts]}]
        return hashlib.sha256(as_json(content).encode()).hexdigest()[:16]

    @property
    def source_keys(self) -> dict[str, list[str]]:
        """Keys of the sources, by the function's argument."""
        return {role: [*map(_key_of_file, listed(paths))] for role, paths in self.sources.items()}

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
        """The recipes of the results that must be in the store: for a batch its parts."""
        return [self] if self.call else self.parts

    @property
    def names(self) -> list[str]:
        """The names of its files in the store."""
        return [Path(self.stored(file)).name for file in self.files]

    def is_in(self, store: Store) -> bool:
        """Whether a store has the result; of a batch all parts."""
        return all(store.has(one.key, one.names) for one in self.needed)

    def obtained(self, store: Store, others: list[Store]) -> list[Path]:
        """Copy what a store lacks from others; return the stores that had it."""
        lacking = [one for one in self.needed if not store.has(one.key, one.names)]
        found = (
            store.take(
                one.key,
                one.names,
                others,
            )
            for one in lacking
        )
        return [source for source in found if source is not None]

    def stored(self, file: str) -> str:
        """The path in the store of one of the result's files."""
        suffix = file.removeprefix(f"{self.results}/{self.name}")
        return f"{self.results}/store/{self.key}/{STEM}{suffix}"

    def manifest(self) -> str:
        """The text in the file of a batch: the keys of its parts, by their names."""
        return as_json({part.name: part.key for part in self.parts}) + "\n"

    def expected(self) -> dict[str, str]:
        """The target in the store of each file, or its text if it is the list of a batch."""
        return {file: self.stored(file) if self.call else self.manifest() for file in self.files}

    def text(self, planned: str) -> str:
        """The recipe as JSON; `planned` distinguishes two files of the same recipe."""
        return as_json({"planned": planned, **self._plain()})

    def _plain(self) -> dict[str, Any]:
        parts = [part._plain() for part in self.parts]
        return {**self._asdict(), "key": self.key, "parts": parts}


def is_manifest(file: Path) -> bool:
    """Whether a file has the form of :meth:`Recipe.manifest`."""
    try:
        return re.fullmatch(_MANIFEST, file.read_text("utf-8")) is not None
    except (OSError, ValueError):
        return False


def listed(paths: str | Iterable[object]) -> list[str]:
    """One path, or several, as a list of plain texts."""
    return [str(paths)] if isinstance(paths, str) else [str(path) for path in paths]


def read(path: str | Path) -> Recipe:
    """Read a recipe; it and its parts have the keys with which they were planned."""
    return _from_plain(json.loads(Path(path).read_text("utf-8")))


def _from_plain(values: Mapping[str, Any]) -> Recipe:
    given = {name: values[name] for name in Recipe._fields}
    given["parts"] = [_from_plain(part) for part in values["parts"]]
    recipe = Recipe(**given)
    vars(recipe)["key"] = values["key"]
    return recipe
