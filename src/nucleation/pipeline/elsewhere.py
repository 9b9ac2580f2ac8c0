"""Stores elsewhere: results are taken from them before they are computed, and given to them after.

What is there may be damaged, foreign or out of reach: it is said in a line, and not taken.
"""

import os
import sys
from pathlib import Path

from .store import Store, StoreError, in_a_line

VARIABLE = "NUCLEATION_STORES"  # of the environment; it names directories, separated by commas


def others(strict: bool = True) -> list[Store]:
    """The other stores that the environment names.

    One that is no directory or can't be read raises a StoreError if `strict`; if not, it is said
    and left out, as on a node that lacks a disk.
    """
    found: list[Store] = []
    for name in filter(None, map(str.strip, os.environ.get(VARIABLE, "").split(","))):
        problem = None
        if not Path(name).is_dir():
            problem = f"the store {name!r} is no directory: make it first"
        elif not os.access(name, os.R_OK | os.X_OK):
            problem = f"the store {name!r} can't be read"
        if problem is None:
            found.append(Store(Path(name).absolute()))
        elif strict:
            raise StoreError(problem)
        else:
            print(f"Not used: {problem}", file=sys.stderr)
    return found


def give_all(entry: Path, others: list[Store]) -> None:
    """Give a new entry to the other stores; what goes wrong there is said, and the result stays.

    What is out of reach leaves the list.
    """
    for other in list(others):
        try:
            other.give(entry)
        except (OSError, StoreError) as error:
            print(f"Not kept in {other.directory}: {in_a_line(error)}", file=sys.stderr)
            others.remove(other)
