"""Results in one archive: entries of a store, and a checkout that starts from them.

A plain tar file: ``store/KEY/...`` for all that the results show, copies of the tables, figures and
texts under their plain names, the configuration, and a checksum of each file. An archive comes from
others, and a checkout runs what lies in it. So names, kinds and checksums of all members are looked
at before anything is written, and :func:`restore` writes entries of the store alone.
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
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ..configuration.load import DEFAULTS, load
from ..datasets.files import replacing
from ..datasets.provenance import moment
from .planning import kept_recipes
from .store import BAD, NOTE, PATTERN, STEM, Store, StoreError, content, read_note

CHECKSUMS = "manifest-sha256.txt"
CONFIGURATION = ("config.yaml", "beyond.yaml")
"""What the files of a configuration are called, of which only the default one has two."""
KINDS = r"(\.\w+)*\.(nc|csv|tsv|json|md|html|txt|tex|pdf|png|svg|gif)"
"""Endings of results; none that Python, a shell or git would run."""
DESCRIPTIONS = "|".join(map(re.escape, (CHECKSUMS, *CONFIGURATION)))
IN_ENTRY = re.compile(rf"store/({PATTERN})/({re.escape(NOTE)}|{STEM}{KINDS})")
COPY = rf"(?!store/)([\w-][^/\\]*/)*[\w-][^/\\]*?{KINDS}"
PLACE = re.compile(f"{DESCRIPTIONS}|{IN_ENTRY.pattern}|{COPY}")
LARGEST_TEXT = 2**26  # bytes of what is parsed; checksums of a hundred thousand files take 15 MB


class BundleError(Exception):
    """An archive that can't be written, or that is damaged or foreign."""


def write(archive: Path, configuration: Path | None, directory: Path = Path()) -> int:
    """Write an archive of what the results of a configuration show; the number of files in it.

    Parameters
    ----------
    archive : Path
        The file to be written.
    configuration : Path or None
        The configuration's file; None for the default configuration.
    directory : Path
        Where the workflow runs.

    Raises
    ------
    BundleError, StoreError
        If the archive exists already, there are no results, or one of them is damaged.
    """
    configured = [configuration] if configuration else DEFAULTS
    results = directory / load(*configured, lazy=True).results
    if archive.exists():
        raise BundleError(f"{archive} exists already: remove it or give another name")
    store = Store(results / "store")
    planned = [
        (one.key, one)
        for recipe in kept_recipes(store)
        for one in (recipe, *recipe.parts)
        if one.call and (store.entry(one.key) / NOTE).is_file()
    ]
    digests: set[str] = set()
    entries: dict[str, Path] = {}
    for key in sorted({key for key, _ in planned}):
        files = read_note(store.entry(key), whole=True)["files"]
        digests |= {file["sha256"] for file in files.values()}
        entries |= {f"store/{key}/{name}": store.entry(key) / name for name in (*files, NOTE)}
    if not entries:
        raise BundleError(f"there are no results in {results}: make them first")
    names = {os.path.relpath(file, one.results) for _, one in planned for file in one.files}
    shown = {name: results / name for name in sorted(names) if not name.endswith(".nc")}
    copies = {  # and no file of the user's own
        name: path for name, path in shown.items() if path.is_file() and content(path) in digests
    }
    packed = {**dict(zip(CONFIGURATION, configured, strict=False)), **copies, **entries}
    checksums = "".join(f"{content(path)}  {name}\n" for name, path in packed.items()).encode()
    members = {name: _member(name, path.stat().st_size) for name, path in packed.items()}
    _refuse_foreign(members.values())
    with replacing(archive) as temporary, tarfile.open(temporary, "w") as tar:
        tar.addfile(_member(CHECKSUMS, len(checksums)), io.BytesIO(checksums))
        for name, path in packed.items():
            with path.open("rb") as stream:
                tar.addfile(members[name], stream)
    return len(packed) + 1


def _member(name: str, size: int) -> tarfile.TarInfo:
    member = tarfile.TarInfo(name)
    member.size, member.mtime = size, int(moment().timestamp())
    return member


def restore(archive: Path, results: str, directory: Path = Path()) -> int:
    """Put the entries of an archive into the store of a checkout; how many are new there.

    The archive may come from others. If it is damaged or foreign, BundleError says so and nothing
    is written. `results` is relative to `directory`, where the workflow runs.
    """
    place = Path(os.path.normpath(directory.resolve() / results / "store"))
    if place.resolve() != place:
        raise BundleError(f"{place} leads to {place.resolve()}, over a link: nothing is put there")
    with contextlib.ExitStack() as stack:
        try:
            # not compressed: it is no smaller than what it holds
            tar = stack.enter_context(tarfile.open(archive, "r:"))
            entries = _entries(tar)
        except (tarfile.TarError, EOFError, *BAD) as error:
            raise BundleError(f"{archive} is damaged or no archive of results: {error}") from None
        store = Store(place)
        new = {key: files for key, files in entries.items() if store.note(key) is None}
        for key, files in new.items():
            about = json.load(_file(tar, files.pop(NOTE)))
            del about["files"]  # it is looked at again
            store.put(key, functools.partial(_unpack, tar, files), about)
    return len(new)


def _entries(tar: tarfile.TarFile) -> dict[str, dict[str, tarfile.TarInfo]]:
    """The files of each entry of an archive, if all in it is what was packed."""
    members = tar.getmembers()
    _refuse_foreign(members)
    sums = {m.name: hashlib.file_digest(_file(tar, m), "sha256").hexdigest() for m in members}
    lines = _file(tar, tar.getmember(CHECKSUMS)).read().decode().splitlines()
    packed = {name: digest for digest, name in (line.split("  ", 1) for line in lines)}
    for name, _ in sorted(packed.items() ^ (sums.items() - {(CHECKSUMS, sums[CHECKSUMS])})):
        raise StoreError(f"{name} is not what was packed")
    entries: dict[str, dict[str, tarfile.TarInfo]] = defaultdict(dict)
    for member in members:
        if place := IN_ENTRY.fullmatch(member.name):
            entries[place[1]][place[2]] = member
    for key, files in entries.items():
        note = json.load(_file(tar, files[NOTE]))
        told = {name: (file["size"], file["sha256"]) for name, file in note["files"].items()}
        held = {name: (m.size, sums[m.name]) for name, m in files.items() if name != NOTE}
        if note["key"] != key or told != held:
            raise StoreError(f"store/{key} is not the result that its note tells of")
    return entries


def _file(tar: tarfile.TarFile, member: tarfile.TarInfo) -> Any:
    return tar.extractfile(member)


def _unpack(tar: tarfile.TarFile, files: dict[str, tarfile.TarInfo], place: Path) -> None:
    for name, member in files.items():
        with (place / name).open("xb") as file:
            shutil.copyfileobj(_file(tar, member), file)


def _refuse_foreign(members: Iterable[tarfile.TarInfo]) -> None:
    """Refuse an archive by its members, if any of them has no place there."""
    problems = []
    for member in members:
        # neither links and devices, nor sparse files, whose size in the archive says nothing
        if member.type not in (tarfile.REGTYPE, tarfile.AREGTYPE) or member.issparse():
            problem = "only plain files are taken, no directories, links and devices"
        elif not (member.name.isprintable() and PLACE.fullmatch(member.name)):
            problem = "it is neither a result in a store nor a table, figure or text under its name"
        elif member.name.endswith((CHECKSUMS, NOTE)) and member.size > LARGEST_TEXT:
            problem = "it is too large"
        else:
            continue
        problems.append(f"\n  - {member.name!r}: {problem}")
    if problems:
        more = f", and {len(problems) - 5} more" if len(problems) > 5 else ""
        raise BundleError(f"nothing is written, as this is foreign:{''.join(problems[:5])}{more}")


def main(what: str, archive: str, configuration: str = "") -> None:
    """``write`` results of a configuration to an archive, or ``restore`` those of one.

    Without the name of its file it is the default configuration.
    """
    own = Path(configuration) if configuration else None
    if what == "write":
        print(f"{write(Path(archive), own)} files are in {archive}")
    else:
        settings = load(own, lazy=True) if own else load(lazy=True)
        count = restore(Path(archive), settings.results)
        print(f"{count} results are new here. Make what you want to see: it takes them")


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except (BundleError, ValueError, OSError) as error:
        sys.exit(str(error))
