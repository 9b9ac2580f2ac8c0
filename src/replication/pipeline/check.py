"""Find results that are stale, incomplete, damaged or foreign, and results that are not in use.

    python -m replication.pipeline.check check RESULTS EXPECTED
    python -m replication.pipeline.check prune RESULTS EXPECTED       (PRUNE=yes: and remove them)

The workflow writes the file EXPECTED, with the recipes of all results that a configuration can
make. They are compared with the store.
"""

import dataclasses
import json
import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

from nucleation.datasets.variables import DatasetError

from .entries import read_note
from .keys import key_in
from .recipe_files import referred
from .store import ASIDE, Store
from .views import shows

_HALF = "half a file of a run that was killed: delete it"
LEFTOVERS = {
    ".*.tmp": _HALF,
    "*.checkpoint.npz": "a run has begun here and continues when it is requested again",
    "*.failed.nc": "the record of a run that failed",
}
OWN = {"store", "logs", "reference"}  # directories that show no results
UNUSED = "unused"  # state of a result of other parameters or other code, which is no finding

Expected = Mapping[str, str]
"""For each file its target in the store, or its text if it is the list of a batch."""


@dataclasses.dataclass(frozen=True)
class Finding:
    """A file that is not as it should be."""

    path: Path
    state: str  # stale, incomplete, damaged, foreign or unused
    reason: str

    def __str__(self) -> str:
        return f"{self.state:<10}  {self.path}: {self.reason}"


def check_results(results: Path, expected: Expected) -> list[Finding]:
    """Compare results with those that the present configuration and code make.

    Parameters
    ----------
    results : Path
        The directory of results.
    expected : mapping
        For each file its target in the store, or its text.

    Returns
    -------
    list of Finding
        Among them the entries that are not in use.
    """
    store = Store(results / "store")
    findings = [*_entries(store), *_shown(results, expected)]
    for key in unused(results, expected):
        findings.append(Finding(store.entry(key), UNUSED, "make prune removes it"))
    return findings


def unused(results: Path, expected: Expected) -> list[str]:
    """Keys in a store without any reference.

    Parameters
    ----------
    results : Path
        The directory of results.
    expected : mapping
        As of :func:`check_results`.

    Returns
    -------
    list of str
        Neither the configuration nor any directory of results refers to them.
    """
    store = Store(results / "store")
    used = referred(store) | {str(key_in(path)) for path in expected.values()}
    return [key for key in store.listed() if key not in used]


def _entries(store: Store) -> Iterator[Finding]:
    """Wrong entries, and files that processes have left between the entries."""
    for key in store.listed():
        entry = store.entry(key)
        try:
            read_note(entry, whole=True)
        except DatasetError as error:
            state = "foreign" if "another key" in str(error) else "damaged"
            yield Finding(
                entry,
                state,
                f"{error}: make it again, and it is moved aside",
            )
    for path in sorted(store.directory.glob(".*.tmp")):
        yield Finding(path, "incomplete", _HALF)
    for path in sorted((store.directory / ASIDE).glob("*/*")):
        yield Finding(
            path,
            "damaged",
            "it was moved aside, since it is not what it should be",
        )


def _shown(results: Path, expected: Expected) -> Iterator[Finding]:
    """Files among the results that do not show the present results."""
    for path in sorted(results.rglob("*")):
        if path.relative_to(results).parts[0] in OWN or path.is_dir():
            continue
        if _is_of_other_results(path, results):
            continue
        leftover = _leftover(path)
        wanted = expected.get(str(path))
        if leftover is not None:
            yield Finding(path, "incomplete", leftover)
        elif wanted is None:
            yield Finding(path, "foreign", "nothing in the configuration makes it")
        elif path.is_symlink() and not path.exists():
            yield Finding(
                path,
                "damaged",
                "its result is not in the store: make it again",
            )
        elif not _is_as_wanted(path, wanted):
            yield Finding(
                path,
                "stale",
                "it is of other parameters or other code: make it again",
            )


def _is_of_other_results(path: Path, results: Path) -> bool:
    """Whether a file is in the directory of results of another configuration, below this one."""
    below = [above for above in path.parents if results in above.parents]
    return any((directory / "store").is_dir() for directory in below)


def _leftover(path: Path) -> str | None:
    for form, text in LEFTOVERS.items():
        if path.match(form):
            return text
    return None


def _is_as_wanted(path: Path, wanted: str) -> bool:
    if wanted.startswith("{"):
        return path.read_bytes() == wanted.encode()
    return shows(path, Path(wanted))


def prune(results: Path, expected: Expected, remove: bool) -> str:
    """List the results that are not in use, and remove them if `remove` is set.

    Parameters
    ----------
    results : Path
        The directory of results.
    expected : mapping
        As of :func:`check_results`.
    remove : bool
        Whether they are removed.

    Returns
    -------
    str
        A line for each, and their number.
    """
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


def main(command: str, results: str, expected_file: str) -> None:
    """Run ``check`` or ``prune``.

    Parameters
    ----------
    command : str
        ``check`` or ``prune``.
    results : str
        The directory of results.
    expected_file : str
        File that the workflow has written.

    Raises
    ------
    SystemExit
        If ``check`` has findings.
    """
    try:
        expected = json.loads(Path(expected_file).read_text("utf-8"))
        if command == "prune":
            print(
                prune(
                    Path(results),
                    expected,
                    os.environ.get("PRUNE") == "yes",
                )
            )
            return
        findings = check_results(Path(results), expected)
    except (DatasetError, OSError) as error:
        sys.exit(str(error))
    wrong = sum(found.state != UNUSED for found in findings)
    end = f"{wrong} findings: these results are not current" if wrong else "All is current"
    print(*findings, end, sep="\n")
    if wrong:
        sys.exit(1)


if __name__ == "__main__":
    main(*sys.argv[1:])
