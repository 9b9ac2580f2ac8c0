"""Files that are written completely or not at all, and a seal by which damage is noticed.

HDF5 trusts its input: some damaged files make it search for ever, others end the process. So all
bytes are compared with the seal before HDF5 reads any of them. Readers of netCDF stop at the end
that the file itself declares, and do not see the seal. Attributes are read from the seal a hundred
times faster than through HDF5. The order of bytes: the netCDF file, its attributes as JSON, and a
last line of fixed length.
"""

import contextlib
import errno
import hashlib
import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
_MARK = "nucleation seal 1\n"
_LENGTH = 64 + 1 + 64 + 1 + 12 + 1 + len(_MARK)  # of the last line: two digests, a size, the mark
_BLOCK = 2**20


@contextlib.contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield a temporary path to write to; the file replaces `path` once it is on the disk."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        yield temporary
        flush(temporary)
        os.replace(temporary, path)
        flush(path.parent)
    finally:
        temporary.unlink(missing_ok=True)


def refuse_pipe(path: str | os.PathLike[str]) -> None:
    """Raise OSError for a named pipe, which may block; a shell's own ones, in /dev, have data."""
    if Path(path).is_fifo() and not os.fspath(path).startswith("/dev/"):
        raise OSError(errno.EINVAL, "it is a pipe and no file")


def require_room(path: Path, size: int) -> None:
    """Raise the system's error if a disk, a quota or a limit has no room for `size` bytes.

    A library may report it in words of its own. The file is enlarged, and made if it is missing.
    """
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT, 0o666)
    try:
        os.posix_fallocate(descriptor, 0, size)
    except OSError as error:
        if error.errno in _NO_ROOM:
            raise OSError(error.errno, os.strerror(error.errno), str(path)) from None
    finally:
        os.close(descriptor)


def flush(path: Path) -> None:
    """Wait until the data of a file, or the entries of a directory, are on the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def seal(path: str | os.PathLike[str], attributes: dict[str, Any]) -> None:
    """Seal a finished file, with attributes that JSON can hold."""
    text = json.dumps(attributes, sort_keys=True).encode()
    with open(path, "r+b") as file:
        digest = _digest(file, os.fstat(file.fileno()).st_size)
        line = f"{digest} {_digest_of_text(digest, text)} {len(text):012d} {_MARK}"
        file.write(text + line.encode())


def sealed(path: str | os.PathLike[str], whole: bool = True) -> dict[str, Any]:
    """The attributes in a file's seal, which is compared with all bytes of the file if `whole`.

    Raises ValueError if the file or its seal is damaged, or the seal is missing.
    """
    with open(path, "rb") as file:
        length = os.fstat(file.fileno()).st_size
        file.seek(max(length - _LENGTH, 0))
        line = file.read()
        try:
            digest, digest_of_text, count, mark = line.decode("ascii").split(" ", 3)
            size = length - _LENGTH - int(count)
            if len(line) != _LENGTH or mark != _MARK or size < 0:
                raise ValueError
        except ValueError:
            raise ValueError("it does not end in a seal") from None
        file.seek(size)
        text = file.read(int(count))
        if _digest_of_text(digest, text) != digest_of_text:
            raise ValueError("it differs from the file that was written")
        file.seek(0)
        if whole and _digest(file, size) != digest:
            raise ValueError("its bytes are not those that were written")
        return dict(json.loads(text))


def _digest_of_text(digest: str, text: bytes) -> str:
    """Digest of both parts of the seal, so that a change of either is noticed."""
    return hashlib.sha256(digest.encode() + text).hexdigest()


def _digest(file: BinaryIO, size: int) -> str:
    """Digest of the first `size` bytes; the file's position is then behind them."""
    summary = hashlib.sha256()
    while size > 0 and (block := file.read(min(_BLOCK, size))):
        summary.update(block)
        size -= len(block)
    return summary.hexdigest()
