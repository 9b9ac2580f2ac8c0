"""Making results: call a recipe's function with its sources, and put the result into the store.

A job refuses to run code that differs from the planned code, and checks each source that it reads.
"""

import gc
import importlib
import inspect
import multiprocessing
import os
import shlex
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, is_dataclass
from functools import partial
from pathlib import Path
from typing import Any

import xarray as xr

from nucleation.datasets import DatasetError, code, netcdf, provenance
from nucleation.datasets.variables import to_csv
from nucleation.model.quantities import ParameterError
from nucleation.run.run import Run
from nucleation.simulation.checkpoints import SIMULATION, Stopped, run_to_file

from ..tables.rows import remarked, rows_of, without_event
from . import LOGGER, PROGRESS
from .batches import side_by_side
from .recipes import Recipe, key_in
from .store import STEM, Store, others, read_note

SIMULATE = f"{SIMULATION.module}:simulate"
UNFINISHED = "unfinished"  # directory of checkpoints, and of records of runs that failed
_LENGTHS = "lengths/"  # directory of the tables of studies

_EXPECTED = (DatasetError, ParameterError, OSError)
"""Errors that are reported in one line: their cause is not in the code."""

_OF_MACHINE = ("wall_seconds", "peak_megabytes")
"""Variables that differ between any two results of one recipe."""


class _PartFailed(Exception):
    """A part of a batch has failed; the other parts are made."""


def make(recipe: Recipe, rule: str, store: Store, threads: int, forced: bool) -> None:
    """Make the result of a recipe and put it into the stores; SystemExit with the reason if not.

    The parts of a batch are made on `threads` cores; see _Maker for `forced`.
    """
    try:
        verify(recipe)
        if "pint" not in sys.modules:  # xarray looks for it, and for 0.2 s if it finds it
            sys.modules["pint"] = None  # type: ignore[assignment]
            xr.IndexVariable("x", [0.0])
            del sys.modules["pint"]
        gc.freeze()  # at its end Python would search all loaded objects, which takes 0.3 s
        gc.enable()
        maker = _Maker(rule, store, forced, others(strict=False))
        each = partial(maker.each, recipe.parts, threads)
        if not recipe.parts:
            maker.result(recipe)
        elif recipe.call:  # if a run has failed, this ends before the table is kept
            maker.put(recipe, maker.called(recipe, records=each))
        else:
            each()
    except _EXPECTED as error:
        sys.exit(f"{rule}: {error}")
    except Exception as error:
        traceback.print_exception(error)  # into the log
        sys.exit(f"{rule}: {type(error).__name__}: {error}")


def verify(recipe: Recipe) -> None:
    """Load all code of a recipe; DatasetError unless code and sources are those of the plan."""
    recipes = (recipe, *recipe.parts)
    for roots in dict.fromkeys(one.roots for one in recipes):
        code.load(*roots)
    for one in recipes:
        if one.key_now() != one.key:
            raise DatasetError(
                f"the code, the parameters or the sources of {one.name} have changed since this "
                "job was planned: start the workflow again"
            )


@dataclass
class _Maker:
    """Makes the results of one rule."""

    rule: str
    store: Store
    forced: bool  # results that the store has are made again, and compared
    others: list[Store]

    def each(
        self,
        parts: Sequence[Recipe],
        cores: int,
        function: Callable[[int, Any], Any] = lambda number, result: None,
    ) -> list[Any]:
        """Make the parts of a batch; return the values of a function of their numbers and results.

        If parts have failed, SystemExit names them once all were tried.
        """
        missing = [self.forced or not part.is_in(self.store) for part in parts]
        to_compute = multiprocessing.Value("i", sum(missing))  # by all processes
        began = time.monotonic()

        def one(number: int) -> tuple[str, Any]:
            """Why a part has failed, and the value of the function if it has not."""
            failure = ""
            try:
                result = self.result(parts[number])
                parts[number].show()
            except _PartFailed as error:
                LOGGER.info(error)
                failure = str(error)
            with to_compute:
                to_compute.value -= missing[number]
                rest = to_compute.value
            if missing[number] and rest:
                left = (time.monotonic() - began) / (sum(missing) - rest) * rest
                text = f"{len(parts) - rest} of {len(parts)} runs done, about {left:.0f} s left"
                LOGGER.log(PROGRESS, text)
            return failure, None if failure else function(number, result)

        names = [part.name for part in parts]
        made = side_by_side(one, names, cores)
        failures = [failure for failure, _ in made if failure]
        if failures and len(names) > 1:
            failures.insert(0, f"{len(failures)} of {len(names)} runs failed, the others are kept:")
        if failures:
            sys.exit("\n  ".join(failures))
        return [value for _, value in made]

    def result(self, recipe: Recipe) -> Any:
        """The result of a recipe as its function returned it, or the dataset in the store.

        A simulation that has failed raises _PartFailed.
        """
        if not self.forced and recipe.is_in(self.store):
            return self._open(recipe.stored(recipe.files[0]))
        if recipe.call == SIMULATE:
            return self._simulated(recipe)
        made = self.called(recipe)
        self.put(recipe, made)
        if recipe.name.startswith(_LENGTHS):
            rows = rows_of(made[".nc"])
            for line in (*without_event(rows), *remarked(rows)):
                LOGGER.warning(f"Warning: study {recipe.name.removeprefix(_LENGTHS)}: {line}")
        return made

    def _simulated(self, recipe: Recipe) -> xr.Dataset:
        """The record of a run, from its checkpoint; a signal leaves a new one."""
        from nucleation.simulation.progress import Progress  # loads the solver

        name = recipe.name.rpartition("/")[2]
        parameters = Run.from_dict(recipe.values["parameters"])
        place = Path(recipe.results, UNFINISHED, f"{name}.nc")

        def write(dataset: xr.Dataset, path: Path) -> None:
            if path == place:
                self.put(recipe, dataset)
            else:
                netcdf.write(dataset, path, **_origin(recipe))

        progress = Progress(parameters, sys.stderr, name=name)
        try:
            dataset, path = run_to_file(parameters, place, write, recipe.code, progress)
        except Stopped as stopped:
            sys.exit(f"{name}: {stopped}")
        status = dataset.attrs["status"]
        if path != place:
            raise _PartFailed(f"{name}: {status}; its record is in {path}")
        LOGGER.info(f"{name}: {status}")
        return dataset

    def called(self, recipe: Recipe, **more: Any) -> Any:
        """Call the function of a recipe; each of several sources is read once it needs it."""
        module, _, name = recipe.call.partition(":")
        function = getattr(importlib.import_module(module), name)
        sources: dict[str, Any] = {}
        for role, paths in recipe.sources.items():
            alone = isinstance(paths, str)
            sources[role] = self._open(paths) if alone else map(self._open, paths)
        values = {**recipe.values, "origin": _origin(recipe)}
        return function(**arguments(function, values), **sources, **more)

    def _open(self, path: str) -> xr.Dataset | Path:
        """Read a dataset; other files are paths. A damaged entry of the store: DatasetError."""
        file = Path(path)
        key = key_in(path)
        if key is None:
            return file
        try:
            read_note(file.parent, whole=True)
            return netcdf.read(file, checked=True) if file.suffix == ".nc" else file
        except DatasetError as error:
            self.store.set_aside(key)
            advice = "It was moved aside: run this again, and it is made again"
            raise DatasetError(f"{error}. {advice}") from None

    def put(self, recipe: Recipe, made: Any) -> None:
        """Put the value of a function into the store, or compare it with the stored result."""
        files = made if isinstance(made, Mapping) else {"": made}  # a figure has several files
        if isinstance(made, xr.Dataset):  # which is a mapping, too
            files = {".nc": made}
        if f"{STEM}.csv" in recipe.names and ".csv" not in files:
            files = {**files, ".csv": to_csv(files[".nc"])}
        origin = _origin(recipe)

        def write(place: Path) -> None:
            for suffix, content in files.items():
                path = place / f"{STEM}{suffix}"
                if isinstance(content, xr.Dataset):
                    own = {"parameters": content.attrs.get("parameters", origin["parameters"])}
                    netcdf.write(content, path, **{**origin, **own})
                elif isinstance(content, str):
                    path.write_text(content, encoding="utf-8")
                elif callable(content):
                    content(path)
                else:
                    # the code that drew the figure has loaded matplotlib
                    from nucleation.pictures import style

                    style.save(content, path, origin["key"])

        if recipe.is_in(self.store):
            entry = self.store.entry(recipe.key)
            with tempfile.TemporaryDirectory() as place:
                write(Path(place))
                new = sorted(Path(place).iterdir())
                found = [file.name for file in new if differs(file, entry / file.name)]
            compared = f"{', '.join(found)} differs from" if found else "the same as in"
            LOGGER.info(f"{recipe.name}, made again: {compared} the store, which is kept")
            return
        about = {name: origin[name] for name in ("created", "code_digest", "versions")}
        self.store.put(recipe.key, write, {**about, "rule": self.rule, "name": recipe.name})
        self.store.give(recipe.key, self.others)


def _origin(recipe: Recipe) -> dict[str, str]:
    """Attributes of a recipe's dataset that record how it was made."""
    command = f"snakemake {shlex.quote(recipe.files[0])}"
    if os.environ.get("NUCLEATION_CONFIGFILES"):  # none: the default configuration
        command += f" --configfile {os.environ['NUCLEATION_CONFIGFILES']}"
    return provenance.attributes(
        recipe.values, recipe.code, command, recipe.source_keys, key=recipe.key
    )


def arguments(function: Callable[..., Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """Values of JSON for a function, as dataclasses where it is annotated with them.

    ``origin`` is dropped if the function has no such argument.
    """
    wanted = inspect.signature(function).parameters
    found = {name: value for name, value in values.items() if name in wanted or name != "origin"}
    for name in found.keys() & wanted.keys():
        value = found[name]
        kind: Any = wanted[name].annotation
        if isinstance(kind, str):
            kind = function.__globals__.get(kind)
        if hasattr(kind, "from_dict"):
            found[name] = kind.from_dict(value)
        elif isinstance(kind, type) and is_dataclass(kind):
            lists = {key: tuple(own) for key, own in value.items() if isinstance(own, list)}
            found[name] = kind(**{**value, **lists})  # JSON has no tuples
    return found


def differs(new: Path, old: Path) -> bool:
    """Whether two files of one recipe differ, datasets in more than the machine and the moment."""
    if new.suffix != ".nc":
        return new.read_bytes() != old.read_bytes()
    both = map(netcdf.read, (new, old))
    ours, theirs = (dataset.drop_vars(_OF_MACHINE, errors="ignore") for dataset in both)
    return not ours.equals(theirs)
