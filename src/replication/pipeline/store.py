"""Stores: finished results under their keys, written completely, published by name, never changed.

The store of a directory of results is its subdirectory ``store/``; new results are made there.
A result is first looked for in the stores elsewhere, and each new result is copied to them. A
damaged or foreign entry is reported and not used.
"""

import contextlib
import json
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from nucleation.datasets.files import flush
from nucleation.datasets.variables import DatasetError

from .entries import NOTE, Note, mark_as_checked, may_have_changed, read_note
from .keys import LENGTH, digest_of_file
from .messages import LOGGER

ASIDE = "aside"
"""Directory in a store for entries that were wrong."""
VARIABLE = "NUCLEATION_STORES"
"""Environment variable with the directories of stores elsewhere, separated by commas."""


class Store:
    """A store in a directory, which need not exist."""

    def __init__(self, directory: str | Path) -> None:
        self.directory = Path(directory)
        self._known: dict[str, Note | None] = {}

    def entry(self, key: str) -> Path:
        """The directory of an entry, which need not exist."""
        return self.directory / key

    def note(self, key: str) -> Note | None:
        """The note of an entry; None if the entry is missing or wrong.

        It is read once and kept in memory. A wrong entry is reported. If a file may have changed
        since the entry was published, the bytes of all its files are checked.
        """
        if key not in self._known:
            self._known[key] = None
            if os.path.lexists(self.entry(key) / NOTE):
                try:
                    self._known[key] = self._checked_note(key)
                except DatasetError as error:
                    LOGGER.warning(f"Not used: {error}")
        return self._known[key]

    def _checked_note(self, key: str) -> Note:
        entry = self.entry(key)
        changed = may_have_changed(entry)
        note = read_note(entry, whole=changed)
        if changed:
            mark_as_checked(entry)
        return note

    def listed(self) -> list[str]:
        """Keys of all entries, right or wrong."""
        return [path.name for path in sorted(self.directory.glob("[0-9a-f]" * LENGTH))]

    def put(
        self,
        key: str,
        make: Callable[[Path], None],
        about: Mapping[str, Any],
    ) -> Note:
        """Make an entry; after a crash it is complete or missing.

        Parameters
        ----------
        key : str
            Key of the entry.
        make : callable
            Writes the files into the directory that it is called with.
        about : mapping
            Further values of the note.

        Returns
        -------
        dict
            The note.
        """
        with self._unfinished() as place:
            make(place)
            files = {}
            for path in sorted(place.iterdir()):
                if path.name != NOTE:
                    size = path.stat().st_size
                    files[path.name] = {
                        "size": size,
                        "sha256": digest_of_file(path),
                    }
            note = {"key": key, "files": files, **about}
            (place / NOTE).write_text(json.dumps(note, indent=1, sort_keys=True) + "\n")
            self._publish(place, key)
        return note

    def take(self, key: str, others: "list[Store]") -> Path | None:
        """Copy an entry from the first store elsewhere that has it.

        A damaged or foreign entry is reported and skipped. A store that is out of reach is reported
        and removed from the list.

        Parameters
        ----------
        key : str
            Key of the entry.
        others : list of Store
            Stores elsewhere, in the order in which they are tried.

        Returns
        -------
        Path or None
            Directory of the store with the entry; None if no store has it.
        """
        for other in list(others):
            try:
                if (other.entry(key) / NOTE).is_file():
                    self._copy(other.entry(key))
                    return other.directory
            except (OSError, DatasetError) as error:
                LOGGER.warning(f"Not taken from {other.directory}: {_in_a_line(error)}")
                if not isinstance(error, (DatasetError, FileNotFoundError)):
                    others.remove(other)
        return None

    def give(self, entry: Path) -> None:
        """Copy an entry of another store into this one, unless a right one is there already."""
        if not os.access(self.directory, os.W_OK):
            return
        with contextlib.suppress(DatasetError):
            read_note(self.entry(entry.name), whole=True)
            return
        self._copy(entry)

    def _copy(self, entry: Path) -> None:
        """Copy the note of another store's entry, and the files that it names."""
        with self._unfinished() as place:
            for name in (NOTE, *read_note(entry)["files"]):
                shutil.copyfile(entry / name, place / name)
                shutil.copystat(entry / name, place / name)  # keeps the time when it was made
            read_note(place, entry.name, whole=True)
            self._publish(place, entry.name)

    @contextlib.contextmanager
    def _unfinished(self) -> Iterator[Path]:
        """Yield a directory in the store without a key; it is removed unless it was renamed."""
        self.directory.mkdir(parents=True, exist_ok=True)
        place = Path(tempfile.mkdtemp(prefix=".", suffix=".tmp", dir=self.directory))
        try:
            yield place
        finally:
            shutil.rmtree(place, ignore_errors=True)

    def _publish(self, place: Path, key: str) -> None:
        """Rename a finished directory to its key; an entry of a faster process stays."""
        for path in place.iterdir():
            path.chmod(0o444)  # nobody may change it through a link in the results
            flush(path)
        place.chmod(0o755)
        flush(place)
        self._known.pop(key, None)
        try:
            place.rename(self.entry(key))
        except OSError:  # an entry exists
            with contextlib.suppress(DatasetError):
                read_note(self.entry(key), whole=True)
                return
            self.set_aside(key)
            try:
                place.rename(self.entry(key))
            except OSError:
                if self.note(key) is None:  # else another process has just published one
                    raise
        flush(self.directory)

    def set_aside(self, key: str) -> None:
        """Move a wrong entry out of the way."""
        if not os.path.lexists(self.entry(key)):
            return
        (self.directory / ASIDE).mkdir(exist_ok=True)
        place = Path(tempfile.mkdtemp(prefix=f"{key}.", dir=self.directory / ASIDE))
        self._known.pop(key, None)
        with contextlib.suppress(FileNotFoundError):  # another process was faster
            self.entry(key).rename(place / key)

    def refused(self, key: str, error: Exception) -> DatasetError:
        """Move a wrong entry out of the way, and make the error for the user.

        Parameters
        ----------
        key : str
            Key of the entry.
        error : Exception
            The reason.

        Returns
        -------
        DatasetError
            To be raised.
        """
        self.set_aside(key)
        return DatasetError(f"{error}. It was moved aside: run this again, and it is made again")

    def remove(self, key: str) -> None:
        """Remove an entry: its name first, so that no process finds half of it."""
        gone = self.directory / f".{key}.removed.tmp"
        shutil.rmtree(gone, ignore_errors=True)  # left by a process that was killed here
        self.entry(key).rename(gone)
        shutil.rmtree(gone)


def others(strict: bool = True) -> list[Store]:
    """The stores elsewhere, from the environment.

    Parameters
    ----------
    strict : bool
        Whether an unusable store is an error. If not, it is reported and left out, since a node of
        a cluster may lack a disk.

    Returns
    -------
    list of Store
        In the order of the environment.

    Raises
    ------
    DatasetError
        If one is not a readable directory and `strict` is set.
    """
    found: list[Store] = []
    for name in os.environ.get(VARIABLE, "").split(","):
        name = name.strip()
        if not name:
            continue
        if Path(name).is_dir() and os.access(name, os.R_OK | os.X_OK):
            found.append(Store(Path(name).absolute()))
            continue
        problem = f"the store {name!r} is no directory that can be read: make it first"
        if strict:
            raise DatasetError(problem)
        LOGGER.warning(f"Not used: {problem}")
    return found


def give_all(entry: Path, others: list[Store]) -> None:
    """Copy a new entry to the stores elsewhere.

    Parameters
    ----------
    entry : Path
        Directory of the entry.
    others : list of Store
        A store that is out of reach is reported and removed from this list.
    """
    for other in list(others):
        try:
            other.give(entry)
        except (OSError, DatasetError) as error:
            LOGGER.warning(f"Not kept in {other.directory}: {_in_a_line(error)}")
            others.remove(other)


def _in_a_line(error: Exception) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())
