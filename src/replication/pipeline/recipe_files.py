"""Recipes in files below a store: a directory of them for each directory of results.

A recipe's file has the time zero if the outputs of its rule show the result of the recipe.
"""

import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from nucleation.datasets.variables import DatasetError

from .keys import PATTERN, key_in
from .recipes import Recipe, read
from .store import Store

RECIPES = "recipes"  # directory in a store, with a subdirectory for each directory of results
WORKING = "directory"  # file beside recipes with the working directory, relative to the store
_HEAD = re.compile(rf'{{"key": "({PATTERN})"'.encode())


def marks_shown(file: Path) -> bool:
    """Whether a recipe's file has the time of a shown result."""
    return file.is_file() and file.stat().st_mtime == 0.0


def key_of(file: Path) -> str | None:
    """The key in a recipe's file; None if there is no such file, or another one."""
    try:
        with file.open("rb") as stream:
            found = _HEAD.match(stream.read(64))
    except OSError:
        return None
    return found[1].decode() if found else None


def kept_recipes(store: Store) -> Iterator[Recipe]:
    """Yield the recipes of all directories of results that share a store, as they were planned.

    If a working directory is gone, its recipes are left out.

    Raises
    ------
    DatasetError
        If a recipe can't be read: then it is unknown which results are in use.
    """
    for place in sorted(store.directory.glob(f"{RECIPES}/*")):
        if not _is_in_use(place, store):
            continue
        for file in sorted(place.glob("**/*.json")):
            try:
                yield read(file)
            except (OSError, ValueError, KeyError, TypeError) as error:
                message = f"{file} can't be read ({error!r}): delete it, plan again"
                raise DatasetError(message) from None


def _is_in_use(place: Path, store: Store) -> bool:
    """Whether the working directory of some recipes still exists."""
    try:
        working = (place / WORKING).read_text("utf-8")
    except OSError:
        return True
    return (store.directory.resolve() / working).is_dir()


def referred(store: Store) -> set[str]:
    """Keys in a store that a recipe of any directory of results refers to, or its files show."""
    found: set[str] = set()
    for recipe in kept_recipes(store):
        for one in (recipe, *recipe.parts):
            found.add(one.key)
            for keys in one.source_keys.values():
                found.update(keys)
            found.update(_keys_of_links(one))
    return found


def _keys_of_links(recipe: Recipe) -> Iterator[str]:
    for file in recipe.files:
        if os.path.islink(file):
            key = key_in(os.path.realpath(file))
            if key is not None:
                yield key


def expected_of(recipes: Iterable[Recipe]) -> dict[str, str]:
    """The expected target in the store, or the expected text, of each file of some recipes."""
    found = {}
    for recipe in recipes:
        for file in recipe.files:
            found[file] = recipe.stored(file) if recipe.call else recipe.manifest()
    return found
