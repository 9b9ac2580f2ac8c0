"""What can go wrong, each as a function that does it and then what a user would do next.

A fault gets a copy of the undisturbed workflow, what an undisturbed one makes, and a source of
random numbers. It leaves a workflow that is finished again: the caller compares the datasets. It
raises :class:`processes.Lost` if something was damaged, or if it ended without a clear error.
"""

import random
from collections.abc import Callable
from pathlib import Path

from harness import Place, Reference
from processes import Done, Running, require

Fault = Callable[[Place, Reference, random.Random], object]
FAULTS: dict[str, Fault] = {}


def fault(function: Fault) -> Fault:
    """Enter a function into the registry."""
    FAULTS[function.__name__] = function
    return function


def says(done: Done, *texts: str) -> None:
    """Require that it stopped with one of the texts in its output."""
    require(done.status != 0, "it ended well")
    require(any(text in done.output for text in texts), f"no clear error: {done.output[-2000:]}")


def disturb(name: str, reference: Reference, directory: Path, seed: str) -> None:
    """Let one fault happen to a copy of the workflow, which must be as undisturbed in the end."""
    place = Place(reference.directory).copy(directory)
    try:
        FAULTS[name](place, reference, random.Random(seed))
        place.require_same(reference)
    finally:
        Running.kill_all()
