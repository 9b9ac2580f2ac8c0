"""A result is its inputs: the key of what makes it, and the record beside it that vouches for it.

A key is a digest of parameters, code and the keys of what is read, so it is known before anything
is computed. Costly datasets bear it in their names (``simulations/NAME.KEY.nc``): another
parameter or other code is another file, and what exists under a key is used whatever it is called.
Files with plain names have a record in ``.made/`` beside the results: key and digest of the bytes.
Neither times of files nor Snakemake's notes take part.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..datasets.files import replacing

LENGTH = 16
"""Hexadecimal digits of a key: 64 bits, of which thousands of results never share one."""

KEYED = re.compile(rf"\.([0-9a-f]{{{LENGTH}}})\.nc$")
"""The end of a name that bears its key."""

PARTS = ("code", "parameters", "sources")
"""What makes a result."""

RECORDS = ".made"
"""Directory below the results with the records of files with plain names."""


def key(code: str, parameters: Any, sources: Mapping[str, Sequence[str]]) -> str:
    """The key of a result.

    Parameters
    ----------
    code : str
        From :func:`nucleation.pipeline.code.digest`.
    parameters : JSON-serialisable
        Everything from the configuration that the result depends on.
    sources : mapping of str to sequence of str
        Keys of what it is made from, by the role that it plays.
    """
    return joined(parts(code, parameters, sources))


def parts(code: str, parameters: Any, sources: Mapping[str, Sequence[str]]) -> dict[str, str]:
    """Digests of what makes a result: the arguments of :func:`key`, one by one."""
    return {
        name: hashlib.sha256(plain(values).encode()).hexdigest()
        for name, values in zip(PARTS, (code, parameters, sources), strict=True)
    }


def joined(digests: Mapping[str, str]) -> str:
    """The key of what makes a result, from :func:`parts`."""
    return hashlib.sha256(plain(dict(digests)).encode()).hexdigest()[:LENGTH]


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
    """The key in the name of a dataset, None if its name is a plain one."""
    found = KEYED.search(str(path))
    return found[1] if found else None


def content(path: str | Path) -> str:
    """Digest of a file's bytes."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


class Store:
    """The results of one directory, found by their keys and records.

    Parameters
    ----------
    results : directory of all results; paths below it are as users write them.
    """

    def __init__(self, results: str | Path) -> None:
        self.results = Path(os.path.normpath(results))  # as rules have it, a/../b as b
        self._found: dict[str, dict[str, str]] = {}

    def dataset(self, kind: str, name: str, wanted: str) -> str:
        """The path of a dataset that bears its key: where it is, or else where it will be.

        Whatever an existing file is called, its key decides.
        """
        own = f"{name}.{wanted}.nc"
        known = self._listed(kind)
        chosen = known.get(wanted, own)
        known.setdefault(wanted, own)
        return str(self.results / kind / chosen)

    def _listed(self, kind: str) -> dict[str, str]:
        """Names in a directory by their keys, looked up once."""
        if kind not in self._found:
            paths = sorted((self.results / kind).glob("[!.]*.nc"))
            self._found[kind] = {k: p.name for p in paths if (k := key_in(p))}
        return self._found[kind]

    def record_of(self, path: str | Path) -> Path:
        """Where the record of a file with a plain name is."""
        name = Path(path).relative_to(self.results)
        return self.results / RECORDS / f"{name}.json"

    def sign(self, path: str | Path, made: Mapping[str, str]) -> None:
        """Leave a record that a file was made by what :func:`parts` says."""
        with replacing(self.record_of(path)) as temporary:
            temporary.write_text(json.dumps({**made, "content": content(path)}, indent=1) + "\n")

    def key_of(self, path: str | Path) -> str | None:
        """The key that a file's record vouches for; None without a record that fits the file."""
        record = self._record(path)
        if record is None or record.pop("content") != content(path):
            return None
        return joined(record)

    def _record(self, path: str | Path) -> dict[str, str] | None:
        """What a file's record says: its parts and its content; None if it can't be told."""
        try:
            record = json.loads(self.record_of(path).read_text("utf-8"))
            return {name: record[name] for name in (*PARTS, "content")}
        except (OSError, ValueError, KeyError, TypeError):
            return None

    def problem(self, path: str | Path, wanted: Mapping[str, str]) -> str | None:
        """Why a file with a plain name is not what :func:`parts` says, or None if it is."""
        if not Path(path).is_file():
            return "it is missing"
        found = self._record(path)
        if found is None:
            return "nothing vouches for it: there is no record of how it was made"
        if found.pop("content") != content(path):
            return "it is not what was written"
        changed = [name for name, digest in wanted.items() if found[name] != digest]
        return f"its {' and '.join(changed)} changed" if changed else None
