"""Results that are stale, incomplete, damaged or foreign, and those that nothing refers to.

What each result has to be is known from the rules (:mod:`.steps`); what it is, from the store and
from the links of a directory of results into it (:func:`show`).
"""

import dataclasses
import datetime
import hashlib
import json
import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from ..analysis.rows import in_table
from ..datasets.files import replacing
from .job import lay
from .steps import LINKS
from .store import ASIDE, STEM, Store, StoreError, content, path_in, read_note

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


def run_show(snakemake: Any) -> None:
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


LEFTOVERS = {
    ".*.tmp": "half a file of a run that was killed: delete it",
    "*.checkpoint.npz": "a run has begun here and goes on when it is asked for again",
    "*.failed.nc": "the record of a run that failed",
}

OWN = {"store", "logs", LINKS, "reference"}  # directories that hold no links to results
UNUSED = "unused"  # state of a result of other parameters or other code, which is no finding


@dataclasses.dataclass(frozen=True)
class Finding:
    """A file that is not as it should be."""

    path: Path
    state: str  # stale, incomplete, damaged, foreign or UNUSED
    reason: str

    def __str__(self) -> str:
        return f"{self.state:<10}  {self.path}: {self.reason}"


def check_results(results: Path, expected: Mapping[str, str]) -> list[Finding]:
    """All among the results that is not what the present configuration and code make.

    `expected` has the keys of all that the configuration can ask for, by the name that each is
    shown under.
    """
    store = Store(results / "store")
    found = [*_entries(store), *_shown(results, store, expected)]
    gone = unused(store, expected)
    return found + [Finding(store.entry(key), UNUSED, "make prune removes it") for key in gone]


def unused(store: Store, expected: Mapping[str, str]) -> list[str]:
    """Keys in a store that neither the configuration nor any directory of results refers to."""
    kept = {*expected.values()}
    for record in records(store):
        kept.update(record["keys"])
    return [key for key in store.listed() if key not in kept]


def _entries(store: Store) -> Iterator[Finding]:
    """Entries that are not right, and what has been left between them."""
    for key in store.listed():
        try:
            read_note(store.entry(key), whole=True)
        except StoreError as error:
            state = "foreign" if "another key" in str(error) else "damaged"
            yield Finding(store.entry(key), state, f"{error}: make it again, and it is moved aside")
    for path in sorted(store.directory.glob(".*.tmp")):
        yield Finding(path, "incomplete", LEFTOVERS[".*.tmp"])
    for path in sorted((store.directory / ASIDE).glob("*/*")):
        yield Finding(path, "damaged", "it was moved aside, since it is not what it should be")


def _shown(results: Path, store: Store, expected: Mapping[str, str]) -> Iterator[Finding]:
    """Files among the results that are not links to the present ones."""
    for path in sorted(results.rglob("*")):
        name = path.relative_to(results)
        if name.parts[0] in OWN or path.is_dir():
            continue
        if any((above / "store").is_dir() for above in path.parents if results in above.parents):
            continue  # it is of the results of another configuration, below these
        leftover = next((text for form, text in LEFTOVERS.items() if path.match(form)), None)
        plain = name.with_suffix("")  # which may still end in the .columns of .columns.csv
        key = expected.get(plain.as_posix()) or expected.get(plain.with_suffix("").as_posix())
        if leftover is not None:
            yield Finding(path, "incomplete", leftover)
        elif key is None:
            yield Finding(path, "foreign", "nothing in the configuration makes it")
        elif path.is_symlink() and not path.exists():
            yield Finding(path, "damaged", "its result is not in the store: make it again")
        elif not _shows(path, store, key):
            yield Finding(path, "stale", "it is of other parameters or other code: make it again")


def _shows(path: Path, store: Store, key: str) -> bool:
    """Whether a file is that of an entry: a link to it, or a copy."""
    entry = store.entry(key)
    if path.is_symlink():
        return os.path.dirname(os.path.realpath(path)) == os.path.realpath(entry)
    content = path.read_bytes()
    return any(file.read_bytes() == content for file in entry.glob(f"{STEM}*{path.suffix}"))


def prune(results: Path, expected: Mapping[str, str], remove: bool) -> str:
    """List what nothing refers to, and remove it if that is asked for; what was done, in words."""
    store = Store(results / "store")
    keys = unused(store, expected)
    lines = []
    for key in keys:
        name = (store.note(key) or {}).get("name", "")
        size = sum(f.stat().st_size for f in store.entry(key).iterdir())
        lines.append(f"{store.entry(key)}  {name}  {size / 1e6:.1f} MB")
        if remove:
            store.remove(key)
    done = "removed" if remove else "that nothing refers to; PRUNE=yes removes them"
    return "\n".join([*lines, f"{len(keys)} results {done}"])


def run(snakemake: Any) -> None:
    """The targets ``check``, ``prune`` (which removes if ``PRUNE`` is ``yes``) and ``targets``."""
    params = snakemake.params
    results, expected = Path(params.results), dict(params.expected)
    try:
        if params.asked == "targets":
            print("\n".join(f"{name:24} {text}" for name, text in params.targets.items()))
        elif params.asked == "prune":
            print(prune(results, expected, os.environ.get("PRUNE") == "yes"))
        else:
            findings = check_results(results, expected)
            wrong = sum(found.state != UNUSED for found in findings)
            end = f"{wrong} findings: these results are not current" if wrong else "All is current"
            print(*findings, end, sep="\n")
            if wrong:
                sys.exit("check: there are findings")
    except (StoreError, OSError) as error:
        sys.exit(str(error))
