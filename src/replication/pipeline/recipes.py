"""Recipes: everything a job needs to know to make a result, and the files that show it.

A rule names the function that makes its result (``call``), modules that this loads by name
(``loads``), its other arguments, and its sources. The digest of these is the result's key. A recipe
is stored as JSON, so that a job on any machine makes the result that was planned.

The files that people open are links into a store, or copies where links are impossible. Any other
file belongs to the user. It is never overwritten, but moved aside.
"""

import contextlib
import dataclasses
import filecmp
import hashlib
import itertools
import json
import os
import re
import shutil
from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from nucleation.datasets import code
from nucleation.simulation.checkpoints import SIMULATION

from . import LOGGER
from .store import PATTERN, STEM, Store, digest_of_file

RECIPES = "recipes"  # directory in a store, with a subdirectory for each directory of results
PLACES = "places"  # file beside recipes with the two directories that they are of
_ROOTS = {SIMULATION.module: SIMULATION}  # of modules that import code which they never use
_IN_STORE = re.compile(rf"/({PATTERN})/[^/]+$")
_MANIFEST = re.compile(rf'\{{("[^"]+": "{PATTERN}"(, )?)*\}}\n')  # of Recipe.expected


@dataclasses.dataclass
class Recipe:
    """How a result is made, and the key that follows from it."""

    name: str  # of the result, below the directory of results, without suffix: figures/figure_3
    files: list[str]  # outputs of the rule, which people open
    results: str  # the directory of results
    call: str  # the function that makes it, MODULE:NAME; empty for a batch without a table
    loads: list[str]  # modules that this function loads by name
    values: dict[str, Any]  # its other arguments
    sources: dict[str, Any]  # by its argument a path or a list: files in the store, or other files
    parts: "list[Recipe]"  # recipes of a batch
    key: str = ""  # as it was planned, in a recipe that is read from a file

    def __post_init__(self) -> None:
        self.key = self.key or self.key_now()

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
        """Keys of the sources, by the function's argument: of other files digests of bytes."""
        found = {}
        for role, paths in self.sources.items():
            found[role] = [
                key_in(path) or (digest_of_file(path) if os.path.isfile(path) else "missing")
                for path in listed(paths)
            ]
        return found

    @property
    def roots(self) -> tuple[code.Root, ...]:
        """The modules that its code begins with."""
        if not self.call:
            return ()
        modules = (self.call.partition(":")[0], *self.loads)
        return code.ALWAYS, *(_ROOTS.get(module, code.Root(module)) for module in modules)

    @property
    def code(self) -> str:
        """Digest of its code."""
        return code.digest(*self.roots)

    @property
    def needed(self) -> "list[Recipe]":
        """The recipes of the results that must be in the store: for a batch its parts."""
        return [self] if self.call else self.parts

    @property
    def names(self) -> list[str]:
        """The names of its files in the store."""
        return [os.path.basename(self.stored(file)) for file in self.files]

    def is_in(self, store: Store) -> bool:
        """Whether a store has the result; of a batch all parts."""
        return all(store.has(one.key, one.names) for one in self.needed)

    def is_shown(self, store: Store) -> bool:
        """Whether the store has the result, and the rule's files show it."""
        return self.is_in(store) and all(itertools.starmap(shows, self.expected().items()))

    @property
    def is_linked(self) -> bool:
        """Whether its files are links; then Snakemake sees the time of the result."""
        return not self.call or all(map(os.path.islink, self.files))

    def obtained(self, store: Store, others: list[Store]) -> list[Path]:
        """Copy what a store lacks from others; return the stores that had it."""
        lacking = [one for one in self.needed if not store.has(one.key, one.names)]
        found = [store.take(one.key, one.names, others) for one in lacking]
        return [*filter(None, found)]

    def stored(self, file: str) -> str:
        """The path in the store of one of the result's files."""
        suffix = file.removeprefix(f"{self.results}/{self.name}")
        return f"{self.results}/store/{self.key}/{STEM}{suffix}"

    def expected(self) -> dict[str, str]:
        """The target in the store of each file; for the list of a batch its text, with all keys."""
        if self.call:
            return {file: self.stored(file) for file in self.files}
        text = as_json({part.name: part.key for part in self.parts}) + "\n"
        return dict.fromkeys(self.files, text)

    def show(self) -> None:
        """Lay links to the result, or copies; for a batch write the list of its parts' keys."""
        newest = max(time_of(one.stored(one.files[0])) for one in self.needed)
        for name, wanted in self.expected().items():
            file = Path(name)
            file.parent.mkdir(parents=True, exist_ok=True)
            new = _beside(file)
            new.unlink(missing_ok=True)
            if self.call:
                try:
                    new.symlink_to(os.path.relpath(Path(wanted).absolute(), file.parent.absolute()))
                except OSError:
                    shutil.copyfile(wanted, new)
            else:
                new.write_text(wanted, "utf-8")
            # Snakemake makes again what is older than its inputs
            os.utime(new, (newest, newest), follow_symlinks=False)
            new.replace(file)

    def write_as_of(self, file: str, moment: float) -> None:
        """Write it to a file of this time (s since 1970); the content is new at another time."""
        write(Path(file), as_json({"planned": moment, **vars(self)}))
        os.utime(file, (moment, moment))


def read(path: str | Path) -> Recipe:
    """Read a recipe; it and its parts have the keys with which they were planned."""
    values = json.loads(Path(path).read_text("utf-8"))
    del values["planned"]
    values["parts"] = [Recipe(**part) for part in values["parts"]]
    return Recipe(**values)


def written_in(place: str) -> dict[str, set[str]]:
    """Keys of all recipes in a directory, by the names of results."""
    found = defaultdict(set)
    for path in Path(place).rglob("*.json"):
        name, _, key = str(path.relative_to(place).with_suffix("")).rpartition(".")
        found[name].add(key)
    return found


def places_of(results: str) -> str:
    """The directories of the results and of the work, relative to the store, a line each."""
    store = os.path.realpath(f"{results}/store")
    both = map(os.path.realpath, (results, "."))
    return "\n".join(os.path.relpath(place, store) for place in both)


def as_json(values: Any) -> str:
    """Values as JSON, equal values as equal text; TypeError if one has no such form."""
    return json.dumps(values, sort_keys=True, default=vars)  # a recipe in another one


def key_in(path: str | Path) -> str | None:
    """The key in the path of a file in a store; None for any other file."""
    found = _IN_STORE.search(str(path))
    return found[1] if found else None


def listed(paths: str | Iterable[object]) -> list[str]:
    """One path, or several, as a list of plain texts."""
    return [str(paths)] if isinstance(paths, str) else [str(path) for path in paths]


def time_of(path: str) -> float:
    """The time of a file or link (s since 1970); -1 if there is none."""
    try:
        return os.lstat(path).st_mtime
    except OSError:
        return -1.0


def write(file: Path, text: str) -> None:
    """Write a text completely or not at all; an older file is replaced."""
    file.parent.mkdir(parents=True, exist_ok=True)
    new = _beside(file)
    new.write_text(text, "utf-8")
    new.replace(file)


def _beside(file: Path) -> Path:
    return file.with_name(f".{file.name}.{os.getpid()}.tmp")


def shows(file: str | Path, wanted: str | Path) -> bool:
    """Whether a file is a link to a file of a store, a copy of it, or the list of a batch.

    `wanted` is a value of :meth:`Recipe.expected`.
    """
    if str(wanted).startswith("{"):
        return os.path.isfile(file) and Path(file).read_bytes() == str(wanted).encode()
    if os.path.islink(file):
        return os.path.realpath(file) == os.path.realpath(wanted)
    try:
        return filecmp.cmp(file, wanted, shallow=False)
    except OSError:
        return False


def withdraw(file: Path, known: Iterable[Path]) -> None:
    """Remove a file that shows another result; the store still has that.

    A link into a store or to nothing, a copy of a `known` file or a list of a batch is deleted. Any
    other file belongs to the user, and is moved aside.
    """
    if not os.path.lexists(file):
        return
    ours = any(shows(file, one) for one in known)
    if file.is_symlink():
        ours |= not file.exists() or key_in(os.readlink(file)) is not None
    if not ours:
        with contextlib.suppress(OSError, ValueError):
            ours = _MANIFEST.fullmatch(file.read_text("utf-8")) is not None
    with contextlib.suppress(FileNotFoundError):  # another process was faster
        if ours:
            file.unlink()
            return
        kept = file.with_name(f"{file.name}~")
        while os.path.lexists(kept):
            kept = kept.with_name(f"{kept.name}~")
        file.rename(kept)
        LOGGER.warning(f"{file} is not of the workflow: it is now {kept}")
