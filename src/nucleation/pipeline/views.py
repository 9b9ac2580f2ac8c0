"""Files that people open: links into a store, or copies where links can't be.

What is no such file is somebody's own. It is never overwritten, but moved aside.
"""

import contextlib
import itertools
import os
import shutil
import sys
from pathlib import Path

from .recipes import Recipe, is_manifest
from .store import Store, content, key_in


def lay(file: Path, target: Path) -> None:
    """Put a relative link to a file of a store in place, or a copy where links can't be."""
    file.parent.mkdir(parents=True, exist_ok=True)
    new = _beside(file)
    new.unlink(missing_ok=True)
    try:
        new.symlink_to(os.path.relpath(target.absolute(), file.parent.absolute()))
    except OSError:
        shutil.copyfile(target, new)
    new.replace(file)


def write(file: Path, text: str) -> None:
    """Put a text in place, whole or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    new = _beside(file)
    new.write_text(text, "utf-8")
    new.replace(file)


def _beside(file: Path) -> Path:
    return file.with_name(f".{file.name}.{os.getpid()}.tmp")


def shows(file: Path, target: Path) -> bool:
    """Whether a file is a link to a file of a store, or a copy of it."""
    if file.is_symlink():
        return os.path.realpath(file) == os.path.realpath(target)
    try:
        same_size = file.stat().st_size == target.stat().st_size
    except OSError:
        return False
    return file.is_file() and same_size and content(file) == content(target)


def show(recipe: Recipe) -> None:
    """Lay the files of a result; of a batch a list of the keys of its parts."""
    for file in recipe.files:
        if recipe.call:
            lay(Path(file), Path(recipe.stored(file)))
        else:
            write(Path(file), recipe.manifest())
            newest = max(os.stat(part.stored(part.files[0])).st_mtime for part in recipe.parts)
            os.utime(file, (newest, newest))  # what was made of the parts is newer than the list


def is_shown(recipe: Recipe, store: Store) -> bool:
    """Whether the files of a rule are those of its result, which is in the store."""
    if not all(store.note(one.key) for one in recipe.needed):
        return False
    if not recipe.call:
        return all(_text(Path(file)) == recipe.manifest() for file in recipe.files)
    return all(shows(Path(file), Path(recipe.stored(file))) for file in recipe.files)


def is_linked(recipe: Recipe) -> bool:
    """Whether the files of a result are links, of which Snakemake sees the result's time."""
    return not recipe.call or all(map(os.path.islink, recipe.files))


def can_link(directory: Path) -> bool:
    """Whether a directory can have links."""
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


def leads_nowhere(file: Path) -> bool:
    """Whether it is a link into a store that has lost what it leads to."""
    return file.is_symlink() and not file.exists()


def withdraw(file: Path, earlier: Path | None = None) -> None:
    """Take away a file that shows another result than it should.

    A link into a store goes, as does a copy of `earlier`, which it showed before; both are still in
    the store. Anything else is somebody's own, and is moved aside.
    """
    if not os.path.lexists(file):
        return
    with contextlib.suppress(FileNotFoundError):  # another process was faster
        is_link = file.is_symlink() and key_in(os.readlink(file)) is not None
        is_copy = earlier is not None and shows(file, earlier)
        if is_link or is_copy or leads_nowhere(file) or is_manifest(_text(file)):
            file.unlink()
            return
        names = (file.with_name(f"{file.name}~{number or ''}") for number in itertools.count())
        kept = next(name for name in names if not os.path.lexists(name))
        file.rename(kept)
        print(f"{file} is not of the workflow: it is now {kept}", file=sys.stderr)
