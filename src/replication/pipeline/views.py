"""The files that people open: links into a store, or copies where links are impossible.

Any other file belongs to the user. It is never overwritten, but moved aside.
"""

import contextlib
import itertools
import os
import shutil
from collections.abc import Iterable
from pathlib import Path

from .messages import LOGGER
from .recipes import Recipe, is_manifest, key_in
from .store import Store, digest_of_file


def lay(file: Path, target: Path) -> None:
    """Make a relative link to a file of a store, or a copy; an older file is replaced."""
    file.parent.mkdir(parents=True, exist_ok=True)
    new = _beside(file)
    new.unlink(missing_ok=True)
    try:
        new.symlink_to(os.path.relpath(target.absolute(), file.parent.absolute()))
    except OSError:
        shutil.copyfile(target, new)
    new.replace(file)


def write(file: Path, text: str) -> None:
    """Write a text completely or not at all; an older file is replaced."""
    file.parent.mkdir(parents=True, exist_ok=True)
    new = _beside(file)
    new.write_text(text, "utf-8")
    new.replace(file)


def _beside(file: Path) -> Path:
    return file.with_name(f".{file.name}.{os.getpid()}.tmp")


def shows(file: Path, target: Path) -> bool:
    """Whether a file is a link to a file of a store, or a copy of it; not if either is missing."""
    if file.is_symlink():
        return os.path.realpath(file) == os.path.realpath(target)
    try:
        if not file.is_file() or file.stat().st_size != target.stat().st_size:
            return False
        return digest_of_file(file) == digest_of_file(target)
    except OSError:
        return False


def show(recipe: Recipe) -> None:
    """Make the links to a result; for a batch write the list of its parts' keys."""
    for file in recipe.files:
        if recipe.call:
            lay(Path(file), Path(recipe.stored(file)))
        else:
            write(Path(file), recipe.manifest())
            newest = max(os.stat(part.stored(part.files[0])).st_mtime for part in recipe.parts)
            os.utime(file, (newest, newest))  # results that were made of the parts are newer


def is_shown(recipe: Recipe, store: Store) -> bool:
    """Whether the store has a result, and the rule's files show it."""
    return recipe.is_in(store) and all(
        shows_expected(Path(file), wanted) for file, wanted in recipe.expected().items()
    )


def shows_expected(file: Path, wanted: str) -> bool:
    """Whether a file shows its target in the store, or has its text, as of Recipe.expected."""
    if not wanted.startswith("{"):
        return shows(file, Path(wanted))
    return file.is_file() and file.read_bytes() == wanted.encode()


def is_linked(recipe: Recipe) -> bool:
    """Whether the files are links; then Snakemake sees the time of the result."""
    return not recipe.call or all(map(os.path.islink, recipe.files))


def is_broken(file: Path) -> bool:
    """Whether it is a link to a missing file."""
    return file.is_symlink() and not file.exists()


def withdraw(file: Path, known: Iterable[Path]) -> None:
    """Remove a file that shows another result; the store still has that.

    A link into a store, a copy of a `known` file or a list of a batch is deleted. Any other file
    belongs to the user, and is moved aside.
    """
    if not os.path.lexists(file):
        return
    into_store = file.is_symlink() and key_in(os.readlink(file)) is not None
    with contextlib.suppress(FileNotFoundError):  # another process was faster
        if into_store or is_broken(file) or is_manifest(file) or any(shows(file, k) for k in known):
            file.unlink()
            return
        names = (file.with_name(f"{file.name}~{number or ''}") for number in itertools.count())
        kept = next(name for name in names if not os.path.lexists(name))
        file.rename(kept)
        LOGGER.warning(f"{file} is not of the workflow: it is now {kept}")
