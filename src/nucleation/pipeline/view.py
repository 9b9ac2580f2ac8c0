"""What people open: results under plain names, as links into the store.

A target lays its own part at its end. Set a parameter back, and the links follow. Nothing is made
from what lies here. A record in the store says what each target shows, and so what
:func:`nucleation.pipeline.check.unused` has to keep.
"""

from __future__ import annotations

import datetime
import hashlib
import json
import os
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ..analysis.events import in_table
from ..datasets.files import replacing
from .job import lay
from .keys import content
from .store import Note, Store, StoreError, path_in, read_note, suffixes

VIEWS = "views"
"""Directory in a store with a record of each directory of results that shows something of it."""

LARGE = 2**24
"""Bytes from which on the content of a file is not looked at again before it is shown."""


def show(results: Path, target: str, shown: Iterable[tuple[str, str]]) -> list[Path]:
    """Lay what a target shows.

    Parameters
    ----------
    results : directory of the results.
    target : its name.
    shown : names in the directory, without suffix, and keys.

    Returns
    -------
    list of Path
        All files that are shown, in that order.

    Raises
    ------
    StoreError
        If an entry is missing or damaged; a damaged one is moved aside.
    """
    store, shown = Store(results / "store"), list(shown)
    record = _record(store, results)
    before = set(record["targets"].get(target, {}).get("files", ()))
    laid = []
    for name, key in shown:
        note = _verified(store, key)
        laid += [
            _lay(results / f"{name}{suffix}", path_in(store.entry(key), suffix))
            for suffix in suffixes(note)
        ]
    files = [path.relative_to(results).as_posix() for path in laid]
    record["targets"][target] = {"keys": sorted({key for _, key in shown}), "files": files}
    others = {f for other in record["targets"].values() for f in other["files"]}
    for name in before - others:
        if (results / name).is_symlink():
            (results / name).unlink()
    record["when"] = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")
    with replacing(_place(store, results)) as temporary:
        temporary.write_text(json.dumps(record, indent=1) + "\n")
    return laid


def records(store: Store) -> list[dict[str, Any]]:
    """What all directories of results show of a store."""
    found = []
    for path in sorted((store.directory / VIEWS).glob("*.json")):
        try:
            found.append(json.loads(path.read_text("utf-8")))
        except (OSError, ValueError) as error:
            raise StoreError(f"{path} can't be read, so nothing can be said of unused results: "
                             f"{error}") from None  # fmt: skip
    return found


def _place(store: Store, results: Path) -> Path:
    name = hashlib.sha256(str(results.resolve()).encode()).hexdigest()[:16]
    return store.directory / VIEWS / f"{name}.json"


def _record(store: Store, results: Path) -> dict[str, Any]:
    try:
        found = json.loads(_place(store, results).read_text("utf-8"))
        return found if isinstance(found["targets"], dict) else {"targets": {}}
    except (OSError, ValueError, KeyError, TypeError):
        return {"results": str(results.resolve()), "targets": {}}


def _verified(store: Store, key: str) -> Note:
    try:
        note = read_note(store.entry(key))
        small = sum(file["size"] for file in note["files"].values()) < LARGE
        return read_note(store.entry(key), whole=small)
    except StoreError as error:
        store.set_aside(key)
        raise StoreError(
            f"{error}. It was moved aside: run this again, and it is made again"
        ) from None


def _lay(path: Path, target: Path) -> Path:
    """Put a link to a file of the store in place; a file of somebody's own there is kept."""
    if path.is_symlink():
        if os.path.realpath(path) == os.path.realpath(target):
            return path
    elif path.is_file() and content(path) != content(target):
        kept = path.with_name(f"{path.name}~")
        path.rename(kept)
        print(f"{path} is not of the workflow: it is now {kept}", file=sys.stderr)
    lay(path, target)
    return path


def run(snakemake: Any) -> None:
    """Show what a target leads to, and say where; warn of runs without an event."""
    params = snakemake.params
    results, store = Path(params.results), Store(Path(params.results) / "store")
    batched = [(name, key) for name, key in params.batched if store.note(key) is not None]
    try:
        laid = show(results, str(snakemake.rule), [*params.shown, *batched])
    except (StoreError, OSError) as error:
        sys.exit(f"{snakemake.rule}: {error}")
    main = [path for path in laid if path.with_suffix("").name in _names(params)]
    print(f"{params.says} In {', '.join(map(str, main))}", file=sys.stderr)
    for name, key in params.shown:
        if name.startswith("lengths/"):
            table = path_in(store.entry(key), ".csv")
            for line in in_table(table):
                print(f"Warning: study {name.removeprefix('lengths/')}: {line}", file=sys.stderr)


def _names(params: Any) -> set[str]:
    return {Path(name).name for name, _ in params.shown[: params.main]}
