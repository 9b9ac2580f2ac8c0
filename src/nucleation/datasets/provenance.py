"""Where a result comes from: what a dataset says of its parameters, code, sources and versions."""

import contextlib
import datetime
import hashlib
import importlib.metadata
import json
import os
import platform
from collections.abc import Mapping
from typing import Any

from .. import __version__
from .variables import DatasetError

PACKAGE = "nucleation"
NUMERICAL_LIBRARIES = ("numpy", "scipy", "numba")


def versions() -> dict[str, str]:
    """Versions of Python, of this package and of the libraries that results depend on.

    Those that are installed: the library needs no Snakemake.
    """
    libraries = (*NUMERICAL_LIBRARIES, "xarray", "netCDF4", "matplotlib", "snakemake")
    found = {}
    for library in libraries:
        with contextlib.suppress(importlib.metadata.PackageNotFoundError):
            found[library] = importlib.metadata.version(library)
    return {PACKAGE: __version__, "python": platform.python_version(), **found}


def fingerprint(parameters: Any, code_digest: str) -> str:
    """Digest of parameters (JSON-serialisable) and code, which tells whether a result is theirs."""
    text = json.dumps([parameters, code_digest], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def moment() -> datetime.datetime:
    """The time that results bear: now, or that of the environment's ``SOURCE_DATE_EPOCH``.

    Raises
    ------
    DatasetError
        If that is no number of seconds since 1970.
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
    sources: Mapping[str, Any] | None = None,
    key: str = "",
) -> dict[str, str]:
    """The attributes of a dataset that say how it was made (all of them text).

    Parameters
    ----------
    parameters : JSON-serialisable
        Everything from the configuration that the result depends on.
    code_digest : str
        From :func:`nucleation.pipeline.code.digest`.
    command : str
        A command that makes the dataset again.
    sources : mapping of role to keys
        What it is made from.
    key : str
        Of the dataset in the workflow (:func:`nucleation.pipeline.store.key`), if it is from there.
    """
    made = {
        "parameters": json.dumps(parameters, sort_keys=True),
        "code_digest": code_digest,
        "sources": json.dumps(dict(sources or {}), sort_keys=True),
        "versions": json.dumps(versions(), sort_keys=True),
        "command": command,
        "created": moment().isoformat(timespec="seconds"),
    }
    return made | ({"key": key} if key else {})
