"""What can go wrong, each as a function that does it and then what a user would do next.

A fault gets a copy of the undisturbed workflow and a source of random numbers. It returns how the
disturbance ended, and leaves a workflow that is finished again: the caller compares the datasets.
It raises :class:`processes.Lost` if something was damaged, or if it ended without a clear error.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path

from harness import Place, Reference
from processes import Done, Running, require

RECOVERED = "recovered"
CLEAR_ERROR = "clear error"
"""It stopped with a message that names what is wrong, and was finished once that was removed."""

Fault = Callable[[Place, Reference, random.Random], str]
FAULTS: dict[str, tuple[str, Fault]] = {}
"""Kind and function of each fault, by name."""


def fault(kind: str, name: str = "") -> Callable[[Fault], Fault]:
    """Enter a function into the registry, under its own name if no other is given."""

    def enter(function: Fault) -> Fault:
        FAULTS[name or function.__name__] = (kind, function)
        return function

    return enter


def says(done: Done, *texts: str) -> None:
    """Require that it stopped with one of the texts in its output."""
    require(done.status != 0, "it ended well")
    require(any(text in done.output for text in texts), f"no clear error: {done.output[-2000:]}")


def disturb(name: str, reference: Reference, directory: Path, seed: str) -> str:
    """Let one fault happen to a copy of the workflow; how it ended.

    Raises
    ------
    processes.Lost
        If the datasets are not those of the undisturbed workflow in the end.
    """
    place = Place(reference.directory).copy(directory)
    _, function = FAULTS[name]
    try:
        outcome = function(place, reference, random.Random(seed))
        place.require_same(reference)
    finally:
        Running.kill_all()
    return outcome
