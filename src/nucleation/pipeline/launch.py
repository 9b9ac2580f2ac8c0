"""Snakemake, started once its configuration files have been looked at.

``python -m nucleation.pipeline.launch`` takes Snakemake's arguments. Snakemake itself reads a file
given by ``--configfile`` before anything of the workflow: one that is missing or is no text ends
in a traceback there, and of one with the key ``__use_yte__`` it runs expressions of Python. With no
core at all it waits forever.
"""

import os
import re
import sys
from collections.abc import Iterator, Sequence

from ..configuration.load import load
from ..model.quantities import ParameterError

NO_CORES = re.compile(r" (--cores|-c)[ =]?(0+|-\d+) ")
OPTIONS = ("--configfile", "--configfiles")


def configuration_files(arguments: Sequence[str] | None = None) -> Iterator[str]:
    """The configuration files that a command line of Snakemake, by default this one, names."""
    taking = False  # an option takes all that follow, up to the next one
    for argument in sys.argv if arguments is None else arguments:
        option, _, value = argument.partition("=")
        if argument.startswith("-"):
            taking = option in OPTIONS
            if taking and value:
                yield value
        elif taking:
            yield argument


def problem(arguments: list[str]) -> str | None:
    """What is wrong with the cores or the configuration files, in words; None if all can be used.

    Of several, whose values are merged, only the first must be complete; all must be plain.
    """
    if NO_CORES.search(f" {' '.join(arguments)} "):
        return "--cores must be 1 or more"
    try:
        for path in configuration_files(arguments):
            load(path)
    except ParameterError as error:
        return str(error)
    return None


def main() -> None:
    """Check, then become Snakemake."""
    arguments = sys.argv[1:]
    found = problem(arguments)
    if found is not None:
        sys.exit(found)
    os.execv(sys.executable, [sys.executable, "-m", "snakemake", *arguments])


if __name__ == "__main__":
    main()
