"""Results that are stale, incomplete, damaged or foreign, found from the files themselves.

What each file has to be is known from the rules (:class:`nucleation.pipeline.planning.Planner`);
what it is, from its content, its record and the key it bears. Nothing is run, nothing is changed.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from ..datasets import seal
from . import cache, keys
from .keys import Store

LEFTOVERS = {
    ".*.tmp": "half a file of a run that was killed: delete it",
    "*.checkpoint.npz": "a run has begun here and goes on when it is asked for again",
    "*.failed.nc": "the record of a run that failed",
}

UNUSED = "unused"
"""State of a result of other parameters or other code, which no finding is."""

Expected = Mapping[str, Mapping[str, str] | None]
"""What makes each file, of :func:`nucleation.pipeline.keys.parts`; None where no rule does."""


@dataclasses.dataclass(frozen=True)
class Finding:
    """A file that is not as it should be.

    `state` is stale, incomplete, damaged, foreign or :data:`UNUSED`.
    """

    path: Path
    state: str
    reason: str

    def __str__(self) -> str:
        return f"{self.state:<10}  {self.path}: {self.reason}"


def files(results: Path) -> list[str]:
    """Finished files of a configuration, without logs and what is another configuration's."""
    others = {path.parent for path in results.glob("*/simulations")} | {results / "reference"}
    hidden = (keys.RECORDS, cache.KEPT)
    return [
        str(path)
        for path in sorted(results.rglob("*"))
        if path.is_file()
        and others.isdisjoint(path.parents)
        and path.relative_to(results).parts[0] not in ("logs", *hidden)
    ]


def check_results(store: Store, expected: Expected, wanted: Iterable[str]) -> list[Finding]:
    """All results that are not what the present configuration and code make.

    Parameters
    ----------
    store : of the results.
    expected : of the files that are there, from :func:`files`.
    wanted : keys of all datasets that the configuration asks for.
    """
    wanted = set(wanted)
    found: list[Finding] = []
    for name, parts in expected.items():
        path = Path(name)
        leftover = [text for pattern, text in LEFTOVERS.items() if path.match(pattern)]
        if leftover:
            found.append(Finding(path, "incomplete", leftover[0]))
        elif keys.key_in(path):
            found += _of_keyed(path, wanted)
        elif parts is None:
            found.append(Finding(path, "foreign", "nothing in the configuration makes it"))
        elif problem := store.problem(path, parts):
            state = "stale" if "changed" in problem else "damaged"
            found.append(Finding(path, "foreign" if "vouches" in problem else state, problem))
    return found


def _of_keyed(path: Path, wanted: set[str]) -> Iterator[Finding]:
    """What is wrong with a dataset that bears its key."""
    key = keys.key_in(path)
    try:
        held = seal.verified(path).get("key")  # ten times as fast as reading the values
    except (ValueError, OSError) as error:
        yield Finding(path, "damaged", f"{error}: delete it, and it is made again")
        return
    if held != key:
        yield Finding(path, "foreign", f"it holds the result of another key, {held}")
    elif key not in wanted:
        yield Finding(path, UNUSED, "of other parameters or other code; make prune removes it")


def report(findings: list[Finding]) -> str:
    """The findings in words, a line each, and what they come to."""
    wrong = [found for found in findings if found.state != UNUSED]
    end = f"{len(wrong)} findings: these results are not current" if wrong else "All is current"
    return "\n".join([*map(str, findings), end])
