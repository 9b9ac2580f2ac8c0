"""Find results that are stale, incomplete, damaged or foreign, and results that are not in use.

    python -P -m replication.pipeline.check check RESULTS EXPECTED
    python -P -m replication.pipeline.check prune RESULTS EXPECTED     (PRUNE=yes: and remove them)

The workflow writes the file EXPECTED, with the result that each file of a configuration should
show. The last line says whether all is current.
"""

import contextlib
import json
import os
import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path

from nucleation.datasets import DatasetError

from .recipes import PLACES, RECIPES, key_in, read, shows
from .store import DAMAGED, Store, read_note

CURRENT = "All is current"
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

Finding = tuple[Path, str, str]
"""A file's path, its state (stale, incomplete, damaged, foreign or unused) and the reason."""


def plain(text: str) -> str:
    """A text of others as one line that any terminal can print."""
    return "".join(c if c.isprintable() else "?" for c in text)


def check_results(results: Path, expected: Expected) -> Iterator[Finding]:
    """Compare results with those that the present configuration and code make.

    First wrong entries, then files that show something else, then the entries that are not in use.
    """
    store = Store(results / "store")
    names = defaultdict(set)
    for target in expected.values():
        names[key_in(target)].add(os.path.basename(target))
    for key in store.listed():
        entry = store.entry(key)
        try:
            read_note(entry, whole=True, names=names[key])
        except DatasetError as error:
            state = "foreign" if "another key" in str(error) else "damaged"
            yield (entry, state, f"{error}: make it again, and it is moved aside")
    for path in sorted(store.directory.glob(".*.tmp")):
        yield (path, "incomplete", _HALF)
    for path in sorted(store.directory.glob(f"{DAMAGED}*")):
        yield (path, "damaged", "it was moved aside, since it is not what it should be")
    yield from _shown(results, expected)
    for key in unused(store, expected):
        yield (store.entry(key), UNUSED, "make prune removes it")


def unused(store: Store, expected: Expected) -> list[str]:
    """Keys that neither the configuration nor any directory of results refers to."""
    used = {key_in(path) for path in expected.values()}
    for place in store.directory.glob(f"{RECIPES}/*"):
        places = []  # of the results and of the work; unknown ones count
        with contextlib.suppress(OSError, ValueError):
            places = (place / PLACES).read_text("utf-8").splitlines()
        if not all((store.directory.resolve() / one).is_dir() for one in places):
            continue  # one of them is not there any more
        for file in place.rglob("*.json"):
            try:
                recipe = read(file)
                for one in (recipe, *recipe.parts):
                    used.add(one.key)
                    used.update(*one.source_keys.values())
                    used.update(key_in(os.path.realpath(path)) for path in one.files)
            except (OSError, ValueError, KeyError, TypeError) as error:
                message = f"{file} can't be read ({error!r}): delete it, plan again"
                raise DatasetError(message) from None
    return [key for key in store.listed() if key not in used]


def _shown(results: Path, expected: Expected) -> Iterator[Finding]:
    """Files among the results that do not show the present results."""
    for path in sorted(results.rglob("*")):
        if path.relative_to(results).parts[0] in OWN or path.is_dir():
            continue
        if any((above / "store").is_dir() for above in path.parents if results in above.parents):
            continue  # of another configuration
        wanted = expected.get(str(path))
        leftover = next((text for form, text in LEFTOVERS.items() if path.match(form)), None)
        if leftover is not None:
            yield (path, "incomplete", leftover)
        elif wanted is None:
            yield (path, "foreign", "nothing in the configuration makes it")
        elif path.is_symlink() and not path.exists():
            yield (path, "damaged", "its result is not in the store: make it again")
        elif not shows(path, wanted):
            yield (path, "stale", "it is of other parameters or other code: make it again")


def prune(results: Path, expected: Expected, remove: bool) -> str:
    """List the results that are not in use, and with `remove` remove them."""
    store = Store(results / "store")
    keys = unused(store, expected)
    lines = []
    for key in keys:
        entry = store.entry(key)
        name = ""
        with contextlib.suppress(DatasetError):
            name = str(read_note(entry).get("name", ""))[:200]
        lines.append(f"{entry}  {plain(name)}")
        if remove:
            try:
                store.remove(key)
            except OSError as error:
                lines[-1] += f"  not removed: {error.strerror}"
    done = "removed" if remove else "that nothing refers to; PRUNE=yes removes them"
    return "\n".join([*lines, f"{len(keys)} results {done}"])


def main(command: str, results: str, expected_file: str) -> None:
    """Print the findings of ``check``, or the results of ``prune``."""
    try:
        expected = json.loads(Path(expected_file).read_text("utf-8"))
        if command == "prune":
            print(prune(Path(results), expected, os.environ.get("PRUNE") == "yes"))
            return
        findings = list(check_results(Path(results), expected))
    except (DatasetError, OSError) as error:
        sys.exit(plain(str(error)))
    for path, state, reason in findings:
        print(f"{state:<10}  {plain(f'{path}: {reason}')}")
    wrong = sum(state != UNUSED for _, state, _ in findings)
    print(f"{wrong} findings: these results are not current" if wrong else CURRENT)
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main(*sys.argv[1:])
