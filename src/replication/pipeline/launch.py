"""Start Snakemake after a check of its configuration files.

``python -m replication.pipeline.launch`` takes Snakemake's arguments. Snakemake reads the files of
``--configfile`` before the workflow can check them: a missing file, or one that is no text, ends in
a traceback, and a file with the key ``__use_yte__`` may contain Python that is executed. With zero
cores Snakemake waits for ever.
"""

import argparse
import os
import re
import sys
from collections.abc import Sequence

from nucleation.model.quantities import ParameterError

from ..configuration.load import load


def options(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """Cores and configuration files in Snakemake's arguments, by default those of this process."""
    parser = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    parser.add_argument("--cores", "-c", nargs="?")
    names = ("--configfile", "--configfiles")
    parser.add_argument(*names, nargs="*", action="extend", default=[])
    return parser.parse_known_args(arguments)[0]


def problem(arguments: Sequence[str]) -> str | None:
    """The problem with the cores or the configuration files, in words; None if there is none."""
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
    """Check the arguments, then replace this process by Snakemake."""
    arguments = sys.argv[1:]
    found = problem(arguments)
    if found is not None:
        sys.exit(found)
    os.execv(sys.executable, [sys.executable, "-m", "snakemake", *arguments])


if __name__ == "__main__":
    main()
