"""Stores elsewhere: results are taken from them before they are computed, and given to them after.

What is there may be damaged, foreign or out of reach: it is said in a line, and not taken.
"""

import contextlib
import functools
import json
import os
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

from .store import BAD, NOTE, Other, Store, StoreError, files_of, in_a_line, read_note

VARIABLE = "NUCLEATION_STORES"  # of the environment; it names further stores, separated by commas
# times (s) and attempts after which a bucket of S3 is out of reach (botocore's)
PATIENCE = {"connect_timeout": 3, "read_timeout": 10, "retries": {"total_max_attempts": 2}}


class SharedDirectory:
    """Another store in a directory, which many may use at once."""

    def __init__(self, directory: Path) -> None:
        self._store = Store(directory)

    def __str__(self) -> str:
        return str(self._store.directory)

    def fetch(self, key: str, into: Path) -> bool:
        """See :class:`Other`."""
        entry = self._store.entry(key)
        if not (entry / NOTE).is_file():
            return False
        for name in (NOTE, *read_note(entry)["files"]):
            shutil.copyfile(entry / name, into / name)
        return True

    def give(self, entry: Path) -> None:
        """See :class:`Other`. What is damaged there is moved aside."""
        note = read_note(entry)
        if not os.access(self._store.directory, os.W_OK):
            return

        def copy(place: Path) -> None:
            for name in note["files"]:
                shutil.copyfile(entry / name, place / name)

        if not self._has(entry.name):
            self._store.put(entry.name, copy, {k: v for k, v in note.items() if k != "files"})

    def _has(self, key: str) -> bool:
        with contextlib.suppress(StoreError):
            return bool(read_note(self._store.entry(key), whole=True))
        return False


class Bucket:
    """A store behind a URL that fsspec knows, such as ``s3://bucket/path``."""

    def __init__(self, url: str) -> None:
        self._url = url.rstrip("/")

    def __str__(self) -> str:
        return self._url

    @functools.cached_property
    def _place(self) -> tuple[Any, str]:
        """The file system and the path in it; a job that finds all in its own store needs none."""
        import fsspec

        options = {"config_kwargs": PATIENCE} if self._url.startswith("s3://") else {}
        files, root = fsspec.core.url_to_fs(self._url, **options)
        files.retries = 1  # s3fs has its own beside botocore's
        return files, root

    def fetch(self, key: str, into: Path) -> bool:
        """See :class:`Other`."""
        files, root = self._place
        try:
            text = files.cat_file(f"{root}/{key}/{NOTE}")
        except FileNotFoundError:
            return False
        (into / NOTE).write_bytes(text)
        try:
            names = files_of(json.loads(text))
        except BAD as error:
            raise StoreError(f"{self}/{key} is damaged: {error}") from None
        for name in names:
            files.get_file(f"{root}/{key}/{name}", str(into / name))
        return True

    def give(self, entry: Path) -> None:
        """See :class:`Other`. The note comes last: without it there is no entry."""
        key, (files, root) = entry.name, self._place
        if not self._has(key):
            for name in (*read_note(entry)["files"], NOTE):
                files.put_file(str(entry / name), f"{root}/{key}/{name}")

    def _has(self, key: str) -> bool:
        with (
            tempfile.TemporaryDirectory() as place,
            contextlib.suppress(StoreError, FileNotFoundError),
        ):
            return self.fetch(key, Path(place)) and bool(read_note(Path(place), key, whole=True))
        return False


def others(strict: bool = True) -> list[Other]:
    """The other stores that the environment names.

    One that is no directory, can't be read, or is of a kind that nothing here can read raises a
    StoreError if `strict`; if not, it is said and left out, as on a node that lacks a disk.
    """
    found: list[Other] = []
    for name in filter(None, map(str.strip, os.environ.get(VARIABLE, "").split(","))):
        if (problem := _problem(name)) is None:
            found.append(Bucket(name) if "://" in name else SharedDirectory(Path(name).absolute()))
        elif strict:
            raise StoreError(problem)
        else:
            print(f"Not used: {problem}", file=sys.stderr)
    return found


def _problem(name: str) -> str | None:
    """Why a store of this name can't be used, without asking a network; or None."""
    if "://" in name:
        try:
            import fsspec

            fsspec.get_filesystem_class(name.partition("://")[0])
        except (ImportError, ValueError) as error:
            return f"the store {name} can't be used: {in_a_line(error)}"
    elif not Path(name).is_dir():
        return f"the store {name!r} is no directory: make it first"
    elif not os.access(name, os.R_OK | os.X_OK):
        return f"the store {name!r} can't be read"
    return None


def give_all(entry: Path, others: list[Other]) -> None:
    """Give a new entry to the other stores; what goes wrong there is said, and the result stays.

    What is out of reach leaves the list.
    """
    for other in list(others):
        try:
            other.give(entry)
        except Exception as error:  # of networks and buckets all sorts are raised
            print(f"Not kept in {other}: {in_a_line(error)}", file=sys.stderr)
            others.remove(other)
