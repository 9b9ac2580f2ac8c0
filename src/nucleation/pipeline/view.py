"""What people open: results under plain names, as links into the store.

A target lays its own part at its end. Set a parameter back, and the links follow. Nothing is made
from what lies here. A record in the store says what each target shows, and so what
:func:`nucleation.pipeline.check.unused` has to keep.
"""

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
from .store import STEM, Store, StoreError, path_in, read_note

VIEWS = "views"  # directory in a store: a record of each directory of results that shows some of it
LARGE = 2**24  # bytes from which on a file's content is not looked at again before it is shown


def show(results: Path, target: str, shown: Iterable[tuple[str, str]]) -> list[Path]:
    """Lay what a target shows, by names without suffix and keys; all files, in that order.

    Raises
    ------
    StoreError
        If an entry is missing or damaged; a damaged one is moved aside.
    """
    store, shown = Store(results / "store"), list(shown)
    laid = []
    for name, key in shown:
        entry = store.entry(key)
        try:
            note = read_note(entry)
            if sum(file["size"] for file in note["files"].values()) < LARGE:
                read_note(entry, whole=True)
        except StoreError as error:
            raise store.refused(key, error) from None
        for file in note["files"]:
            laid.append(results / f"{name}{file.removeprefix(STEM)}")
            _lay(laid[-1], entry / file)
    # Named by where the results are from the store, so that both can be moved or copied. A target
    # has its own, which others at work do not write.
    where = os.path.relpath(results.resolve(), store.directory.resolve())
    place = hashlib.sha256(where.encode()).hexdigest()[:16]
    record = store.directory / VIEWS / f"{place}.{target}.json"
    before = _files(record)
    when = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")
    about = {"target": target, "when": when, "keys": sorted({key for _, key in shown})}
    files = [path.relative_to(results).as_posix() for path in laid]
    with replacing(record) as temporary:
        temporary.write_text(json.dumps({**about, "files": files}, indent=1) + "\n")
    for name in before.difference(*map(_files, record.parent.glob(f"{place}.*.json"))):
        if (results / name).is_symlink():
            (results / name).unlink()
    return laid


def records(store: Store) -> list[dict[str, Any]]:
    """What the targets of all directories of results show of a store."""
    found = []
    for path in sorted((store.directory / VIEWS).glob("*.*.json")):
        try:
            record = json.loads(path.read_text("utf-8"))
            found.append({name: list(map(str, record[name])) for name in ("keys", "files")})
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise StoreError(f"{path} can't be read, so nothing can be said of unused results: "
                             f"{error!r}") from None  # fmt: skip
    return found


def _files(record: Path) -> set[str]:
    """The files in a record; none if there is none that can be read."""
    try:
        return set(json.loads(record.read_text("utf-8"))["files"])
    except (OSError, ValueError, KeyError, TypeError):
        return set()


def _lay(path: Path, target: Path) -> None:
    """Put a link to a file of the store in place; a file of somebody's own there is kept."""
    if path.is_symlink():
        if os.path.realpath(path) == os.path.realpath(target):
            return
    elif path.is_file() and content(path) != content(target):
        kept = path.with_name(f"{path.name}~")
        path.rename(kept)
        print(f"{path} is not of the workflow: it is now {kept}", file=sys.stderr)
    lay(path, target)


def run(snakemake: Any) -> None:
    """Show what a target leads to, and say where; warn of runs without an event."""
    params = snakemake.params
    results, store = Path(params.results), Store(Path(params.results) / "store")
    batched = [(name, key) for name, key in params.batched if store.note(key) is not None]
    try:
        laid = show(results, str(snakemake.rule), [*params.shown, *batched])
    except (StoreError, OSError) as error:
        sys.exit(f"{snakemake.rule}: {error}")
    names = {Path(name).name for name, _ in params.shown[: params.main]}
    main = [path for path in laid if path.with_suffix("").name in names]
    print(f"{params.says} In {', '.join(map(str, main))}", file=sys.stderr)
    for name, key in params.shown:
        if name.startswith("lengths/"):
            table = path_in(store.entry(key), ".csv")
            for line in in_table(table):
                print(f"Warning: study {name.removeprefix('lengths/')}: {line}", file=sys.stderr)
