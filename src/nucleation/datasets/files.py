"""Files that are written completely or not at all."""

import contextlib
import errno
import os
from collections.abc import Iterator
from pathlib import Path

_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


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
    """Raise the system's error if there is no room for a file.

    A library may report a full disk, a quota or a limit in words of its own. This function finds
    the system's reason. It enlarges the file.

    Parameters
    ----------
    path : Path
        The file; it is created if it is missing.
    size : int
        Required size in bytes.

    Raises
    ------
    OSError
        If the disk is full, or a quota or a limit of file sizes is exceeded.
    """
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT, 0o666)
    try:
        os.posix_fallocate(descriptor, 0, size)
    except OSError as error:
        if error.errno in _NO_ROOM:
            raise OSError(
                error.errno,
                os.strerror(error.errno),
                str(path),
            ) from None
    finally:
        os.close(descriptor)


def flush(path: Path) -> None:
    """Wait until the data of a file, or the entries of a directory, are on the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
