"""Results that are stale, incomplete, damaged or foreign, and those that nothing refers to.

    python -m nucleation.pipeline.check check RESULTS EXPECTED
    python -m nucleation.pipeline.check prune RESULTS EXPECTED       (PRUNE=yes: and remove them)

What each result has to be is known from the recipes of all that a configuration can ask for, which
the workflow writes into a file; what it is, from the store.
"""

import dataclasses
import json
import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

from .planning import referred
from .store import ASIDE, Store, StoreError, key_in, read_note
from .views import shows

LEFTOVERS = {
    ".*.tmp": "half a file of a run that was killed: delete it",
    "*.checkpoint.npz": "a run has begun here and goes on when it is asked for again",
    "*.failed.nc": "the record of a run that failed",
}
OWN = {"store", "logs", "reference"}  # directories that show no results
UNUSED = "unused"  # state of a result of other parameters or other code, which is no finding

Expected = Mapping[str, str]
"""Where the store has what each file should show, by the file's name; of a list its text."""


@dataclasses.dataclass(frozen=True)
class Finding:
    """A file that is not as it should be."""

    path: Path
    state: str  # stale, incomplete, damaged, foreign or UNUSED
    reason: str

    def __str__(self) -> str:
        return f"{self.state:<10}  {self.path}: {self.reason}"


def check_results(results: Path, expected: Expected) -> list[Finding]:
    """All among the results that is not what the present configuration and code make."""
    store = Store(results / "store")
    found = [*_entries(store), *_shown(results, expected)]
    gone = unused(results, expected)
    return found + [Finding(store.entry(key), UNUSED, "make prune removes it") for key in gone]


def unused(results: Path, expected: Expected) -> list[str]:
    """Keys in a store that neither the configuration nor any directory of results refers to."""
    store = Store(results / "store")
    kept = referred(store) | {str(key_in(path)) for path in expected.values()}
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


def _shown(results: Path, expected: Expected) -> Iterator[Finding]:
    """Files among the results that do not show the present ones."""
    for path in sorted(results.rglob("*")):
        if path.relative_to(results).parts[0] in OWN or path.is_dir():
            continue
        if any((above / "store").is_dir() for above in path.parents if results in above.parents):
            continue  # it is of the results of another configuration, below these
        leftover = next((text for form, text in LEFTOVERS.items() if path.match(form)), None)
        wanted = expected.get(str(path))
        if leftover is not None:
            yield Finding(path, "incomplete", leftover)
        elif wanted is None:
            yield Finding(path, "foreign", "nothing in the configuration makes it")
        elif path.is_symlink() and not path.exists():
            yield Finding(path, "damaged", "its result is not in the store: make it again")
        elif not _is_as_wanted(path, wanted):
            yield Finding(path, "stale", "it is of other parameters or other code: make it again")


def _is_as_wanted(path: Path, wanted: str) -> bool:
    if wanted.startswith("{"):
        return path.read_bytes() == wanted.encode()
    return shows(path, Path(wanted))


def prune(results: Path, expected: Expected, remove: bool) -> str:
    """List what nothing refers to, and remove it if that is asked for; what was done, in words."""
    store = Store(results / "store")
    keys = unused(results, expected)
    lines = []
    for key in keys:
        name = (store.note(key) or {}).get("name", "")
        size = sum(file.stat().st_size for file in store.entry(key).iterdir())
        lines.append(f"{store.entry(key)}  {name}  {size / 1e6:.1f} MB")
        if remove:
            store.remove(key)
    done = "removed" if remove else "that nothing refers to; PRUNE=yes removes them"
    return "\n".join([*lines, f"{len(keys)} results {done}"])


def main(asked: str, results: str, expected_file: str) -> None:
    """Answer ``check`` or ``prune``; the exit code of ``check`` is 1 if there are findings."""
    try:
        expected = json.loads(Path(expected_file).read_text("utf-8"))
        if asked == "prune":
            print(prune(Path(results), expected, os.environ.get("PRUNE") == "yes"))
            return
        findings = check_results(Path(results), expected)
    except (StoreError, OSError) as error:
        sys.exit(str(error))
    wrong = sum(found.state != UNUSED for found in findings)
    end = f"{wrong} findings: these results are not current" if wrong else "All is current"
    print(*findings, end, sep="\n")
    if wrong:
        sys.exit(1)


if __name__ == "__main__":
    main(*sys.argv[1:])
