"""Stores: finished results under their keys, written whole, renamed, never changed.

An entry is a directory ``KEY/`` with the files of one result, ``result.nc``, ``result.csv``, ...,
and ``entry.json``, which names its key and the size and digest of each file. The store of a
directory of results is ``store/`` in it, and results are made there. A key is a digest of
what identifies a result, code, parameters and sources, and known before anything is computed.
Stores elsewhere are asked first, and are given what was made; what is wrong there is said in a
line, and not taken.
"""

import contextlib
import dataclasses
import hashlib
import json
import os
import re
import shutil
import stat
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, BinaryIO

from ..datasets import seal
from ..datasets.files import flush

LENGTH = 16  # hexadecimal digits: 64 bits, of which thousands of results never share one
PATTERN = rf"[0-9a-f]{{{LENGTH}}}"
IN_NAME = re.compile(rf"\.({PATTERN})\.\w+$")  # the end of the name of a link
IN_STORE = re.compile(rf"/({PATTERN})/[^/]+$")  # and of the path of a file in a store


def key(code: str, parameters: Mapping[str, Any], sources: Mapping[str, Sequence[str]]) -> str:
    """The key of a result, from its code's digest and all that it depends on in the configuration.

    `sources` are the keys of what it is made from, by the role that each plays.
    """
    text = plain([code, parameters, sources])
    return hashlib.sha256(text.encode()).hexdigest()[:LENGTH]


def plain(values: Any, sort_keys: bool = True) -> str:
    """Values as JSON, the same text for the same values; tuples and lists are the same."""
    return json.dumps(values, sort_keys=sort_keys, default=_plain_one)


def _plain_one(value: Any) -> Any:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return dataclasses.asdict(value)
    if hasattr(value, "items"):
        return dict(value.items())
    if hasattr(value, "tolist"):  # of NumPy
        return value.tolist()
    raise TypeError(f"{value!r} can't be part of a key")


def key_in(path: str | Path) -> str | None:
    """The key that the path of a link or of a file in a store bears; None of any other file."""
    found = IN_NAME.search(str(path)) or IN_STORE.search(str(path))
    return found[1] if found else None


def of_file(path: str | Path) -> str:
    """The key of what is read: the one that its path bears, or else its content."""
    return key_in(path) or (content(path) if Path(path).is_file() else "missing")


def content(path: str | Path) -> str:
    """Digest of a file's bytes."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@contextlib.contextmanager
def _plain(path: Path, largest: int) -> Iterator[BinaryIO]:
    """A file open to be read, which must be a regular one, no link, of at most some bytes.

    Opening a pipe does not wait for somebody to write to it.
    """
    descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    with os.fdopen(descriptor, "rb") as file:
        found = os.fstat(descriptor)
        if not stat.S_ISREG(found.st_mode) or found.st_size > largest:
            raise StoreError(f"{path} is no regular file of at most {largest} bytes")
        yield file


NOTE = "entry.json"
LARGEST_NOTE = 2**20  # bytes of what an entry says of itself
STEM = "result"
"""Name of the files of an entry, before their suffix."""
FILE = re.compile(rf"{STEM}(\.\w+)+")
ASIDE = "aside"
"""Where an entry goes that is not what its key says."""
VARIABLE = "NUCLEATION_STORES"
"""Of the environment; it names directories of stores elsewhere, separated by commas."""

Note = dict[str, Any]


class StoreError(ValueError):
    """A store that can't be used, or an entry that is damaged or foreign."""


BAD = (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError)
"""What reading a note can end in, if anybody may have written it."""


def path_in(entry: Path, suffix: str) -> Path:
    """The file of an entry with a suffix such as ``.nc``."""
    return entry / f"{STEM}{suffix}"


def read_note(entry: Path, key: str | None = None, whole: bool = False) -> Note:
    """What an entry says of itself, held against its key (by its name, if none is given) and files.

    If `whole`, the bytes of each file are held against its digest, and not its size alone.

    Raises
    ------
    StoreError
        If it is damaged, or the entry of another key.
    """
    key = key or entry.name
    try:
        if entry.is_symlink():
            raise StoreError(f"{entry} is a link: nothing outside a store is followed")
        with _plain(entry / NOTE, LARGEST_NOTE) as stream:
            note = json.loads(stream.read())
        if note["key"] != key:
            raise StoreError(f"{entry} holds the result of another key, {note['key']}")
        if not note["files"]:
            raise StoreError(f"{entry} is damaged: it has no files")
        for name, file in note["files"].items():
            path = entry / name
            if not FILE.fullmatch(name):  # a plain one, which can't lead out of the entry
                raise StoreError(f"{name!r} is no name of a result's file")
            found = path.lstat()
            if not stat.S_ISREG(found.st_mode):
                raise StoreError(f"{path} is damaged: it is no regular file")
            if found.st_size != file["size"]:
                raise StoreError(f"{path} is damaged: it has not the size it was given")
            if whole and content(path) != file["sha256"]:
                raise StoreError(f"{path} is damaged: it is not what was written")
            if whole and path.suffix == ".nc" and seal.attributes(path).get("key") != key:
                raise StoreError(f"{path} is the result of another key")
    except StoreError:
        raise
    except BAD as error:
        raise StoreError(f"{entry} is damaged: {error}") from None
    return dict(note)


def _may_have_changed(entry: Path) -> bool:
    """Whether a file of an entry was changed after the entry was given its name, or was copied.

    By the times of inodes: no program can set these, and they are cheap to ask for. Only a disk
    that fails changes a file and not them; ``check`` reads every byte.
    """
    try:
        named = entry.lstat().st_ctime_ns
        return any(path.lstat().st_ctime_ns >= named for path in entry.iterdir())
    except OSError:
        return True


def _mark_as_whole(entry: Path) -> None:
    """Make the inode of an entry newer than those of its files, which were found to be right."""
    times = entry.stat()
    with contextlib.suppress(OSError):  # of somebody else: it is read again the next time
        os.utime(entry, ns=(times.st_atime_ns, times.st_mtime_ns))


class Store:
    """A store in a directory, which need not exist."""

    def __init__(self, directory: str | Path) -> None:
        self.directory = Path(directory)
        self._known: dict[str, Note | None] = {}

    def entry(self, key: str) -> Path:
        """Where the entry of a key is, or will be."""
        return self.directory / key

    def note(self, key: str) -> Note | None:
        """What the entry of a key says of itself; None without one that is right.

        It is looked at once. One that is not right is said, and not used. If a file may have been
        changed since the entry was made, its bytes are read.
        """
        if key not in self._known:
            self._known[key] = None
            entry = self.entry(key)
            if os.path.lexists(entry / NOTE):
                try:
                    changed = _may_have_changed(entry)
                    self._known[key] = read_note(entry, whole=changed)
                    if changed:
                        _mark_as_whole(entry)
                except StoreError as error:
                    print(f"Not used: {error}", file=sys.stderr)
        return self._known[key]

    def listed(self) -> list[str]:
        """Keys of all entries, right or not."""
        return [path.name for path in sorted(self.directory.glob("[0-9a-f]" * 16))]

    def put(self, key: str, make: Callable[[Path], None], about: Mapping[str, Any]) -> Note:
        """Make an entry, whole on the disk or not at all, of the files that `make` writes.

        `about` is what else ``entry.json`` is to say.
        """
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

    def take(self, key: str, others: "list[Store]") -> Path | None:
        """Copy an entry from the first of other stores that has it; which one, None if none has.

        What is damaged, foreign or out of reach is said in a line; what is out of reach leaves the
        list.
        """
        for other in list(others):
            try:
                if (other.entry(key) / NOTE).is_file():
                    self._copy(other.entry(key))
                    return other.directory
            except (OSError, StoreError) as error:
                print(f"Not taken from {other.directory}: {_in_a_line(error)}", file=sys.stderr)
                if not isinstance(error, (StoreError, FileNotFoundError)):
                    others.remove(other)
        return None

    def give(self, entry: Path) -> None:
        """Take a copy of another store's entry, whole or not at all, unless it is there already."""
        if not os.access(self.directory, os.W_OK):
            return
        with contextlib.suppress(StoreError):
            read_note(self.entry(entry.name), whole=True)
            return
        self._copy(entry)

    def _copy(self, entry: Path) -> None:
        """Copy the files of another store's entry, as its note names them, and the note."""
        with self._unfinished() as place:
            for name in (NOTE, *read_note(entry)["files"]):
                shutil.copyfile(entry / name, place / name)
                shutil.copystat(entry / name, place / name)  # made when it was made there
            read_note(place, entry.name, whole=True)
            self._publish(place, entry.name)

    @contextlib.contextmanager
    def _unfinished(self) -> Iterator[Path]:
        """A directory in the store that no key names; gone afterwards unless it was renamed."""
        self.directory.mkdir(parents=True, exist_ok=True)
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
        self._known.pop(key, None)
        try:
            place.rename(self.entry(key))
        except OSError:  # there is one
            with contextlib.suppress(StoreError):
                read_note(self.entry(key), whole=True)
                return
            self.set_aside(key)
            try:
                place.rename(self.entry(key))
            except OSError:
                if self.note(key) is None:  # else one has appeared this very moment
                    raise
        flush(self.directory)

    def set_aside(self, key: str) -> None:
        """Move what is no right entry out of the way."""
        if not os.path.lexists(self.entry(key)):
            return
        (self.directory / ASIDE).mkdir(exist_ok=True)
        place = Path(tempfile.mkdtemp(prefix=f"{key}.", dir=self.directory / ASIDE))
        self._known.pop(key, None)
        with contextlib.suppress(FileNotFoundError):  # if another process was faster
            self.entry(key).rename(place / key)

    def refused(self, key: str, error: Exception) -> StoreError:
        """Move an entry aside that can't be used; the error that says so."""
        self.set_aside(key)
        return StoreError(f"{error}. It was moved aside: run this again, and it is made again")

    def remove(self, key: str) -> None:
        """Remove an entry: its name first, so that half of one is never found."""
        gone = self.directory / f".{key}.removed.tmp"
        shutil.rmtree(gone, ignore_errors=True)  # left by a process that was killed here
        self.entry(key).rename(gone)
        shutil.rmtree(gone)


def others(strict: bool = True) -> list[Store]:
    """The stores elsewhere that the environment names.

    One that is no directory or can't be read raises a StoreError if `strict`; if not, it is said
    and left out, as on a node that lacks a disk.
    """
    found: list[Store] = []
    for name in filter(None, map(str.strip, os.environ.get(VARIABLE, "").split(","))):
        problem = f"the store {name!r} is no directory that can be read: make it first"
        if Path(name).is_dir() and os.access(name, os.R_OK | os.X_OK):
            found.append(Store(Path(name).absolute()))
        elif strict:
            raise StoreError(problem)
        else:
            print(f"Not used: {problem}", file=sys.stderr)
    return found


def give_all(entry: Path, others: list[Store]) -> None:
    """Give a new entry to other stores; one that is out of reach is said, and leaves the list."""
    for other in list(others):
        try:
            other.give(entry)
        except (OSError, StoreError) as error:
            print(f"Not kept in {other.directory}: {_in_a_line(error)}", file=sys.stderr)
            others.remove(other)


def _in_a_line(error: Exception) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())
