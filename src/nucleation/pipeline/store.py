"""Stores: finished results under their keys, written whole, renamed, never changed.

An entry is a directory ``KEY/`` with the files of one result, ``result.nc``, ``result.csv``, ...,
and ``entry.json``, which names its key and the size and digest of each file. The store of a
directory of results is ``store/`` in it, and results are made there. Others (:func:`others`) are
asked first: a shared directory, or a bucket.
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, Protocol

from ..datasets.files import flush
from .keys import content

NOTE = "entry.json"
STEM = "result"
"""Name of the files of an entry, before their suffix."""
ASIDE = "aside"
"""Where an entry goes that is not what its key says."""

VARIABLES = ("NUCLEATION_STORES", "SNAKEMAKE_OUTPUT_CACHE")
"""Environment variables that name further stores, separated by commas; the first that is set."""

Note = dict[str, Any]


class StoreError(ValueError):
    """A store that can't be used, or an entry that is damaged or foreign."""


class Other(Protocol):
    """A store elsewhere."""

    def fetch(self, key: str, into: Path) -> bool:
        """Copy the files of an entry into an empty directory; False if there is none."""

    def give(self, entry: Path) -> None:
        """Take a copy of an entry, whole or not at all, unless it is there already."""


def path_in(entry: Path, suffix: str) -> Path:
    """The file of an entry with a suffix such as ``.nc``."""
    return entry / f"{STEM}{suffix}"


def suffixes(note: Note) -> list[str]:
    """Suffixes of the files of an entry."""
    return [name.removeprefix(STEM) for name in note["files"]]


def read_note(entry: Path, key: str | None = None, whole: bool = False) -> Note:
    """What an entry says of itself, held against its key and its files.

    Parameters
    ----------
    entry : directory.
    key : which the entry must be of, if its name doesn't say.
    whole : whether to hold the bytes of each file against its digest, and not its size alone.

    Raises
    ------
    StoreError
        If it is damaged, or the entry of another key.
    """
    try:
        note = json.loads((entry / NOTE).read_text("utf-8"))
        if note["key"] != (key or entry.name):
            raise StoreError(f"{entry} holds the result of another key, {note['key']}")
        for name, file in note["files"].items():
            path = entry / name
            if os.path.basename(name) != name or path.stat().st_size != file["size"]:
                raise StoreError(f"{path} is damaged: it has not the size it was given")
            if whole and content(path) != file["sha256"]:
                raise StoreError(f"{path} is damaged: it is not what was written")
    except StoreError:
        raise
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise StoreError(f"{entry} is damaged: {error}") from None
    return dict(note)


class Store:
    """A store in a directory.

    Parameters
    ----------
    directory : which need not exist.
    """

    def __init__(self, directory: str | Path) -> None:
        self.directory = Path(directory)
        self._known: dict[str, Note | None] = {}

    def entry(self, key: str) -> Path:
        """Where the entry of a key is, or will be."""
        return self.directory / key

    def note(self, key: str) -> Note | None:
        """What the entry of a key says of itself; None without one that is right.

        It is looked at once. One that is not right is said, and not used.
        """
        if key not in self._known:
            self._known[key] = None
            if (self.entry(key) / NOTE).exists():
                try:
                    self._known[key] = read_note(self.entry(key))
                except StoreError as error:
                    print(f"Not used: {error}", file=sys.stderr)
        return self._known[key]

    def is_wrong(self, key: str) -> bool:
        """Whether there is an entry that is not right, at this moment."""
        try:
            return self.entry(key).exists() and not read_note(self.entry(key))
        except StoreError:
            return True

    def listed(self) -> list[str]:
        """Keys of all entries, right or not."""
        return [path.name for path in sorted(self.directory.glob("[0-9a-f]" * 16))]

    def put(self, key: str, make: Callable[[Path], None], about: Mapping[str, Any]) -> Note:
        """Make an entry: whole on the disk, or not at all.

        Parameters
        ----------
        key : of the result.
        make : writes its files into a directory.
        about : what else ``entry.json`` is to say.
        """
        self.directory.mkdir(parents=True, exist_ok=True)
        with self._unfinished() as place:
            make(place)
            files = {
                path.name: {"size": path.stat().st_size, "sha256": content(path)}
                for path in sorted(place.iterdir())
                if path.name != NOTE
            }
            note = {"key": key, "files": files, **about}
            (place / NOTE).write_text(json.dumps(note, indent=1, sort_keys=True) + "\n")
            self._publish(place, key)
        return note

    def take(self, key: str, others: list[Other]) -> str | None:
        """Copy an entry from the first of other stores that has it; its name, None if none has.

        What is damaged, foreign or out of reach is said in a line.
        """
        for other in others:
            self.directory.mkdir(parents=True, exist_ok=True)
            with self._unfinished() as place:
                try:
                    if other.fetch(key, place):
                        read_note(place, key, whole=True)
                        self._publish(place, key)
                        return str(other)
                except Exception as error:  # of networks and buckets all sorts are raised
                    print(f"Not taken from {other}: {_in_a_line(error)}", file=sys.stderr)
        return None

    @contextlib.contextmanager
    def _unfinished(self) -> Iterator[Path]:
        """A directory in the store that no key names; gone afterwards unless it was renamed."""
        place = Path(tempfile.mkdtemp(prefix=".", suffix=".tmp", dir=self.directory))
        try:
            yield place
        finally:
            shutil.rmtree(place, ignore_errors=True)

    def _publish(self, place: Path, key: str) -> None:
        """Give a finished directory its name; if another process was faster, its entry stays."""
        for path in place.iterdir():
            path.chmod(0o444)  # what opens it by a link in the results must not change it
            flush(path)
        place.chmod(0o755)
        flush(place)
        with contextlib.suppress(StoreError):
            read_note(self.entry(key))
            return
        self.set_aside(key)
        try:
            place.rename(self.entry(key))
        except OSError:
            if not self.entry(key).exists():  # else one has appeared this very moment
                raise
        flush(self.directory)
        self._known.pop(key, None)

    def set_aside(self, key: str) -> Path | None:
        """Move what is no right entry out of the way; where it is then."""
        if not os.path.lexists(self.entry(key)):
            return None
        (self.directory / ASIDE).mkdir(exist_ok=True)
        place = Path(tempfile.mkdtemp(prefix=f"{key}.", dir=self.directory / ASIDE))
        self.entry(key).rename(place / key)
        self._known.pop(key, None)
        return place / key

    def remove(self, key: str) -> None:
        """Remove an entry: its name first, so that half of one is never found."""
        gone = self.directory / f".{key}.removed.tmp"
        shutil.rmtree(gone, ignore_errors=True)  # left by a process that was killed here
        self.entry(key).rename(gone)
        shutil.rmtree(gone)


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
        """See :class:`Other`."""
        if os.access(self._store.directory, os.W_OK) and self._store.note(entry.name) is None:
            note = read_note(entry)

            def copy(place: Path) -> None:
                for name in note["files"]:
                    shutil.copyfile(entry / name, place / name)

            self._store.put(entry.name, copy, {k: v for k, v in note.items() if k != "files"})


class Bucket:
    """A store behind a URL that fsspec knows, such as ``s3://bucket/path``."""

    def __init__(self, url: str) -> None:
        import fsspec

        self._url = url.rstrip("/")
        self._files, self._root = fsspec.core.url_to_fs(self._url)

    def __str__(self) -> str:
        return self._url

    def fetch(self, key: str, into: Path) -> bool:
        """See :class:`Other`."""
        entry = f"{self._root}/{key}"
        if not self._files.exists(f"{entry}/{NOTE}"):
            return False
        note = self._files.cat_file(f"{entry}/{NOTE}")
        (into / NOTE).write_bytes(note)
        for name in json.loads(note)["files"]:
            self._files.get_file(f"{entry}/{os.path.basename(name)}", str(into / name))
        return True

    def give(self, entry: Path) -> None:
        """See :class:`Other`: the note comes last, and without it there is no entry."""
        target = f"{self._root}/{entry.name}"
        if not self._files.exists(f"{target}/{NOTE}"):
            for name in (*read_note(entry)["files"], NOTE):
                self._files.put_file(str(entry / name), f"{target}/{name}")


def others() -> list[Other]:
    """The other stores that the environment names.

    Raises
    ------
    StoreError
        If one is no directory, can't be read, or is of a kind that nothing here can read.
    """
    found: list[Other] = []
    text = next(filter(None, map(os.environ.get, VARIABLES)), "")
    for name in filter(None, map(str.strip, text.split(","))):
        if "://" in name:
            try:
                found.append(Bucket(name))
            except (ImportError, ValueError) as error:
                raise StoreError(f"the store {name} can't be used: {_in_a_line(error)}") from None
        elif not Path(name).is_dir():
            raise StoreError(f"the store {name!r} is no directory: make it first")
        elif not os.access(name, os.R_OK | os.X_OK):
            raise StoreError(f"the store {name!r} can't be read")
        else:
            found.append(SharedDirectory(Path(name).absolute()))
    return found


def give_all(entry: Path) -> None:
    """Give a new entry to the other stores; what goes wrong there is said, and the result stays."""
    for other in others():
        try:
            other.give(entry)
        except Exception as error:  # of networks and buckets all sorts are raised
            print(f"Not kept in {other}: {_in_a_line(error)}", file=sys.stderr)


def _in_a_line(error: Exception) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())
