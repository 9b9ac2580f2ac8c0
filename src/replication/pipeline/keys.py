"""Keys of results: digests of code, parameters and sources, known before the computation."""

import dataclasses
import hashlib
import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

LENGTH = 16  # hexadecimal digits: with 64 bits, thousands of results never share a key
PATTERN = rf"[0-9a-f]{{{LENGTH}}}"
_IN_NAME = re.compile(rf"\.({PATTERN})\.\w+$")
_IN_STORE = re.compile(rf"/({PATTERN})/[^/]+$")


def key(
    code: str,
    parameters: Mapping[str, Any],
    sources: Mapping[str, Sequence[str]],
) -> str:
    """The key of a result.

    Parameters
    ----------
    code : str
        Digest of its code.
    parameters : mapping
        All values of the configuration that it depends on.
    sources : mapping of role to keys
        Keys of the results that it is made from.

    Returns
    -------
    str
        Hexadecimal digits.
    """
    text = as_json([code, parameters, sources])
    return hashlib.sha256(text.encode()).hexdigest()[:LENGTH]


def as_json(values: Any, sort_keys: bool = True) -> str:
    """Write values as JSON, equal values as equal text; tuples become lists.

    Parameters
    ----------
    values : any
        Values of JSON, dataclasses, mappings and NumPy's numbers and arrays, nested.
    sort_keys : bool
        Whether mappings are sorted.

    Returns
    -------
    str
        The text.

    Raises
    ------
    TypeError
        If a value has no form in JSON.
    """
    return json.dumps(values, sort_keys=sort_keys, default=_converted)


def _converted(value: Any) -> Any:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return dataclasses.asdict(value)
    if hasattr(value, "items"):
        return dict(value.items())
    if hasattr(value, "tolist"):  # NumPy
        return value.tolist()
    raise TypeError(f"{value!r} can't be part of a key")


def key_in(path: str | Path) -> str | None:
    """The key in the path of a link or of a file in a store; None for any other file."""
    found = _IN_NAME.search(str(path)) or _IN_STORE.search(str(path))
    return found[1] if found else None


def key_of_file(path: str | Path) -> str:
    """The key of a source: the key in its path, or else the digest of its content."""
    key = key_in(path)
    if key is not None:
        return key
    return digest_of_file(path) if Path(path).is_file() else "missing"


def digest_of_file(path: str | Path) -> str:
    """Digest of a file's bytes."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
