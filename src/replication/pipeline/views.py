"""The files that people open: links into a store, or copies where links are impossible.

Any other file belongs to the user. It is never overwritten, but moved aside.
"""

import contextlib
import itertools
import os
import shutil
from pathlib import Path

from .keys import digest_of_file, key_in
from .messages import LOGGER
from .recipes import Recipe, is_manifest
from .store import Store


def lay(file: Path, target: Path) -> None:
    """Make a relative link to a file of a store, or a copy where links are impossible.

    Parameters
    ----------
    file : Path
        The link; an older file is replaced.
    target : Path
        The file in the store.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    new = _beside(file)
    new.unlink(missing_ok=True)
    try:
        new.symlink_to(os.path.relpath(target.absolute(), file.parent.absolute()))
    except OSError:
        shutil.copyfile(target, new)
    new.replace(file)


def write(file: Path, text: str) -> None:
    """Write a text completely or not at all.

    Parameters
    ----------
    file : Path
        The file; an older one is replaced.
    text : str
        Its content.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    new = _beside(file)
    new.write_text(text, "utf-8")
    new.replace(file)


def _beside(file: Path) -> Path:
    return file.with_name(f".{file.name}.{os.getpid()}.tmp")


def shows(file: Path, target: Path) -> bool:
    """Whether a file is a link to a file of a store, or a copy of it.

    Parameters
    ----------
    file : Path
        A file that people open.
    target : Path
        The file in the store.

    Returns
    -------
    bool
        False also if either is missing.
    """
    if file.is_symlink():
        return os.path.realpath(file) == os.path.realpath(target)
    try:
        same_size = file.stat().st_size == target.stat().st_size
    except OSError:
        return False
    return file.is_file() and same_size and digest_of_file(file) == digest_of_file(target)


def show(recipe: Recipe) -> None:
    """Make the links to a result; for a batch write the list of its parts' keys."""
    for file in recipe.files:
        if recipe.call:
            lay(Path(file), Path(recipe.stored(file)))
        else:
            write(Path(file), recipe.manifest())
            times = [os.stat(part.stored(part.files[0])).st_mtime for part in recipe.parts]
            newest = max(times)
            os.utime(file, (newest, newest))  # results that were made of the parts are newer


def is_shown(recipe: Recipe, store: Store) -> bool:
    """Whether the files of a rule show its result, and the store has it.

    Parameters
    ----------
    recipe : Recipe
        Recipe of the result.
    store : Store
        Store of the directory of results.

    Returns
    -------
    bool
        False also if a part of a batch is missing in the store.
    """
    if not all(store.note(one.key) for one in recipe.needed):
        return False
    if not recipe.call:
        return all(_text(Path(file)) == recipe.manifest() for file in recipe.files)
    return all(shows(Path(file), Path(recipe.stored(file))) for file in recipe.files)


def is_linked(recipe: Recipe) -> bool:
    """Whether the files are links; then Snakemake sees the time of the result."""
    return not recipe.call or all(map(os.path.islink, recipe.files))


def can_link(directory: Path) -> bool:
    """Whether links are possible in a directory."""
    link = directory / f".link.{os.getpid()}.tmp"
    try:
        directory.mkdir(parents=True, exist_ok=True)
        link.symlink_to(".")
        link.unlink()
    except OSError:
        return False
    return True


def _text(file: Path) -> str | None:
    try:
        return file.read_text("utf-8") if file.is_file() else None
    except (OSError, ValueError):
        return None


def is_broken(file: Path) -> bool:
    """Whether it is a link to a missing file."""
    return file.is_symlink() and not file.exists()


def withdraw(file: Path, earlier: Path) -> None:
    """Remove a file that shows an outdated result.

    A link into a store, a copy of `earlier` or a list of a batch is deleted; the store still has
    the result. Any other file belongs to the user, and is moved aside.

    Parameters
    ----------
    file : Path
        A file that people open; it may be missing.
    earlier : Path
        The file in the store that it showed before; it may be missing.
    """
    if not os.path.lexists(file):
        return
    with contextlib.suppress(FileNotFoundError):  # another process was faster
        if _is_view(file, earlier):
            file.unlink()
            return
        kept = _free_name(file)
        file.rename(kept)
        LOGGER.warning(f"{file} is not of the workflow: it is now {kept}")


def _is_view(file: Path, earlier: Path) -> bool:
    if file.is_symlink() and key_in(os.readlink(file)) is not None:
        return True
    return shows(file, earlier) or is_broken(file) or is_manifest(_text(file))


def _free_name(file: Path) -> Path:
    """A name for a file that is moved aside: with ``~``, or ``~1``, ``~2``, ..."""
    for number in itertools.count():
        name = file.with_name(f"{file.name}~{number or ''}")
        if not os.path.lexists(name):
            return name
    raise AssertionError  # the count does not end
