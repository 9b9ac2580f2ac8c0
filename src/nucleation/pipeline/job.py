"""What every job of the workflow does: find its result in a store, or make it and put it there.

A job says in its log what happens. It refuses to run other code than it was planned with, reads
only what is what it was asked for, and leaves a link to its result for Snakemake.
"""

import contextlib
import gc
import importlib
import inspect
import os
import shutil
import sys
import time
import traceback
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import is_dataclass
from pathlib import Path
from typing import Any, NoReturn

import xarray as xr

from ..datasets import netcdf, provenance
from ..datasets.variables import DatasetError, is_table, to_csv
from ..model.quantities import ParameterError
from . import code
from .steps import LINKS, Task, plain_paths, task_of
from .store import STEM, Store, StoreError, give_all, key_in, others, path_in, read_note

EXPECTED = (DatasetError, ParameterError, StoreError, code.CodeError, OSError)
"""Failures that are told in one line: what to do about them is outside of the code."""


class Job:
    """The results that a job makes, one or several, from what Snakemake gives to a script."""

    def __init__(self, snakemake: Any) -> None:
        link, params = str(snakemake.output[0]), dict(snakemake.params.items())
        if "each" in params:
            self.tasks = [Task(*task) for task in params["each"]]
        else:
            inputs = {role: plain_paths(value) for role, value in snakemake.input.items()}
            self.tasks = [task_of(link, params, inputs)]
        self.rule, self.log = str(snakemake.rule), Path(str(snakemake.log[0]))
        self.results = Path(link.rpartition(f"/{LINKS}/")[0])
        self.store = Store(self.results / "store")
        self._others = others(strict=False)
        self.listener: Any = None  # the checkpoint of the run that began last, which hears signals

    def verify(self) -> None:
        """Make sure that this process has the code, parameters and sources it was planned with."""
        for roots in dict.fromkeys(task.roots for task in self.tasks):
            code.load(*roots)
        for task in self.tasks:
            if task.key != key_in(task.link):
                raise code.CodeError(
                    f"the code, the parameters or the sources of {Path(task.link).name} have "
                    "changed since this job was planned: start the workflow again"
                )

    def found(self, key: str) -> bool:
        """Whether a store has a result; it is in the job's own store then."""
        if self.store.note(key) is not None:
            return True
        source = self.store.take(key, self._others)
        if source is not None:
            print(f"taken from {source}", file=sys.stderr)
        return source is not None

    def called(self, task: Task, **more: Any) -> Any:
        """What the function of a task returns; of several inputs it reads each when it needs it."""
        module, _, name = task.call.partition(":")
        function = getattr(importlib.import_module(module), name)
        values = {**task.values, "origin": self.origin(task)}
        inputs = {
            role: Inputs(self, paths) if isinstance(paths, list) else self.open(paths)
            for role, paths in task.sources.items()
        }
        return function(**arguments(function, values), **inputs, **more)

    def open(self, path: str) -> Any:
        """A dataset, whole and of the key in its path; of any other file the path.

        Raises
        ------
        StoreError
            If it is another result; one in the job's own store is moved aside.
        """
        key = key_in(path)
        if key is None:
            return Path(path)
        file = path_in(self.store.entry(key), Path(path).suffix)  # wherever the link leads
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

    def put(self, task: Task, made: Any) -> None:
        """Put what a function has returned into the store: all files of the result.

        A table is put as comma-separated text, too.
        """
        key, origin = str(key_in(task.link)), self.origin(task)
        if isinstance(made, xr.Dataset):
            made = {".nc": made}
        elif not isinstance(made, Mapping):
            made = {"": made}  # a figure, which has several files
        if ".csv" not in made and is_table(found := made.get(".nc", xr.Dataset())):
            made = {**made, ".csv": to_csv(found)}

        def write(place: Path) -> None:
            for suffix, content in made.items():
                _write_one(content, place / f"{STEM}{suffix}", origin)

        about = {name: origin[name] for name in ("created", "code_digest", "versions")}
        self.store.put(key, write, about | {"rule": self.rule, "name": Path(task.link).name})
        give_all(self.store.entry(key), self._others)

    def origin(self, task: Task) -> dict[str, str]:
        """Attributes of a task's dataset that say how it was made."""
        files = os.environ.get("NUCLEATION_CONFIGFILES", "")  # none: the usual configuration
        command = f"snakemake {task.link}{' --configfile ' if files else ''}{files}"
        return provenance.attributes(
            task.values, task.code, command, task.source_keys, key=task.key
        )

    def leave_link(self, task: Task) -> None:
        """Tell Snakemake that a result is there."""
        link, key = Path(task.link), str(key_in(task.link))
        lay(link, path_in(self.store.entry(key), link.suffix))


def lay(link: Path, target: Path) -> None:
    """Put a relative link in place, or a copy where links can't be."""
    link.parent.mkdir(parents=True, exist_ok=True)
    new = link.with_name(f".{link.name}.{os.getpid()}.tmp")
    new.unlink(missing_ok=True)
    try:
        new.symlink_to(os.path.relpath(target.absolute(), link.parent.absolute()))
    except OSError:
        shutil.copyfile(target, new)
    new.replace(link)


class Inputs(Sequence[Any]):
    """Inputs of one role, each read when it is asked for."""

    def __init__(self, job: Job, paths: list[str]) -> None:
        self._job, self._paths = job, paths

    def __len__(self) -> int:
        return len(self._paths)

    def __getitem__(self, i: Any) -> Any:
        return self._job.open(self._paths[i])


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
            value = getattr(kind, "from_dict", lambda given, kind=kind: kind(**given))(value)
        found[name] = value
    return found


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


@contextlib.contextmanager
def running(snakemake: Any) -> Iterator[Job]:
    """A job that says in its log what happens, and in one line why it ends without its results."""
    job, began = Job(snakemake), time.monotonic()
    job.log.parent.mkdir(parents=True, exist_ok=True)
    sys.stderr = job.log.open("a", buffering=1, encoding="utf-8")
    try:
        job.verify()
        gc.freeze()  # what is loaded stays: at its end Python would look through it, for .3 s
        yield job
    except EXPECTED as error:
        end(f"{job.rule}: {error}")
    except Exception as error:
        traceback.print_exception(error)  # into the log
        raise
    print(f"done in {time.monotonic() - began:.1f} s", file=sys.stderr)


def end(message: str) -> NoReturn:
    """End the job without its result, for a reason that its log and Snakemake's output tell."""
    print(message, file=sys.stderr)
    sys.stderr = sys.__stderr__
    sys.exit(message)


def run(snakemake: Any) -> None:
    """Make the results of a job and link them."""
    with running(snakemake) as job:
        for task in job.tasks:
            if not job.found(task.key):
                job.put(task, job.called(task))
            job.leave_link(task)
