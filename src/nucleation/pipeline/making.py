"""Making results: a recipe's function, with its sources, and its result put into the store.

A job refuses to run other code than it was planned with, and reads only what is what it was asked
for. It gives what it made to the stores elsewhere.
"""

import gc
import importlib
import inspect
import os
import shlex
import sys
import tempfile
import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import is_dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..analysis.rows import remarked, rows_of, without_event
from ..datasets import netcdf, provenance
from ..datasets.variables import DatasetError, is_table, to_csv
from ..model.quantities import ParameterError
from . import code
from .recipes import PartFailed, Recipe
from .side_by_side import side_by_side
from .store import STEM, Store, StoreError, give_all, key_in, others, path_in, read_note
from .views import show

EXPECTED = (DatasetError, ParameterError, StoreError, code.CodeError, OSError)
"""Errors that are told in one line: what to do about them is outside of the code."""

LENGTHS = "lengths/"
"""Directory of the tables of studies, whose runs without an event are warned of."""

OF_MACHINE = ("wall_seconds", "peak_megabytes", "created", "versions", "command", "history")
"""What differs between two results of one recipe."""


def make(recipe: Recipe, rule: str, threads: int, forced: bool) -> None:
    """Make the result of a recipe, and put it into the store.

    Ends the process with a line that says why if that can't be done.
    """
    try:
        verify(recipe)
        gc.freeze()  # at its end Python would look through all that is loaded, for .3 s
        Maker(rule, recipe.store, forced).make(recipe, threads)
    except EXPECTED as error:
        sys.exit(f"{rule}: {error}")
    except Exception as error:
        traceback.print_exception(error)  # into the log
        sys.exit(f"{rule}: {type(error).__name__}: {error}")


def verify(recipe: Recipe) -> None:
    """Load all code of a recipe, and make sure that it is what the recipe was planned with.

    Raises
    ------
    CodeError
        If it is not, or if the sources have changed.
    """
    every = (recipe, *recipe.parts)
    for roots in dict.fromkeys(one.roots for one in every):
        code.load(*roots)
    for one in every:
        if one.key_now() != one.key:
            raise code.CodeError(
                f"the code, the parameters or the sources of {one.name} have changed since this "
                "job was planned: start the workflow again"
            )


class Maker:
    """Makes results for a rule.

    Parameters
    ----------
    rule : its name, for the store's notes.
    store : where results go.
    forced : whether a result is made although the store has it, and compared with that.
    """

    def __init__(self, rule: str, store: Store, forced: bool) -> None:
        self._rule = rule
        self.store = store
        self.forced = forced
        self._others = others(strict=False)

    def make(self, recipe: Recipe, threads: int) -> None:
        """Make the result of a recipe, or those of a batch on some cores side by side."""
        if not recipe.parts:
            self.result(recipe)
            return
        batch = Batch(self, recipe.parts, threads)
        if recipe.call:
            table = self.called(recipe, records=batch)
            batch.end_on_failures()  # before a table without them is kept
            self.put(recipe, table)
        else:
            batch.map()
            batch.end_on_failures()

    def result(self, recipe: Recipe) -> Any:
        """The result of a recipe as its function returned it, or the dataset in the store.

        Raises
        ------
        PartFailed
            If it is a simulation that has failed.
        """
        if not self.forced and self.store.note(recipe.key) is not None:
            return self.open(recipe.stored(recipe.files[0]))
        from .running import SIMULATE, run_of  # which loads the solver

        if recipe.call == SIMULATE:
            return run_of(recipe, self.put, self.origin(recipe))
        made = self.called(recipe)
        self.put(recipe, made)
        if (
            isinstance(made, xr.Dataset)
            and "onset_time" in made
            and recipe.name.startswith(LENGTHS)
        ):
            rows = rows_of(made)
            for line in (*without_event(rows), *remarked(rows)):
                study = recipe.name.removeprefix(LENGTHS)
                print(f"Warning: study {study}: {line}", file=sys.__stderr__)
        return made

    def called(self, recipe: Recipe, **more: Any) -> Any:
        """What a recipe's function returns; of several sources it reads each when it needs it."""
        module, _, name = recipe.call.partition(":")
        function = getattr(importlib.import_module(module), name)
        values = {**recipe.values, "origin": self.origin(recipe)}
        sources = {
            role: Sources(self, paths) if isinstance(paths, list) else self.open(paths)
            for role, paths in recipe.sources.items()
        }
        return function(**arguments(function, values), **sources, **more)

    def open(self, path: str) -> Any:
        """A dataset, whole and of the key in its path; of any other file the path.

        Raises
        ------
        StoreError
            If it is another result; one in the own store is moved aside.
        """
        key = key_in(path)
        if key is None:
            return Path(path)
        file = path_in(self.store.entry(key), Path(path).suffix)
        try:
            if file.suffix != ".nc":
                read_note(file.parent, whole=True)
                return file
            dataset = netcdf.read(file)
            if dataset.attrs.get("key") != key:
                found = dataset.attrs.get("key", "missing")
                raise DatasetError(f"{file} is another result than it should be, of key {found}")
            return dataset
        except (DatasetError, StoreError) as error:
            raise self.store.refused(key, error) from None

    def put(self, recipe: Recipe, made: Any) -> None:
        """Put what a function has returned into the store, or compare it with what is there.

        A table is put as comma-separated text, too.
        """
        if isinstance(made, xr.Dataset):
            made = {".nc": made}
        elif not isinstance(made, Mapping):
            made = {"": made}  # a figure, which has several files
        if ".csv" not in made and is_table(found := made.get(".nc", xr.Dataset())):
            made = {**made, ".csv": to_csv(found)}
        origin = self.origin(recipe)

        def write(place: Path) -> None:
            for suffix, content in made.items():
                _write_one(content, place / f"{STEM}{suffix}", origin)

        if self.store.note(recipe.key) is not None:
            compared = self._compared(recipe.key, write)
            print(f"{recipe.name}, made again: {compared}", file=sys.stderr)
            return
        about = {name: origin[name] for name in ("created", "code_digest", "versions")}
        self.store.put(recipe.key, write, about | {"rule": self._rule, "name": recipe.name})
        give_all(self.store.entry(recipe.key), self._others)

    def _compared(self, key: str, write: Callable[[Path], None]) -> str:
        """How a result that was made again differs from the one in the store, in words."""
        with tempfile.TemporaryDirectory() as place:
            write(Path(place))
            differing = [
                text
                for file in sorted(Path(place).iterdir())
                for text in differences(file, self.store.entry(key) / file.name)
            ]
        return "; ".join(differing) or "the same as in the store, which is kept"

    def origin(self, recipe: Recipe) -> dict[str, str]:
        """Attributes of a recipe's dataset that say how it was made."""
        files = os.environ.get("NUCLEATION_CONFIGFILES", "")  # none: the usual configuration
        command = f"snakemake {shlex.quote(recipe.files[0])}"
        command += f" --configfile {files}" if files else ""
        return provenance.attributes(
            recipe.values, recipe.code, command, recipe.source_keys, key=recipe.key
        )


class Sources(Sequence[Any]):
    """What is read in one role, each when it is asked for."""

    def __init__(self, maker: Maker, paths: list[str]) -> None:
        self._maker = maker
        self._paths = paths

    def __len__(self) -> int:
        return len(self._paths)

    def __getitem__(self, i: Any) -> Any:
        return self._maker.open(self._paths[i])


class Batch:
    """The results of a batch, made side by side and shown as they come.

    Parameters
    ----------
    maker : what makes each.
    parts : their recipes.
    cores : how many are made at once.
    """

    def __init__(self, maker: Maker, parts: Sequence[Recipe], cores: int) -> None:
        self._maker = maker
        self._parts = parts
        self._cores = cores
        self._failures: list[str] = []

    def map(self, function: Callable[[int, Any], Any] = lambda number, result: None) -> list[Any]:
        """What a function returns for the number and the result of each part that was made.

        It is called where the result is made. Of a part that has failed there is nothing.
        """
        names = [part.name for part in self._parts]
        done = side_by_side(lambda i: self._one(i, function), names, self._cores)
        self._failures += [failure for failure, _ in done if failure]
        return [value for failure, value in done if not failure]

    def _one(self, number: int, function: Callable[[int, Any], Any]) -> tuple[str, Any]:
        part = self._parts[number]
        try:
            result = self._maker.result(part)
        except PartFailed as error:
            print(error, file=sys.stderr)
            return str(error), None
        show(part)
        return "", function(number, result)

    def end_on_failures(self) -> None:
        """End the job, once all that can be made is, if a part has failed."""
        failures, number = self._failures, len(self._parts)
        if failures and number == 1:
            sys.exit(failures[0])
        if failures:
            count = f"{len(failures)} of {number} runs failed, the others are kept:"
            sys.exit("\n  ".join([count, *failures]))


def arguments(function: Any, values: Mapping[str, Any]) -> dict[str, Any]:
    """Values for a function, those as dataclasses that it wants so; `origin` only if it asks."""
    wanted = inspect.signature(function).parameters
    found = {}
    for name, value in values.items():
        if name == "origin" and name not in wanted:
            continue
        kind = wanted[name].annotation if name in wanted else None
        if isinstance(kind, str):
            kind = function.__globals__.get(kind)
        if isinstance(kind, type) and is_dataclass(kind) and isinstance(value, Mapping):
            value = getattr(kind, "from_dict", partial(_of_plain, kind))(value)
        found[name] = value
    return found


def _of_plain(kind: Any, values: Mapping[str, Any]) -> Any:
    """A dataclass from what JSON has kept of it, which knows lists and no tuples."""
    return kind(**{k: tuple(v) if isinstance(v, list) else v for k, v in values.items()})


def _write_one(content: Any, path: Path, origin: Mapping[str, str]) -> None:
    """Write one file: a dataset with its origin, a text, or whatever writes itself."""
    if isinstance(content, xr.Dataset):
        own = content.attrs.get("parameters", origin["parameters"])
        netcdf.write(content, path, **{**origin, "parameters": own})
    elif isinstance(content, str):
        netcdf.write_text(content, path)
    elif callable(content):
        content(path)
    else:
        from ..figures import style  # a figure: matplotlib is loaded by what has drawn it

        style.save(content, path, origin["key"])


def differences(new: Path, old: Path) -> list[str]:
    """How a file differs from another one, in words; datasets by their numbers."""
    if not old.is_file():
        return [f"{new.name} is not in the store"]
    if new.suffix != ".nc":
        return [] if new.read_bytes() == old.read_bytes() else [f"{new.name} differs"]
    ours, theirs = netcdf.read(new), netcdf.read(old)
    found = []
    for name in sorted({*map(str, ours.variables), *map(str, theirs.variables)} - {*OF_MACHINE}):
        if name not in ours.variables or name not in theirs.variables:
            found.append(f"{name} is in one of them alone")
        elif not ours[name].variable.equals(theirs[name].variable):
            found.append(f"{name} differs{_size(ours[name].values, theirs[name].values)}")
    return found


def _size(ours: Any, theirs: Any) -> str:
    """The largest difference of two arrays over their largest value, in words."""
    if ours.shape != theirs.shape or ours.dtype.kind not in "fi":
        return ""
    largest = np.nanmax(np.abs(theirs), initial=0.0) or 1.0
    difference = np.nanmax(np.abs(ours - theirs), initial=0.0) / largest
    return f" by up to {difference:.1e} of its largest value"
