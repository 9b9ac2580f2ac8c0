"""What every job of the workflow does besides its own work.

It says in its log what happens, refuses to run other code than it was planned with, reads only
what is what it was asked for, and leaves with each result what vouches for it.
"""

from __future__ import annotations

import gc
import sys
import time
import traceback
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple

import xarray as xr

from ..datasets import netcdf, provenance
from ..datasets.variables import DatasetError
from ..model.quantities import ParameterError
from . import cache, code, keys
from .keys import Store

EXPECTED = (DatasetError, ParameterError, code.CodeError, OSError)
"""Failures that are told in one line: what to do about them is outside of the code."""


class Result(NamedTuple):
    """A dataset that bears its key: its place, the key, and the digest of what makes it."""

    path: Path
    key: str
    code: str


class Job:
    """A job, as a context: ``with Job(snakemake, __file__) as job``.

    Parameters
    ----------
    snakemake : what Snakemake gives to a script.
    script : path of the script.

    Raises
    ------
    SystemExit
        With one line, if something is wrong that is not an error of the code.
    """

    def __init__(self, snakemake: Any, script: str) -> None:
        self._snakemake, self._script = snakemake, script
        self.params, self.input, self.output = snakemake.params, snakemake.input, snakemake.output
        self.key = keys.key_in(self.output[0]) or keys.joined(self.params.made)
        self._began = time.monotonic()

    def __enter__(self) -> Job:
        if self._snakemake.log:
            sys.stderr = open(self._snakemake.log[0], "a", buffering=1, encoding="utf-8")
        try:
            code.verify_loaded(self.params.code, self._script, *code.ALWAYS, *self.params.modules)
            gc.freeze()  # what is loaded stays: at its end Python would look through it, for .3 s
            if keys.key_in(self.output[0]) not in (None, keys.joined(self.params.made)):
                raise DatasetError(f"{self.output[0]} is not what this job makes: plan it again")
            for path, wanted in self.params.expected.items():
                self._verify(path, wanted)
        except EXPECTED as error:
            self._refuse(error)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None
    ) -> None:
        if isinstance(error, EXPECTED):
            self._refuse(error)
        if error is not None:
            if not isinstance(error, SystemExit):
                traceback.print_exception(error)  # into the log
            return
        for path in map(str, self.output):
            if keys.key_in(path) is None:
                self._store.sign(path, self.params.made)
        print(f"done in {time.monotonic() - self._began:.1f} s", file=sys.stderr)

    @property
    def own(self) -> Result:
        """The job's first result."""
        return Result(Path(self.output[0]), self.key, self.params.code)

    @property
    def results(self) -> list[Result]:
        """What a job makes whose results each bear their own key: its `places`, or one's own."""
        places = self.params.get("places")
        if places is None:
            return [self.own]
        return [Result(Path(path), keys.key_in(path) or "", code) for path, code in places]

    @property
    def _store(self) -> Store:
        return Store(self._snakemake.config.get("results", "results"))

    def end(self, message: str) -> None:
        """End the job without its result, for a reason that its log and Snakemake's output tell."""
        print(message, file=sys.stderr)
        sys.stderr = sys.__stderr__
        sys.exit(message)

    def _refuse(self, error: BaseException) -> None:
        self.end(f"{self._snakemake.rule}: {error}")

    def _verify(self, path: str, wanted: str) -> None:
        """Make sure of a file with a plain name; one with its key in it is verified when read."""
        if Path(path).suffix == ".nc":
            return
        known = len(wanted) == keys.LENGTH
        found = self._store.key_of(path) if known else keys.content(path)
        if found != wanted:
            raise DatasetError(f"{path} is not what this job was planned with: run it again")

    # -- reading and writing --------------------------------------------------------------------

    def read(self, path: str, key: str | None = None) -> xr.Dataset:
        """An input, whole and of the key that the job was planned with; or any dataset of a key.

        Raises
        ------
        DatasetError
            Otherwise, naming the file.
        """
        dataset = netcdf.read(path)
        wanted = key or self.params.expected[str(path)]
        if dataset.attrs.get("key") != wanted:
            raise DatasetError(
                f"{path} is another result than it should be (its key is "
                f"{dataset.attrs.get('key', 'missing')}, not {wanted}): delete it, run it again"
            )
        return dataset

    def read_all(self, paths: Any) -> Any:
        """Several inputs, read one at a time."""
        return map(self.read, paths)

    def attributes(
        self, parameters: Any, result: Result | None = None, sources: Iterable[str] | None = None
    ) -> dict[str, str]:
        """Attributes of a dataset that say how this job made it; of its own or another result.

        `sources` are the inputs that it is made from, if not those of the job's own result.
        """
        made = result or self.own
        return provenance.attributes(
            parameters, made.code, f"snakemake {made.path}", self._sources(sources), key=made.key
        )

    def _sources(self, paths: Iterable[str] | None) -> Mapping[str, str]:
        results, known = self._store.results, self.params.expected
        if paths is not None:
            known = {path: keys.key_in(path) for path in paths}
        return {
            str(Path(path).relative_to(results) if Path(path).is_relative_to(results) else path): k
            for path, k in known.items()
        }

    def write(
        self,
        dataset: xr.Dataset,
        path: str | Result,
        parameters: Any,
        sources: Iterable[str] | None = None,
    ) -> None:
        """Write a dataset with its origin; `parameters` is what it depends on.

        A result of its own key stands in the place of a path; `sources` as of :meth:`attributes`.
        """
        result = path if isinstance(path, Result) else None
        place = path.path if isinstance(path, Result) else path
        netcdf.write(dataset, place, **self.attributes(parameters, result, sources))

    def write_text(self, text: str, path: str) -> None:
        """Write a text file."""
        netcdf.write_text(text, path)

    # -- results that cost much -----------------------------------------------------------------

    def fetched(self, result: Result | None = None) -> bool:
        """Whether a dataset was found under its key, in the cache or kept from before."""
        wanted = result or self.own
        shared = cache.shared()
        for place in (self._store.results / cache.KEPT, *([shared] if shared else [])):
            if cache.fetch(place, wanted.key, wanted.path):
                print(f"taken from {place}", file=sys.stderr)
                return True
        return False

    def keep(self, result: Result | None = None) -> None:
        """Keep a dataset under its key, for others and for what may still fail."""
        made = result or self.own
        cache.hold(self._store.results, made.key, made.path)
        if shared := cache.shared():
            cache.keep(shared, made.key, made.path)
