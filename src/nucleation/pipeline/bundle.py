"""Results in one archive: entries of a store, and a checkout that starts from them.

A plain tar file: ``store/KEY/...`` for all that the results show, copies of the tables, figures and
texts under their plain names, the configuration, descriptions (:mod:`.crate`), and a checksum of
each file. An archive comes from others, and a checkout runs what lies in it. So names, kinds, sizes
and checksums of all members are looked at before anything is written, and :func:`restore` writes
entries of the store alone. Nothing in them is followed or executed.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import os
import re
import shutil
import sys
import tarfile
from collections import Counter, defaultdict
from pathlib import Path
from typing import Any

import click

from ..configuration.load import load
from ..datasets.files import replacing
from ..datasets.provenance import moment
from .crate import CONFIGURATION, CRATE, Packed, crate, manifest
from .keys import PATTERN
from .store import BAD, NOTE, STEM, Store, StoreError, read_note
from .view import records

CHECKSUMS, MANIFEST = "manifest-sha256.txt", "codecheck.yml"
KINDS = r"(\.\w+)*\.(nc|csv|tsv|json|md|html|txt|tex|pdf|png|svg|gif)"
"""Endings of results; none that Python, a shell or git would run."""
DESCRIPTION = "|".join(map(re.escape, (CHECKSUMS, CONFIGURATION, MANIFEST, CRATE)))
IN_ENTRY = re.compile(rf"store/({PATTERN})/({re.escape(NOTE)}|{STEM}{KINDS})")
COPY = rf"(?!store/)([\w-][^/\\]*/)*[\w-][^/\\]*?{KINDS}"
PLACE = re.compile(f"{DESCRIPTION}|{IN_ENTRY.pattern}|{COPY}")
TEXT = re.compile(rf"{DESCRIPTION}|.*/{re.escape(NOTE)}")
LARGEST_TEXT = 2**26  # bytes of a description; checksums of a hundred thousand files take 15 MB


class BundleError(Exception):
    """An archive that can't be written, or that is damaged or foreign."""


def write(archive: Path, configuration: Path, directory: Path = Path()) -> int:
    """Write an archive, a new file, of what the results show; the number of files in it.

    Parameters
    ----------
    archive, configuration : files; the results were made with the latter.
    directory : where the workflow runs.

    Raises
    ------
    BundleError, StoreError
        If the archive exists already, there are no results, or one of them is damaged.
    """
    results = directory / load(configuration).results
    if archive.exists():
        raise BundleError(f"{archive} exists already: remove it or give another name")
    store, entries = Store(results / "store"), []
    targets = [target for record in records(store) for target in record["targets"].values()]
    for key in sorted({key for target in targets for key in target["keys"]}):
        entry = store.entry(key)
        entries.append(_text(f"store/{key}/{NOTE}", (entry / NOTE).read_bytes()))
        for name, file in read_note(entry, whole=True)["files"].items():
            if not re.fullmatch(f"{STEM}{KINDS}", name):
                raise BundleError(f"{entry / name} is of no kind that an archive may hold")
            name = f"store/{key}/{name}"
            entries.append(Packed(name, results / name, file["size"], file["sha256"]))
    if not entries:
        raise BundleError(f"there are no results in {results}: make them first")
    digests = {file.digest for file in entries}
    shown = {results / name for target in targets for name in target["files"]}
    paths = [path for path in sorted(shown) if path.suffix != ".nc" and path.is_file()]
    copies = [_text(path.relative_to(results).as_posix(), path.read_bytes()) for path in paths]
    copies = [copy for copy in copies if copy.digest in digests]  # and no file of the user's own
    files = [_text(CONFIGURATION, configuration.read_bytes()), *copies, *entries]
    files = [_text(MANIFEST, manifest(copies)), *files]
    files = [_text(CRATE, crate(files)), *files]
    checksums = "".join(f"{file.digest}  {file.name}\n" for file in files)
    files = [_text(CHECKSUMS, checksums.encode()), *files]
    with replacing(archive) as temporary, tarfile.open(temporary, "w") as tar:
        for file in files:
            member = tarfile.TarInfo(file.name)
            member.size, member.mtime = file.size, int(moment().timestamp())
            source = file.source
            with io.BytesIO(source) if isinstance(source, bytes) else source.open("rb") as stream:
                tar.addfile(member, stream)
    return len(files)


def _text(name: str, content: bytes) -> Packed:
    return Packed(name, content, len(content), hashlib.sha256(content).hexdigest())


class Archive:
    """The entries of an archive, as a store elsewhere (:class:`nucleation.pipeline.store.Other`).

    Parameters
    ----------
    path, tar : an archive, which may come from others, and the same opened.

    Raises
    ------
    BundleError
        If it holds what has no place in it, with names.
    StoreError, and others of :data:`nucleation.pipeline.store.BAD`
        If it is damaged.
    """

    def __init__(self, path: Path, tar: tarfile.TarFile) -> None:
        self._path, self._tar = path, tar
        members = tar.getmembers()
        _refuse_foreign(members, path.stat().st_size)
        self.entries: dict[str, dict[str, tarfile.TarInfo]] = defaultdict(dict)
        for member in members:
            if found := IN_ENTRY.fullmatch(member.name):
                self.entries[found[1]][found[2]] = member
        digests = {
            m.name: hashlib.file_digest(self._file(m), "sha256").hexdigest() for m in members
        }
        lines = self._file(tar.getmember(CHECKSUMS)).read().decode().splitlines()
        checksums = {name: digest for digest, name in (line.split("  ", 1) for line in lines)}
        checksums[CHECKSUMS] = digests[CHECKSUMS]
        for name, _ in sorted(digests.items() ^ checksums.items()):
            raise StoreError(f"{name} is not what was packed")
        for key, files in self.entries.items():
            note = json.load(self._file(files[NOTE]))
            told = {name: (file["size"], file["sha256"]) for name, file in note["files"].items()}
            held = {n: (m.size, digests[m.name]) for n, m in files.items() if n != NOTE}
            if note["key"] != key or told != held:
                raise StoreError(f"store/{key} is not the result that its note tells of")

    def __str__(self) -> str:
        return str(self._path)

    def _file(self, member: tarfile.TarInfo) -> Any:
        return self._tar.extractfile(member)

    def fetch(self, key: str, into: Path) -> bool:
        """Write the files of an entry, new ones, into a directory."""
        for name, member in self.entries[key].items():
            with (into / name).open("xb") as file:
                shutil.copyfileobj(self._file(member), file)
        return True

    def give(self, entry: Path) -> None:
        """Nothing is added to an archive."""


def restore(archive: Path, results: str, directory: Path = Path()) -> int:
    """Put the entries of an archive into the store of a checkout; how many are new there.

    Parameters
    ----------
    archive : of :func:`write`; it may come from others.
    results : directory of the results of the configuration in use.
    directory : where the workflow runs.

    Raises
    ------
    BundleError
        If the archive is damaged or foreign, in which case nothing is written, or for lack of room.
    """
    place = Path(os.path.normpath(directory.resolve() / results / "store"))
    if place.resolve() != place:
        raise BundleError(f"{place} leads to {place.resolve()}, over a link: nothing is put there")
    with contextlib.ExitStack() as stack:
        try:
            # not compressed: it is no smaller than what it holds
            source = Archive(archive, stack.enter_context(tarfile.open(archive, "r:")))
        except (tarfile.TarError, EOFError, *BAD) as error:
            raise BundleError(f"{archive} is damaged or no archive of results: {error}") from None
        store = Store(place)
        new = [key for key in source.entries if store.note(key) is None]
        for key in new:
            if store.take(key, [source]) is None:
                raise BundleError(f"store/{key} is not in place, see above: start this again")
    return len(new)


def _refuse_foreign(members: list[tarfile.TarInfo], size: int) -> None:
    """Refuse an archive of a size (bytes) by its members, if any of them has no place there."""
    names = Counter(member.name for member in members)
    if any(name.startswith(".snakemake/metadata/") for name in names):
        raise BundleError("the archive is of an earlier version: its results are of another code")
    problems = []
    for member in members:
        # neither links and devices, nor sparse files, whose size in the archive says nothing
        if member.type not in (tarfile.REGTYPE, tarfile.AREGTYPE) or member.issparse():
            problem = "only plain files are taken, no directories, links and devices"
        elif not (member.name.isprintable() and PLACE.fullmatch(member.name)):
            problem = "it is neither a result in a store nor a table, figure or text under its name"
        elif TEXT.fullmatch(member.name) and member.size > LARGEST_TEXT:
            problem = "it is too large"
        else:
            continue
        problems.append(f"{member.name!r}: {problem}")
    problems += [f"{name!r}: it is in there {n} times" for name, n in names.items() if n > 1]
    if sum(member.size for member in members) > size:
        problems.append("its members are larger than itself")
    if problems:
        listing = "".join(f"\n  - {problem}" for problem in problems[:5])
        more = f", and {len(problems) - 5} more" if len(problems) > 5 else ""
        raise BundleError(f"the archive is refused, nothing was put in place:{listing}{more}")


@click.command()
@click.argument("what", type=click.Choice(["write", "restore"]))
@click.argument("archive", type=click.Path(path_type=Path))
@click.argument("configuration", type=click.Path(path_type=Path), default="config/config.yaml")
def main(what: str, archive: Path, configuration: Path) -> None:
    """Write the results of CONFIGURATION to ARCHIVE, or put those in ARCHIVE into its store."""
    if what == "write":
        click.echo(f"{write(archive, configuration)} files are in {archive}")
    else:
        count = restore(archive, load(configuration).results)
        click.echo(f"{count} results are new here. Make what you want to see: it takes them")


if __name__ == "__main__":
    try:
        main.main(standalone_mode=True)
    except (BundleError, ValueError, OSError) as error:
        sys.exit(str(error))
