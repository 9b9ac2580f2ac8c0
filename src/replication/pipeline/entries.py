"""Entries of a store: directories ``KEY/`` with the files of one result and a note on them.

The files are ``result.nc``, ``result.csv``, and so on. The note ``entry.json`` holds the key, and
the size and digest of each file.
"""

import contextlib
import json
import os
import re
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

from nucleation.datasets import seal
from nucleation.datasets.variables import DatasetError

from .keys import digest_of_file

NOTE = "entry.json"
_LARGEST_NOTE = 2**20  # bytes
STEM = "result"
"""Name of the files of an entry, before their suffix."""
_FILE = re.compile(rf"{STEM}(\.\w+)+")

Note = dict[str, Any]


BAD = (
    OSError,
    ValueError,
    KeyError,
    TypeError,
    AttributeError,
    RecursionError,
)
"""Errors that reading a note can raise, since anybody may have written it."""


def path_in(entry: Path, suffix: str) -> Path:
    """The file of an entry.

    Parameters
    ----------
    entry : Path
        Directory of the entry.
    suffix : str
        Such as ``.nc``.

    Returns
    -------
    Path
        The file, which need not exist.
    """
    return entry / f"{STEM}{suffix}"


def read_note(entry: Path, key: str | None = None, whole: bool = False) -> Note:
    """Read the note of an entry, and compare it with the key and the files.

    Parameters
    ----------
    entry : Path
        Directory of the entry.
    key : str, optional
        The expected key; by default the directory's name.
    whole : bool
        Whether the digest of each file is compared, and not only its size.

    Returns
    -------
    dict
        The note.

    Raises
    ------
    DatasetError
        If the entry is damaged or has another key.
    """
    key = key or entry.name
    try:
        note = _parsed_note(entry)
        if note["key"] != key:
            raise DatasetError(f"{entry} holds the result of another key, {note['key']}")
        if not note["files"]:
            raise DatasetError(f"{entry} is damaged: it has no files")
        for name, file in note["files"].items():
            _check_file(entry, name, file["size"])
            if whole:
                _check_content(entry / name, file["sha256"], key)
    except DatasetError:
        raise
    except BAD as error:
        raise DatasetError(f"{entry} is damaged: {error}") from None
    return dict(note)


def _parsed_note(entry: Path) -> Any:
    if entry.is_symlink():
        raise DatasetError(f"{entry} is a link: no link out of a store is followed")
    with _regular_file(entry / NOTE, _LARGEST_NOTE) as stream:
        return json.loads(stream.read())


def _check_file(entry: Path, name: str, size: int) -> None:
    path = entry / name
    if not _FILE.fullmatch(name):  # a plain name, which can't lead out of the entry
        raise DatasetError(f"{name!r} is no name of a result's file")
    found = path.lstat()
    if not stat.S_ISREG(found.st_mode):
        raise DatasetError(f"{path} is damaged: it is no regular file")
    if found.st_size != size:
        raise DatasetError(f"{path} is damaged: it does not have its original size")


def _check_content(path: Path, digest: str, key: str) -> None:
    if digest_of_file(path) != digest:
        raise DatasetError(f"{path} is damaged: it differs from the file that was written")
    if path.suffix == ".nc" and seal.attributes(path).get("key") != key:
        raise DatasetError(f"{path} is the result of another key")


@contextlib.contextmanager
def _regular_file(path: Path, largest: int) -> Iterator[BinaryIO]:
    """Open a file to read it; refuse a link, a device, a pipe, and more bytes than `largest`.

    Opening a pipe does not block here.
    """
    descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    with os.fdopen(descriptor, "rb") as file:
        found = os.fstat(descriptor)
        if not stat.S_ISREG(found.st_mode) or found.st_size > largest:
            raise DatasetError(f"{path} is no regular file of at most {largest} bytes")
        yield file


def may_have_changed(entry: Path) -> bool:
    """Whether a file of an entry may have changed after the entry was published, or was copied.

    The times of inodes tell: no program can set them, and they are cheap to read. Only a failing
    disk changes a file without them; ``check`` reads every byte.
    """
    try:
        published = entry.lstat().st_ctime_ns
        return any(path.lstat().st_ctime_ns >= published for path in entry.iterdir())
    except OSError:
        return True


def mark_as_checked(entry: Path) -> None:
    """Make the inode of an entry newer than those of its files, which were found to be right."""
    times = entry.stat()
    with contextlib.suppress(OSError):  # another user's: it is read again the next time
        os.utime(entry, ns=(times.st_atime_ns, times.st_mtime_ns))
