"""Archives of results: entries of a store in one file, from which another checkout starts.

An archive is a plain tar file. It holds ``store/KEY/...`` for all shown results, copies of tables,
figures and texts under their plain names, the configuration, and a checksum of each file. It may
come from somebody else, and a checkout runs code that it finds. So the names, kinds and checksums
of all members are checked first, and :func:`restore` writes only entries of the store.
"""

import contextlib
import functools
import hashlib
import io
import json
import os
import re
import shutil
import sys
import tarfile
from collections import defaultdict
from collections.abc import Iterable, Mapping
from pathlib import Path

from nucleation.datasets.files import replacing
from nucleation.datasets.provenance import moment
from nucleation.datasets.variables import DatasetError

from ..configuration.load import DEFAULTS, load
from .entries import BAD, NOTE, STEM, read_note
from .keys import PATTERN, digest_of_file
from .recipe_files import kept_recipes
from .recipes import Recipe
from .store import Store

CHECKSUMS = "manifest-sha256.txt"
_CONFIGURATION = ("config.yaml", "beyond.yaml")
"""Names of the configuration's files; only the default configuration has two."""
_KINDS = r"(\.\w+)*\.(nc|csv|tsv|json|md|html|txt|tex|pdf|png|svg|gif)"
"""Suffixes of results; neither Python nor a shell nor git runs such files."""
_DESCRIPTIONS = "|".join(map(re.escape, (CHECKSUMS, *_CONFIGURATION)))
_IN_ENTRY = re.compile(rf"store/({PATTERN})/({re.escape(NOTE)}|{STEM}{_KINDS})")
_COPY = rf"(?!store/)([\w-][^/\\]*/)*[\w-][^/\\]*?{_KINDS}"
_PLACE = re.compile(f"{_DESCRIPTIONS}|{_IN_ENTRY.pattern}|{_COPY}")
LARGEST_TEXT = 2**26  # bytes of a parsed file; a hundred thousand checksums take 15 MB
_SHOWN_PROBLEMS = 5

_Members = dict[str, tarfile.TarInfo]


def write(archive: Path, configuration: Path | None, directory: Path = Path()) -> int:
    """Write an archive of the shown results of a configuration.

    Parameters
    ----------
    archive : Path
        The file to be written.
    configuration : Path or None
        The configuration's file; None for the default configuration.
    directory : Path
        Working directory of the workflow.

    Returns
    -------
    int
        The number of files in the archive.

    Raises
    ------
    DatasetError
        If the archive exists already, there are no results, or one of them is damaged.
    """
    configured = [configuration] if configuration else DEFAULTS
    results = directory / load(*configured, lazy=True).results
    if archive.exists():
        raise DatasetError(f"{archive} exists already: remove it or give another name")
    store = Store(results / "store")
    recipes = _stored_recipes(store)
    entries, digests = _packed_entries(store, {recipe.key for recipe in recipes})
    if not entries:
        raise DatasetError(f"there are no results in {results}: make them first")
    copies = _packed_copies(results, recipes, digests)
    packed = dict(zip(_CONFIGURATION, configured, strict=False))
    packed |= copies
    packed |= entries
    members = {name: _member(name, path.stat().st_size) for name, path in packed.items()}
    _refuse_foreign(members.values())
    lines = [f"{digest_of_file(path)}  {name}\n" for name, path in packed.items()]
    checksums = "".join(lines).encode()
    with (
        replacing(archive) as temporary,
        tarfile.open(temporary, "w") as tar,
    ):
        tar.addfile(_member(CHECKSUMS, len(checksums)), io.BytesIO(checksums))
        for name, path in packed.items():
            with path.open("rb") as stream:
                tar.addfile(members[name], stream)
    return len(packed) + 1


def _stored_recipes(store: Store) -> list[Recipe]:
    """The planned recipes with a result in the store."""
    found = []
    for recipe in kept_recipes(store):
        for one in (recipe, *recipe.parts):
            if one.call and (store.entry(one.key) / NOTE).is_file():
                found.append(one)
    return found


def _packed_entries(store: Store, keys: set[str]) -> tuple[dict[str, Path], set[str]]:
    """Files of entries by their names in the archive, and the digests of these files."""
    entries: dict[str, Path] = {}
    digests: set[str] = set()
    for key in sorted(keys):
        files = read_note(store.entry(key), whole=True)["files"]
        digests |= {file["sha256"] for file in files.values()}
        for name in (*files, NOTE):
            entries[f"store/{key}/{name}"] = store.entry(key) / name
    return entries, digests


def _packed_copies(results: Path, recipes: list[Recipe], digests: set[str]) -> dict[str, Path]:
    """Tables, figures and texts by their names in the archive.

    A file of the user under such a name has none of the digests, and is left out.
    """
    names = {os.path.relpath(file, recipe.results) for recipe in recipes for file in recipe.files}
    copies = {}
    for name in sorted(names):
        path = results / name
        if path.suffix != ".nc" and path.is_file() and digest_of_file(path) in digests:
            copies[name] = path
    return copies


def _member(name: str, size: int) -> tarfile.TarInfo:
    member = tarfile.TarInfo(name)
    member.size = size
    member.mtime = int(moment().timestamp())
    return member


def restore(archive: Path, results: str, directory: Path = Path()) -> int:
    """Put the entries of an archive, which may come from somebody else, into a store.

    Parameters
    ----------
    archive : Path
        The archive.
    results : str
        The directory of results, relative to `directory`.
    directory : Path
        Working directory of the workflow.

    Returns
    -------
    int
        The number of new entries.

    Raises
    ------
    DatasetError
        If the archive is damaged or foreign; then nothing is written.
    """
    place = Path(os.path.normpath(directory.resolve() / results / "store"))
    if place.resolve() != place:
        raise DatasetError(f"{place} leads to {place.resolve()}, over a link: nothing is put there")
    with contextlib.ExitStack() as stack:
        try:
            # without compression, so that it can't hold more than its own size
            tar = stack.enter_context(tarfile.open(archive, "r:"))
            entries = _entries(tar)
        except (tarfile.TarError, EOFError, *BAD) as error:
            raise DatasetError(f"{archive} is damaged or no archive of results: {error}") from None
        store = Store(place)
        new = {key: files for key, files in entries.items() if store.note(key) is None}
        for key, files in new.items():
            about = json.load(_opened(tar, files.pop(NOTE)))
            del about["files"]  # the store makes this list again
            store.put(key, functools.partial(_unpack, tar, files), about)
    return len(new)


def _entries(tar: tarfile.TarFile) -> dict[str, _Members]:
    """The files of each entry of an archive, after a check of all members."""
    members = tar.getmembers()
    _refuse_foreign(members)
    digests = {}
    for member in members:
        digests[member.name] = hashlib.file_digest(_opened(tar, member), "sha256").hexdigest()
    _check_checksums(tar, digests)
    entries: dict[str, _Members] = defaultdict(dict)
    for member in members:
        place = _IN_ENTRY.fullmatch(member.name)
        if place:
            entries[place[1]][place[2]] = member
    for key, files in entries.items():
        _check_note(tar, key, files, digests)
    return entries


def _check_checksums(tar: tarfile.TarFile, digests: Mapping[str, str]) -> None:
    """Compare all members, except the list of checksums, with this list."""
    text = _opened(tar, tar.getmember(CHECKSUMS)).read().decode()
    packed = {}
    for line in text.splitlines():
        digest, name = line.split("  ", 1)
        packed[name] = digest
    found = {name: digest for name, digest in digests.items() if name != CHECKSUMS}
    for name, _ in sorted(packed.items() ^ found.items()):
        raise DatasetError(f"{name} differs from the file that was packed")


def _check_note(
    tar: tarfile.TarFile,
    key: str,
    files: _Members,
    digests: Mapping[str, str],
) -> None:
    """Compare the files of an entry with its note."""
    note = json.load(_opened(tar, files[NOTE]))
    noted = {}
    for name, file in note["files"].items():
        noted[name] = (file["size"], file["sha256"])
    found = {}
    for name, member in files.items():
        if name != NOTE:
            found[name] = (member.size, digests[member.name])
    if note["key"] != key or noted != found:
        raise DatasetError(f"store/{key} is not the result that its note describes")


def _opened(tar: tarfile.TarFile, member: tarfile.TarInfo) -> io.BufferedReader:
    stream = tar.extractfile(member)
    if not isinstance(stream, io.BufferedReader):
        raise DatasetError(f"{member.name} is no file")
    return stream


def _unpack(tar: tarfile.TarFile, files: _Members, place: Path) -> None:
    for name, member in files.items():
        with (place / name).open("xb") as file:
            shutil.copyfileobj(_opened(tar, member), file)


def _refuse_foreign(members: Iterable[tarfile.TarInfo]) -> None:
    """Refuse an archive with a member that has no place in archives."""
    problems = []
    for member in members:
        problem = _problem(member)
        if problem is not None:
            problems.append(f"\n  - {member.name!r}: {problem}")
    if problems:
        shown = "".join(problems[:_SHOWN_PROBLEMS])
        hidden = len(problems) - _SHOWN_PROBLEMS
        more = f", and {hidden} more" if hidden > 0 else ""
        raise DatasetError(f"nothing is written, as this is foreign:{shown}{more}")


def _problem(member: tarfile.TarInfo) -> str | None:
    # neither links and devices, nor sparse files, whose true size is not in the archive
    if member.type not in (tarfile.REGTYPE, tarfile.AREGTYPE) or member.issparse():
        return "only plain files are taken, no directories, links and devices"
    if not (member.name.isprintable() and _PLACE.fullmatch(member.name)):
        return "it is neither a result in a store nor a table, figure or text under its name"
    if member.name.endswith((CHECKSUMS, NOTE)) and member.size > LARGEST_TEXT:
        return "it is too large"
    return None


def main(command: str, archive: str, configuration: str = "") -> None:
    """Write an archive, or restore the results in one.

    Parameters
    ----------
    command : str
        ``write`` or ``restore``.
    archive : str
        The archive.
    configuration : str
        The configuration's file; empty for the default configuration.
    """
    own = Path(configuration) if configuration else None
    if command == "write":
        print(f"{write(Path(archive), own)} files are in {archive}")
    else:
        settings = load(own, lazy=True) if own else load(lazy=True)
        count = restore(Path(archive), settings.results)
        print(f"{count} results are new here. Make a target to see them: it takes them")


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except (ValueError, OSError) as error:
        sys.exit(str(error))
