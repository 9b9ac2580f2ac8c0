"""What costs much is made once for all workers: the others wait for it and read its file."""

import fcntl
import os
from collections.abc import Callable
from pathlib import Path


def once(factory, name: str, make: Callable[[Path], object]) -> Path:
    """A file or directory below the directory of all workers, made by the first who asks for it.

    `factory` is pytest's ``tmp_path_factory``.
    """
    workers = factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        workers = workers.parent
    made = workers / name
    with (workers / f"{name}.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not made.exists():
            half = workers / f"half-{name}"
            make(half)
            half.rename(made)
    return made
