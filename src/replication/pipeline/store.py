"""Stores: finished results under their keys, written completely, published by name, never changed.

An entry is a directory ``KEY/`` with the files of a result (``result.nc``, ``result.csv``, ...) and
a note with the key and each file's size and digest. The store of a directory of results is its
subdirectory ``store/``. A damaged or foreign entry is reported, not used, and renamed once it is
made again. Stores elsewhere are asked first, and given each new result.
"""

import contextlib
import errno
import hashlib
import json
import os
import re
import shutil
import stat
import uuid
from collections.abc import Callable, Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

from nucleation.datasets import DatasetError
from nucleation.datasets.files import flush, sealed

from . import LOGGER

NOTE = "entry.json"
STEM = "result"  # of the files of an entry
DAMAGED = "damaged-"  # begins the names of entries that were wrong
VARIABLE = "NUCLEATION_STORES"
"""Environment variable with the directories of stores elsewhere, separated by commas."""
PATTERN = r"[0-9a-f]{16}"  # of a key: with 64 bits, thousands of results never share one
_FILE = re.compile(rf"{STEM}(\.\w+)+")
_LARGEST_NOTE = 2**20  # bytes


def digest_of_file(path: str | Path) -> str:
    """Digest of a file's bytes."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def read_note(
    entry: Path, key: str = "", whole: bool = False, names: Collection[str] = ()
) -> dict[str, Any]:
    """Read the note of an entry, and compare it with the key (by default the entry's name).

    It must have the files `names`. Sizes of files are compared too, and with `whole` all bytes.
    Raises DatasetError, whose text has nothing of the note, as anybody may have written it.
    """
    key = key or entry.name
    try:
        note = json.loads(_regular(entry / NOTE, 1, _LARGEST_NOTE).read_bytes())
        files = note["files"]
        if note["key"] != key:
            raise DatasetError(f"{entry} holds the result of another key")
        plain = all(_FILE.fullmatch(name) for name in files)  # none leads out of the entry
        if entry.is_symlink() or not files or not plain:
            raise DatasetError(f"{entry} is damaged: it is a link, or its note names other files")
        if not files.keys() >= set(names):
            raise DatasetError(f"{entry} is damaged: it lacks files of the result")
        for name, about in files.items():
            path = _regular(entry / name, about["size"], about["size"])
            if whole and digest_of_file(path) != about["sha256"]:
                raise DatasetError(f"{path} is damaged: it differs from the file that was written")
            if whole and path.suffix == ".nc" and sealed(path, whole=False).get("key") != key:
                raise DatasetError(f"{path} is the result of another key")
    except DatasetError:
        raise
    except OSError as error:
        raise DatasetError(f"{entry} is damaged: {error}") from None
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise DatasetError(f"{entry} is damaged: its note can't be read") from None
    return dict(note)


def _regular(path: Path, smallest: int, largest: int) -> Path:
    """The path of a regular file, which can't block, of a size (bytes) in this range."""
    found = path.lstat()
    if not stat.S_ISREG(found.st_mode) or not smallest <= found.st_size <= largest:
        raise DatasetError(f"{path} is damaged: it does not have its original size")
    return path


def is_right(entry: Path, names: Collection[str] = ()) -> bool:
    """Whether all bytes of an entry are those that were written."""
    try:
        read_note(entry, whole=True, names=names)
    except DatasetError:
        return False
    return True


def _newest(entry: Path) -> int:
    """The newest time (ns) at which the inode of a file in an entry changed; no program sets it."""
    return max((path.lstat().st_ctime_ns for path in entry.iterdir()), default=0)


def _mark(entry: Path, newest: int) -> None:
    """Note in the time of an entry that its bytes are right, if it is not another user's.

    It is another time after any file was made or removed there.
    """
    with contextlib.suppress(OSError):
        os.utime(entry, ns=(newest, newest))


class Store:
    """A store in a directory, which need not exist."""

    def __init__(self, directory: str | Path) -> None:
        self.directory = Path(directory)
        self._known: dict[str, bool] = {}

    def entry(self, key: str) -> Path:
        """The directory of an entry, which need not exist."""
        return self.directory / key

    def has(self, key: str, names: Collection[str] = ()) -> bool:
        """Whether there is a right entry that has these files; a wrong one is reported once.

        All bytes are read if a file may have changed since that was done.
        """
        entry = self.entry(key)
        if key in self._known or not os.path.lexists(entry):
            return self._known.get(key, False)
        try:
            newest = _newest(entry)
            changed = entry.lstat().st_mtime_ns != newest
            read_note(entry, whole=changed, names=names)
            if changed:
                _mark(entry, newest)
            self._known[key] = True
        except (OSError, DatasetError) as error:
            self._known[key] = False
            LOGGER.warning(f"Not used: {error}")
        return self._known[key]

    def listed(self) -> list[str]:
        """Keys of all entries, right or wrong."""
        return [path.name for path in sorted(self.directory.glob("[0-9a-f]" * 16))]

    def put(self, key: str, make: Callable[[Path], None], about: Mapping[str, Any]) -> None:
        """Make an entry by a function that writes its files into a directory.

        `about` has further values of the note.
        """
        with self._new(key) as place:
            make(place)
            files = {}
            for path in place.iterdir():
                files[path.name] = {"size": path.stat().st_size, "sha256": digest_of_file(path)}
            note = {"key": key, "files": files, **about}
            (place / NOTE).write_text(json.dumps(note, indent=1, sort_keys=True) + "\n")

    def take(self, key: str, names: Collection[str], others: "list[Store]") -> Path | None:
        """Copy an entry from the first store elsewhere that has it right; return that store.

        A store that is out of reach is reported and removed from the list.
        """
        for other in list(others):
            with _reported("taken from", other, others):
                if os.path.lexists(other.entry(key) / NOTE):
                    self._copy(other.entry(key), names)
                    return other.directory
        return None

    def give(self, key: str, others: "list[Store]") -> None:
        """Copy an entry to the stores elsewhere that lack it.

        One that is out of reach is reported and removed from the list.
        """
        for other in list(others):
            with _reported("kept in", other, others):
                if os.access(other.directory, os.W_OK) and not is_right(other.entry(key)):
                    other._copy(self.entry(key), ())

    def _copy(self, entry: Path, names: Collection[str]) -> None:
        """Copy the note of another store's entry, and the files that it names, once checked."""
        files = read_note(entry, whole=True, names=names)["files"]
        with self._new(entry.name) as place:
            for name in (NOTE, *files):
                shutil.copyfile(entry / name, place / name)
                made = (entry / name).stat().st_mtime_ns
                os.utime(place / name, ns=(made, made))
            read_note(place, entry.name, whole=True)

    @contextlib.contextmanager
    def _new(self, key: str) -> Iterator[Path]:
        """Yield a directory, and rename it to the key once its files are written.

        A right entry of a faster process stays. After a crash an entry is complete or missing.
        """
        place = self.directory / f".{uuid.uuid4().hex}.tmp"
        place.mkdir(parents=True)
        try:
            yield place
            names = {path.name for path in place.iterdir()} - {NOTE}
            for path in place.iterdir():
                path.chmod(path.stat().st_mode & 0o444)  # nobody changes it through a link
                flush(path)
            _mark(place, _newest(place))
            flush(place)
            if os.path.lexists(self.entry(key)) and not is_right(self.entry(key), names):
                self.set_aside(key)
            try:
                place.rename(self.entry(key))
            except OSError:  # an entry exists
                if not is_right(self.entry(key), names):
                    raise
            self._known.pop(key, None)
            flush(self.directory)
        finally:
            shutil.rmtree(place, ignore_errors=True)

    def set_aside(self, key: str) -> None:
        """Rename a wrong entry; its owner may be another user."""
        self._known.pop(key, None)
        with contextlib.suppress(FileNotFoundError):  # another process was faster
            self.entry(key).rename(self.directory / f"{DAMAGED}{key}-{uuid.uuid4().hex[:8]}")

    def remove(self, key: str) -> None:
        """Remove an entry: its name first, so that no process finds half of it."""
        entry = self.entry(key)
        if entry.is_dir() and not os.access(entry, os.W_OK):
            raise PermissionError(errno.EACCES, "it is another user's")
        gone = entry.rename(self.directory / f".{key}-{uuid.uuid4().hex[:8]}.tmp")
        if gone.is_symlink() or not gone.is_dir():
            gone.unlink()
        else:
            shutil.rmtree(gone)


@contextlib.contextmanager
def _reported(done: str, other: Store, others: list[Store]) -> Iterator[None]:
    """Report what can't be done with a store; one that is out of reach is removed from the list."""
    try:
        yield
    except (OSError, DatasetError) as error:
        reason = " ".join(f"{type(error).__name__}: {error}".split())
        LOGGER.warning(f"Not {done} {other.directory}: {reason}")
        if not isinstance(error, (DatasetError, FileNotFoundError)):
            others.remove(other)


def others(strict: bool = True) -> list[Store]:
    """The stores elsewhere, from the environment.

    One that is no readable directory raises DatasetError, or without `strict` is left out: a node
    of a cluster may lack a disk.
    """
    found = []
    for name in filter(None, map(str.strip, os.environ.get(VARIABLE, "").split(","))):
        if Path(name).is_dir() and os.access(name, os.R_OK | os.X_OK):
            found.append(Store(Path(name).absolute()))
            continue
        problem = f"the store {name!r} is no directory that can be read: make it first"
        if strict:
            raise DatasetError(problem)
        LOGGER.warning(f"Not used: {problem}")
    return found
