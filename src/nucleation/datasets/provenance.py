"""The origin of a result: parameters, code, sources and versions, as attributes of a dataset."""

import contextlib
import datetime
import importlib.metadata
import json
import os
import platform
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from .. import __version__
from . import DatasetError

STRUCTURES = {"parameters", "sources", "versions"}
"""Attributes that are JSON."""

_LIBRARIES = ("numpy", "scipy", "numba", "xarray", "netCDF4", "matplotlib", "snakemake")


def moment() -> datetime.datetime:
    """The creation time of results: now, or the environment's ``SOURCE_DATE_EPOCH``.

    Raises a DatasetError if ``SOURCE_DATE_EPOCH`` is not a number of seconds since 1970.
    """
    seconds = os.environ.get("SOURCE_DATE_EPOCH")
    if not seconds:
        return datetime.datetime.now(datetime.UTC)
    try:
        return datetime.datetime.fromtimestamp(int(seconds), datetime.UTC)
    except (ValueError, OverflowError, OSError):
        raise DatasetError(
            f"SOURCE_DATE_EPOCH = {seconds!r} is not allowed: the time of results must "
            "be a number of seconds since 1970, or be left out"
        ) from None


def attributes(
    parameters: Any,
    code_digest: str,
    command: str,
    sources: Mapping[str, Sequence[str]] | None = None,
    key: str = "",
) -> dict[str, str]:
    """Attributes that record how a dataset was made: with the `command` that makes it again.

    `parameters` are all values (for JSON) that it depends on, `sources` the keys of the results
    that it was made from, by role, and `key` its own in the workflow, if that made it.
    """
    made = {
        "parameters": json.dumps(parameters, sort_keys=True),
        "code_digest": code_digest,
        "sources": json.dumps(dict(sources or {}), sort_keys=True),
        "versions": _versions(),
        "command": command,
        "created": moment().isoformat(timespec="seconds"),
    }
    return made | ({"key": key} if key else {})


@cache
def _versions() -> str:
    """Versions of this package, of Python and of libraries, as JSON."""
    found = {"nucleation": __version__, "python": platform.python_version()}
    for library in _LIBRARIES:
        with contextlib.suppress(importlib.metadata.PackageNotFoundError):
            found[library] = importlib.metadata.version(library)
    return json.dumps(found, sort_keys=True)
