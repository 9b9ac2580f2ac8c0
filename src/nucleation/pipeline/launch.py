"""Snakemake, started once its configuration files have been looked at.

``python -m nucleation.pipeline.launch`` takes Snakemake's arguments. Snakemake itself reads a file
given by ``--configfile`` before anything of the workflow: one that is missing or is no text ends
in a traceback there, and of one with the key ``__use_yte__`` it runs expressions of Python. With no
core at all it waits forever.
"""

import argparse
import os
import re
import sys
from collections.abc import Sequence

from ..configuration.load import load
from ..model.quantities import ParameterError


def options(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """What a command line of Snakemake, by default this one, says of cores and configuration."""
    parser = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    parser.add_argument("--cores", "-c", nargs="?")
    parser.add_argument("--configfile", "--configfiles", nargs="*", action="extend", default=[])
    return parser.parse_known_args(arguments)[0]


def problem(arguments: Sequence[str]) -> str | None:
    """What is wrong with the cores or the configuration files, in words; None if nothing."""
    given = options(arguments)
    if re.fullmatch(r"0+|-\d+", given.cores or ""):
        return "--cores must be 1 or more"
    try:
        if given.configfile:
            load(*given.configfile)
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
