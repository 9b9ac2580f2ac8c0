"""A seal at the end of a file: digests of all that stands before it, and the file's attributes.

HDF5 trusts the bytes it is given: of some damages it searches for ever, of others it ends the
process. So every byte is held against the seal before HDF5 gets any of them. Readers of netCDF stop
where the file itself says that it ends, and do not see the seal. From it a file's attributes are
read a hundred times faster than through HDF5, which counts where thousands are planned with.

The bytes: the netCDF file, its attributes as JSON, and a last line of fixed length.
"""

import hashlib
import json
import os
from typing import Any, BinaryIO

MARK = "nucleation seal 1\n"
_LAST_LINE = "{file} {attributes} {size:012d} " + MARK
LENGTH = len(_LAST_LINE.format(file="0" * 64, attributes="0" * 64, size=0))
BLOCK = 2**20


def add(path: str | os.PathLike[str], attributes: dict[str, Any]) -> None:
    """Seal a finished file, whose attributes are plain values."""
    text = json.dumps(attributes, sort_keys=True).encode()
    with open(path, "r+b") as file:
        digest = _digest(file, os.fstat(file.fileno()).st_size)
        line = _LAST_LINE.format(file=digest, attributes=_of_text(digest, text), size=len(text))
        file.write(text + line.encode())


def attributes(path: str | os.PathLike[str]) -> dict[str, Any]:
    """The attributes in a file's seal; of all else in the file nothing is verified.

    Raises
    ------
    ValueError
        If the seal is damaged, or there is none.
    """
    with open(path, "rb") as file:
        return _seal(file)[1]


def verified(path: str | os.PathLike[str]) -> dict[str, Any]:
    """The attributes in a file's seal, once each byte of the file was found to be as written.

    Raises
    ------
    ValueError
        If one is not, or there is no seal.
    """
    with open(path, "rb") as file:
        digest, found, size = _seal(file)
        file.seek(0)
        if _digest(file, size) != digest:
            raise ValueError("its bytes are not those that were written")
    return found


def _seal(file: BinaryIO) -> tuple[str, dict[str, Any], int]:
    """The digest of the file before its seal, its attributes, and its size before the seal."""
    whole = os.fstat(file.fileno()).st_size
    file.seek(max(whole - LENGTH, 0))
    line = file.read()
    try:
        digest, of_text, count, mark = line.decode("ascii").split(" ", 3)
        size = whole - LENGTH - int(count)
        if len(line) != LENGTH or mark != MARK or size < 0:
            raise ValueError
    except ValueError:
        raise ValueError("it does not end in a seal") from None
    file.seek(size)
    text = file.read(int(count))
    if _of_text(digest, text) != of_text:
        raise ValueError("its seal is not what was written")
    return digest, json.loads(text), size


def _of_text(digest: str, text: bytes) -> str:
    """A digest of the seal's two parts, so that both or none are believed."""
    return hashlib.sha256(digest.encode() + text).hexdigest()


def _digest(file: BinaryIO, size: int) -> str:
    """Digest of a file's first bytes, which leaves the file at their end."""
    summary = hashlib.sha256()
    while size > 0 and (block := file.read(min(BLOCK, size))):
        summary.update(block)
        size -= len(block)
    return summary.hexdigest()
