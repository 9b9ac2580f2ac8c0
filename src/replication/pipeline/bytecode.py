"""Bytecode that is never outdated: Python compares it with the content of its source.

By default Python compares only time and size. If a source changes and keeps both (archives,
``rsync -t``, ``touch -r``, two edits within a second), Python runs the old bytecode. This module is
executed before any other module of the package, so it imports none of them.
"""

import contextlib
import hashlib
import importlib.util
import pkgutil
import py_compile
import sys
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


def compile_imports(*packages: str) -> None:
    """Import all modules of packages, so that Python keeps bytecode of all that they load.

    uv makes no bytecode, and where PYTHONDONTWRITEBYTECODE is set each job would compile 1600
    modules again, for two seconds.
    """
    sys.dont_write_bytecode = False
    for name in packages:
        found = importlib.import_module(name)
        for module in pkgutil.walk_packages(getattr(found, "__path__", ()), name + "."):
            if not module.name.endswith("__main__"):
                importlib.import_module(module.name)


if __name__ == "__main__":
    compile_imports("nucleation", "replication", "snakemake.cli")
