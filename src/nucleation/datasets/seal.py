"""A seal at the end of a file: digests of all bytes before it, and the file's attributes.

HDF5 trusts its input: some damaged files make it search for ever, others end the process. So all
bytes are compared with the seal before HDF5 reads any of them. Readers of netCDF stop at the end
that the file itself declares, and do not see the seal. Attributes are read from the seal a hundred
times faster than through HDF5.

The order of bytes: the netCDF file, its attributes as JSON, and a last line of fixed length.
"""

import hashlib
import json
import os
from typing import Any, BinaryIO, NamedTuple

MARK = "nucleation seal 1\n"
_LAST_LINE = "{file} {attributes} {size:012d} " + MARK
LENGTH = len(
    _LAST_LINE.format(
        file="0" * 64,
        attributes="0" * 64,
        size=0,
    )
)
_BLOCK = 2**20


class _Seal(NamedTuple):
    digest: str  # of the file before the seal
    attributes: dict[str, Any]
    size: int  # bytes before the seal


def add(path: str | os.PathLike[str], attributes: dict[str, Any]) -> None:
    """Seal a finished file.

    Parameters
    ----------
    path : path
        The file.
    attributes : dict
        Values that JSON can hold.
    """
    text = json.dumps(attributes, sort_keys=True).encode()
    with open(path, "r+b") as file:
        digest = _digest(file, os.fstat(file.fileno()).st_size)
        line = _LAST_LINE.format(
            file=digest,
            attributes=_digest_of_text(digest, text),
            size=len(text),
        )
        file.write(text + line.encode())


def attributes(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Read the attributes from a file's seal, without a check of the other bytes.

    Raises
    ------
    ValueError
        If the seal is damaged or missing.
    """
    with open(path, "rb") as file:
        return _read(file).attributes


def verified(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Read the attributes from a file's seal, and compare all bytes of the file with the seal.

    Raises
    ------
    ValueError
        If the file or its seal is damaged, or the seal is missing.
    """
    with open(path, "rb") as file:
        seal = _read(file)
        file.seek(0)
        if _digest(file, seal.size) != seal.digest:
            raise ValueError("its bytes are not those that were written")
    return seal.attributes


def _read(file: BinaryIO) -> _Seal:
    length = os.fstat(file.fileno()).st_size
    file.seek(max(length - LENGTH, 0))
    line = file.read()
    try:
        digest, digest_of_text, count, mark = line.decode("ascii").split(" ", 3)
        size = length - LENGTH - int(count)
        if len(line) != LENGTH or mark != MARK or size < 0:
            raise ValueError
    except ValueError:
        raise ValueError("it does not end in a seal") from None
    file.seek(size)
    text = file.read(int(count))
    if _digest_of_text(digest, text) != digest_of_text:
        raise ValueError("it differs from the file that was written")
    return _Seal(digest, json.loads(text), size)


def _digest_of_text(digest: str, text: bytes) -> str:
    """Digest of both parts of the seal, so that a change of either is noticed."""
    return hashlib.sha256(digest.encode() + text).hexdigest()


def _digest(file: BinaryIO, size: int) -> str:
    """Digest of the first `size` bytes; the file's position is then behind them."""
    summary = hashlib.sha256()
    while size > 0:
        block = file.read(min(_BLOCK, size))
        if not block:
            break
        summary.update(block)
        size -= len(block)
    return summary.hexdigest()
