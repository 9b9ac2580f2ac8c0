"""Making results: call a recipe's function with its sources, and put the result into the store.

A job refuses to run code that differs from the planned code, and checks each source that it reads.
New results are copied to the stores elsewhere.
"""

import gc
import importlib
import os
import shlex
import sys
import tempfile
import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import xarray as xr

from nucleation.datasets import netcdf, provenance
from nucleation.datasets.variables import DatasetError, is_table, to_csv
from nucleation.model.quantities import ParameterError

from ..tables.rows import remarked, rows_of, without_event
from . import code
from .batch import Batch, Inputs
from .calls import arguments
from .differences import differences
from .entries import STEM, path_in, read_note
from .keys import key_in
from .messages import LOGGER
from .recipes import Recipe
from .store import Store, give_all, others

_EXPECTED = (
    DatasetError,
    ParameterError,
    code.CodeError,
    OSError,
)
"""Errors that are reported in one line: their cause is not in the code."""

_LENGTHS = "lengths/"
"""Directory of the tables of studies; a run without an event, or with a remark, is reported."""


def make(recipe: Recipe, rule: str, threads: int, forced: bool) -> None:
    """Make the result of a recipe, and put it into the store.

    Parameters
    ----------
    recipe : Recipe
        Recipe of the result.
    rule : str
        Name of its rule.
    threads : int
        Number of cores for the parts of a batch.
    forced : bool
        Whether the result is made even if the store has it, and compared with the stored one.

    Raises
    ------
    SystemExit
        With the reason, if that is impossible.
    """
    try:
        verify(recipe)
        gc.freeze()  # at its end Python would search all loaded objects, which takes 0.3 s
        _Maker(rule, recipe.store, forced).make(recipe, threads)
    except _EXPECTED as error:
        sys.exit(f"{rule}: {error}")
    except Exception as error:
        traceback.print_exception(error)  # into the log
        sys.exit(f"{rule}: {type(error).__name__}: {error}")


def verify(recipe: Recipe) -> None:
    """Load all code of a recipe, and check that code and sources are those of the plan.

    Raises
    ------
    CodeError
        If the code or a source has changed.
    """
    recipes = (recipe, *recipe.parts)
    for roots in dict.fromkeys(one.roots for one in recipes):
        code.load(*roots)
    for one in recipes:
        if one.key_now() != one.key:
            raise code.CodeError(
                f"the code, the parameters or the sources of {one.name} have changed since this "
                "job was planned: start the workflow again"
            )


class _Maker:
    """Makes the results of one rule.

    Parameters
    ----------
    rule : str
        Its name, for the notes of the store.
    store : Store
        Receives the results.
    forced : bool
        Whether a result is made even if the store has it, and compared with the stored one.
    """

    def __init__(self, rule: str, store: Store, forced: bool) -> None:
        self._rule = rule
        self._store = store
        self._forced = forced
        self._others = others(strict=False)

    def make(self, recipe: Recipe, threads: int) -> None:
        """Make the result of a recipe, or the results of a batch on several cores."""
        if not recipe.parts:
            self._result(recipe)
            return
        batch = Batch(self._result, recipe.parts, threads)
        if recipe.call:
            table = self._called(recipe, records=batch)
            batch.end_on_failures()  # a table without the failed runs is not kept
            self._put(recipe, table)
        else:
            batch.map()
            batch.end_on_failures()

    def _result(self, recipe: Recipe) -> Any:
        """The result of a recipe as its function returned it, or the dataset in the store.

        Raises
        ------
        PartFailed
            If it is a simulation that has failed.
        """
        if not self._forced and self._store.note(recipe.key) is not None:
            return self._open(recipe.stored(recipe.files[0]))
        from .running import SIMULATE, run_of

        if recipe.call == SIMULATE:
            return run_of(recipe, self._put, self._origin(recipe))
        made = self._called(recipe)
        self._put(recipe, made)
        if recipe.name.startswith(_LENGTHS):
            _warn_of_unusual_runs(recipe, made)
        return made

    def _called(self, recipe: Recipe, **more: Any) -> Any:
        """Call the function of a recipe; it reads each of several sources when it needs it."""
        module, _, name = recipe.call.partition(":")
        function = getattr(importlib.import_module(module), name)
        values = {**recipe.values, "origin": self._origin(recipe)}
        sources: dict[str, Any] = {}
        for role, paths in recipe.sources.items():
            if isinstance(paths, list):
                sources[role] = Inputs(self._open, paths)
            else:
                sources[role] = self._open(paths)
        return function(**arguments(function, values), **sources, **more)

    def _open(self, path: str) -> xr.Dataset | Path:
        """Read a dataset, whose key must be the one in its path; return other files as paths.

        Raises
        ------
        DatasetError
            If it is another result; an entry of this store is moved aside.
        """
        key = key_in(path)
        if key is None:
            return Path(path)
        file = path_in(self._store.entry(key), Path(path).suffix)
        try:
            if file.suffix != ".nc":
                read_note(file.parent, whole=True)
                return file
            dataset = netcdf.read(file)
            found = dataset.attrs.get("key", "missing")
            if found != key:
                raise DatasetError(f"{file} is another result than it should be, of key {found}")
            return dataset
        except DatasetError as error:
            raise self._store.refused(key, error) from None

    def _put(self, recipe: Recipe, made: Any) -> None:
        """Put the value of a function into the store, or compare it with the stored result."""
        files = _files_of(made)
        origin = self._origin(recipe)

        def write(place: Path) -> None:
            for suffix, content in files.items():
                _write_one(content, place / f"{STEM}{suffix}", origin)

        if self._store.note(recipe.key) is not None:
            compared = self._compared(recipe.key, write)
            LOGGER.info(f"{recipe.name}, made again: {compared}")
            return
        about = {name: origin[name] for name in ("created", "code_digest", "versions")}
        about |= {"rule": self._rule, "name": recipe.name}
        self._store.put(recipe.key, write, about)
        give_all(self._store.entry(recipe.key), self._others)

    def _compared(self, key: str, write: Callable[[Path], None]) -> str:
        """The differences of a result that was made again from the stored one, in words."""
        found: list[str] = []
        with tempfile.TemporaryDirectory() as place:
            write(Path(place))
            for file in sorted(Path(place).iterdir()):
                found += differences(file, self._store.entry(key) / file.name)
        return "; ".join(found) or "the same as in the store, which is kept"

    def _origin(self, recipe: Recipe) -> dict[str, str]:
        """Attributes of a recipe's dataset that record how it was made."""
        files = os.environ.get("NUCLEATION_CONFIGFILES", "")  # none: the default configuration
        command = f"snakemake {shlex.quote(recipe.files[0])}"
        if files:
            command += f" --configfile {files}"
        return provenance.attributes(
            recipe.values,
            recipe.code,
            command,
            recipe.source_keys,
            key=recipe.key,
        )


def _warn_of_unusual_runs(recipe: Recipe, made: Any) -> None:
    if isinstance(made, xr.Dataset) and "onset_time" in made:
        study = recipe.name.removeprefix(_LENGTHS)
        rows = rows_of(made)
        for line in (*without_event(rows), *remarked(rows)):
            LOGGER.warning(f"Warning: study {study}: {line}")


def _files_of(made: Any) -> Mapping[str, Any]:
    """The contents of a result's files by suffix; a table is also written as CSV."""
    if isinstance(made, xr.Dataset):
        files: Mapping[str, Any] = {".nc": made}
    elif isinstance(made, Mapping):
        files = made
    else:
        files = {"": made}  # a figure, which has several files
    dataset = files.get(".nc")
    if ".csv" not in files and dataset is not None and is_table(dataset):
        files = {**files, ".csv": to_csv(dataset)}
    return files


def _write_one(content: Any, path: Path, origin: Mapping[str, str]) -> None:
    """Write one file: a dataset with its origin, a text, a figure, or by calling `content`."""
    if isinstance(content, xr.Dataset):
        parameters = content.attrs.get("parameters", origin["parameters"])
        netcdf.write(content, path, **{**origin, "parameters": parameters})
    elif isinstance(content, str):
        netcdf.write_text(content, path)
    elif callable(content):
        content(path)
    else:
        # the code that drew the figure has loaded matplotlib
        from nucleation.pictures import style

        style.save(content, path, origin["key"])
