"""What comes before the workflow: bytecode that is not outdated, and a check of the configuration.

``python -m replication.pipeline.launch`` takes Snakemake's arguments. Snakemake reads the files of
``--configfile`` before the workflow can check them: a missing file ends in a traceback, and one
with the key ``__use_yte__`` may contain Python that is executed. With no cores it waits for ever.

The Snakefile executes this module before it imports any other one, so it imports none by itself.
By default Python runs old bytecode if a source changes and keeps its time and size (archives,
``rsync -t``, two edits within a second). Checked bytecode is compared with the source's content.
"""

import argparse
import contextlib
import hashlib
import importlib.util
import os
import py_compile
import re
import sys
from collections.abc import Sequence
from pathlib import Path

CHECKED = (0b11).to_bytes(4, "little")
"""Flags (bytes 4 to 8 of the file) of bytecode that is compared with its source's digest."""


def make_checked(root: Path) -> None:
    """Make all bytecode below a directory of the kind that is compared by content.

    Where it can't be written, the old one is left: then Python compiles the source itself.
    """
    for source in root.rglob("*.py"):
        compiled = Path(importlib.util.cache_from_source(str(source)))
        with contextlib.suppress(OSError), compiled.open("rb") as file:
            if file.read(8)[4:] == CHECKED:
                continue
        with contextlib.suppress(OSError, SyntaxError, ValueError):
            mode = py_compile.PycInvalidationMode.CHECKED_HASH
            py_compile.compile(str(source), doraise=False, quiet=2, invalidation_mode=mode)


def cache_of_numba(root: Path) -> Path:
    """A directory for code that numba has compiled, named by the digest of its sources.

    Like Python, numba compares only time and size.
    """
    digest = hashlib.sha256()
    for source in sorted(root.rglob("*.py")):
        content = source.read_bytes()
        uses_numba = b"numba" in content or b"import compil" in content
        if uses_numba or "friction" in source.parts:  # friction laws are compiled too
            digest.update(content)
    return root / "__pycache__" / f"numba-{digest.hexdigest()[:16]}"


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
    if given.configfile:
        from nucleation.model.quantities import ParameterError

        from ..configuration.load import load

        try:
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
