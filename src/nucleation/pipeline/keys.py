"""A result is identified by its inputs: a key is a digest of code, parameters and sources.

It is known before anything is computed. :mod:`.store` keeps results under their keys, and links to
them bear the key in their names. Times of files play no part, nor do Snakemake's notes.
"""

import dataclasses
import hashlib
import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

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


def plain(values: Any) -> str:
    """Values as JSON, the same text for the same values; tuples and lists are the same."""
    return json.dumps(values, sort_keys=True, default=_plain_one)


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
