"""Datasets by their keys, kept for other checkouts and users, and for what Snakemake discards.

An entry is a file ``KEY.nc``. It is handed out only if it is whole and of the key that was asked
for; whatever is wrong with the cache, a result is never lost by it.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import sys
from pathlib import Path

from ..datasets import netcdf
from ..datasets.files import replacing
from ..datasets.variables import DatasetError
from . import keys

VARIABLE = "SNAKEMAKE_OUTPUT_CACHE"
"""Environment variable that names the shared directory; without it there is none."""

KEPT = ".kept"
"""Directory below the results with datasets of the present run of the workflow, by key.

Snakemake removes what it takes for the result of a failed job, such as that of a job's partner.
"""


def shared() -> Path | None:
    """The directory of the shared cache, if the environment names one."""
    text = os.environ.get(VARIABLE, "")
    return Path(text) if text else None


def problem(directory: Path) -> str | None:
    """Why a shared cache can't be used at all, or None."""
    if not directory.is_dir():
        return f"{VARIABLE} = {str(directory)!r} is not allowed: it is no directory; make it first"
    if not os.access(directory, os.R_OK | os.X_OK):
        return f"{VARIABLE} = {str(directory)!r} is not allowed: it can't be read"
    return None


def warning(directory: Path) -> str | None:
    """What a user of a shared cache should know before the first job, or None."""
    if not os.access(directory, os.W_OK):
        return f"{VARIABLE} = {directory} is not writable: results are taken from it, none are kept"
    return None


def fetch(directory: Path, wanted: str, output: Path) -> bool:
    """Put the entry of a key in place of a job's output; False if there is none that is right.

    A damaged or foreign entry is said, and removed where that is allowed.
    """
    entry = directory / f"{wanted}.nc"
    if not entry.is_file():
        return False
    if not os.access(entry, os.R_OK):
        print(f"The cache's entry {entry} can't be read: it is left alone", file=sys.stderr)
        return False
    try:
        found = netcdf.read(entry).attrs.get("key")
        if found != wanted:
            raise DatasetError(f"{entry} is the result of another key, {found}")
    except DatasetError as error:
        print(f"The cache's entry is removed and computed again: {error}", file=sys.stderr)
        with contextlib.suppress(OSError):
            entry.unlink()
        return False
    with replacing(output) as temporary:
        shutil.copyfile(entry, temporary)
    return True


def keep(directory: Path, made: str, result: Path) -> None:
    """Keep a result under its key; what goes wrong is said, and the result stays."""
    entry = directory / f"{made}.nc"
    try:
        if not entry.exists():
            with replacing(entry) as temporary:
                shutil.copyfile(result, temporary)
    except OSError as error:
        print(f"{result} is not kept in the cache {directory}: {error}", file=sys.stderr)


def hold(results: Path, made: str, result: Path) -> None:
    """Keep a second name of a result until :func:`release` finds it safe."""
    entry = results / KEPT / f"{made}.nc"
    with contextlib.suppress(OSError):
        entry.parent.mkdir(parents=True, exist_ok=True)
        entry.unlink(missing_ok=True)
        os.link(result, entry)


def release(results: Path) -> None:
    """Remove second names of results that are in their place."""
    places = {
        found
        for path in results.glob("*/[!.]*.nc")
        if path.parent.name != KEPT and (found := keys.key_in(path))
    }
    for entry in (results / KEPT).glob("*.nc"):
        if entry.stem in places:
            with contextlib.suppress(OSError):
                entry.unlink()
