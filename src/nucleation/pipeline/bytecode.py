"""Bytecode that is never outdated: Python holds it against the content of its source.

By default Python compares time and size alone. A source that changes with both kept (archives,
``rsync -t``, ``touch -r``, two edits within a second) then runs as it was before. This module is
executed before any other of the package, so it imports nothing of it.
"""

import contextlib
import hashlib
import importlib.util
import py_compile
from pathlib import Path

CHECKED = (0b11).to_bytes(4, "little")
"""The flags, in bytes 4 to 8 of a file, of bytecode that is held against its source's digest."""


def make_checked(root: Path) -> None:
    """See to it that all bytecode below a directory is of the kind that is checked by content.

    Where bytecode can't be written, what is there is removed or left: Python then compiles, or
    says so.
    """
    for source in root.rglob("*.py"):
        compiled = Path(importlib.util.cache_from_source(str(source)))
        try:
            with compiled.open("rb") as file:
                if file.read(8)[4:] == CHECKED:
                    continue
        except OSError:
            pass
        with contextlib.suppress(OSError, SyntaxError, ValueError):
            py_compile.compile(
                str(source), doraise=False, quiet=2,
                invalidation_mode=py_compile.PycInvalidationMode.CHECKED_HASH,
            )  # fmt: skip


def cache_of_numba(root: Path) -> Path:
    """A directory for what numba compiles, named by the content of the sources that use it.

    Numba as well would compare time and size alone.
    """
    found = hashlib.sha256()
    for source in sorted(root.rglob("*.py")):
        content = source.read_bytes()
        uses = b"numba" in content or b"import compil" in content
        if uses or "friction" in source.parts:  # laws are compiled too
            found.update(content)
    return root / "__pycache__" / f"numba-{found.hexdigest()[:16]}"
