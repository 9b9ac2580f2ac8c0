"""All results in one archive with a manifest, and a checkout that starts from such an archive.

The archive is a plain tar file: results with their times (links to a cache are followed), their
records, Snakemake's notes on them, the configuration, ``codecheck.yml``
(https://codecheck.org.uk/spec/) and ``ro-crate-metadata.json`` that say what they are, and a
checksum of each file. After :func:`restore` the workflow finds nothing to be done.
"""

from __future__ import annotations

import contextlib
import datetime
import hashlib
import io
import os
import shutil
import sys
import tarfile
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import click
import yaml

from ..configuration.load import Configuration, load
from ..datasets.files import replacing
from ..datasets.provenance import versions
from . import crate
from .archives import (
    CHECKSUMS,
    CONFIGURATION,
    CRATE,
    DESCRIPTIONS,
    MANIFEST,
    NOTES,
    BundleError,
    is_note,
    is_taken,
    place,
    refuse_foreign,
    refuse_links,
    unpack,
)
from .crate import Packed

DEFAULT = Path("config", "config.yaml")
NOT_RESULTS = (".tmp", ".checkpoint.npz", ".failed.nc")


def write(archive: Path, configuration: Path, directory: Path = Path()) -> int:
    """Write an archive of all results.

    Parameters
    ----------
    archive : Path
        A new file.
    configuration : Path
        The configuration file the results were made with.
    directory : Path
        Where the workflow runs; the results lie below it.

    Returns
    -------
    int
        The number of files in it.

    Raises
    ------
    BundleError
        If the archive exists already or there are no results.
    """
    settings = load(configuration)
    results = place(settings.results)
    if archive.exists():
        raise BundleError(f"{archive} exists already: remove it or give another name")
    files = list(_result_files(directory, results))
    if not any(path.is_relative_to(directory / results) for path in files):
        raise BundleError(f"there are no results in {directory / results}")
    checksums = {path.relative_to(directory).as_posix(): _checksum(path) for path in files}
    texts = _descriptions(settings, configuration, checksums, directory)
    checksums |= {name: _digest(text) for name, text in texts.items()}
    texts[CHECKSUMS] = "".join(f"{value}  {name}\n" for name, value in checksums.items())
    with replacing(archive) as temporary, tarfile.open(temporary, "w", dereference=True) as tar:
        for name, text in texts.items():
            entry = tarfile.TarInfo(name)
            entry.size, entry.mtime = len(text.encode()), int(time.time())
            tar.addfile(entry, io.BytesIO(text.encode()))
        for path in files:
            entry = tar.gettarinfo(path, path.relative_to(directory).as_posix())
            entry.type, entry.mode = tarfile.REGTYPE, 0o644  # also of a second link to a file
            # what Snakemake takes for the time of a linked file
            entry.mtime = max(path.stat().st_mtime, path.lstat().st_mtime)
            entry.size = path.stat().st_size
            with path.open("rb") as file:
                tar.addfile(entry, file)
    return len(files)


def _descriptions(
    settings: Configuration, configuration: Path, checksums: dict[str, str], directory: Path
) -> dict[str, str]:
    """The texts at the top of an archive, by name: configuration, manifest, research object."""
    created = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")
    texts = {
        CONFIGURATION: configuration.read_text(encoding="utf-8"),
        MANIFEST: _manifest(checksums, created),
    }
    packed = {name: Packed(_digest(text), len(text.encode())) for name, text in texts.items()}
    packed |= {
        name: Packed(checksum, (directory / name).stat().st_size)
        for name, checksum in checksums.items()
        if not is_note(name)
    }
    return texts | {CRATE: crate.text(settings, packed, created)}


def restore(archive: Path, results: str, directory: Path = Path()) -> int:
    """Unpack an archive into a checkout, once every file in it has been found whole.

    Files that are there already, and the same, are left alone.

    Parameters
    ----------
    archive : Path
        Of :func:`write`; it may come from others, and :mod:`.archives` says what it may bring.
    results : str
        The directory of results of the configuration in use; nothing goes elsewhere.
    directory : Path
        Where the workflow runs.

    Returns
    -------
    int
        The number of files that were put in place.

    Raises
    ------
    BundleError
        If the archive is damaged or foreign, or a file in its way is another one.
    """
    if not archive.is_file():
        raise BundleError(f"{archive} does not exist")
    allowed = place(results)
    directory.mkdir(parents=True, exist_ok=True)
    with contextlib.ExitStack() as stack:
        try:
            # not compressed: what is in it can't be larger than it is
            tar = stack.enter_context(tarfile.open(archive, "r:"))
            members = tar.getmembers()
        except (tarfile.TarError, OSError, ValueError, EOFError) as error:
            raise BundleError(f"{archive} is damaged or no archive of results: {error}") from error
        refuse_foreign(members, allowed, archive.stat().st_size)
        _require_space(sum(member.size for member in members), directory)
        unpacked = Path(
            stack.enter_context(tempfile.TemporaryDirectory(dir=directory, prefix=".restore-"))
        )
        checksums = _verified(archive, tar, unpacked)
        names = [name for name in checksums if name not in DESCRIPTIONS]
        refuse_links(names, directory)
        there = [name for name in names if os.path.lexists(directory / name)]
        _refuse_others([name for name in there if not is_note(name)], checksums, directory)
        new = [name for name in names if name not in there]
        for name in new:
            (directory / name).parent.mkdir(parents=True, exist_ok=True)
            (unpacked / name).rename(directory / name)
    return len(new)


def _verified(archive: Path, tar: tarfile.TarFile, unpacked: Path) -> dict[str, str]:
    """The digest of each file of an archive, unpacked and found to be what was packed."""
    try:
        found = dict(unpack(tar, unpacked))
        checksums = _read_checksums(unpacked / CHECKSUMS)
    except (tarfile.TarError, OSError, ValueError, EOFError) as error:
        raise BundleError(f"{archive} is damaged or no archive of results: {error}") from error
    found.pop(CHECKSUMS)
    for name in sorted(found.keys() | checksums.keys()):
        if found.get(name) != checksums.get(name):
            raise BundleError(f"{archive} is damaged: {name} is not what was packed")
    return checksums


def _require_space(size: int, directory: Path) -> None:
    free = shutil.disk_usage(directory).free
    if size > free:
        raise BundleError(
            f"No space left on device: the archive holds {size / 1e6:.0f} MB, and there are "
            f"{free / 1e6:.0f} MB in {directory.resolve()}"
        )


def _refuse_others(names: list[str], checksums: dict[str, str], directory: Path) -> None:
    """Refuse an archive if one of the files that are there already is another than its own."""
    differing = [name for name in names if _differs(directory / name, checksums[name])]
    if differing:
        raise BundleError(
            f"{differing[0]} and {len(differing) - 1} other files are here already, and not "
            "those of the archive: move them away"
        )


def _result_files(directory: Path, results: str) -> Iterator[Path]:
    """All finished results and Snakemake's notes on them, without the committed reference set."""
    for root in (directory / results, directory / NOTES):
        for path in sorted(root.rglob("*")):
            taken = is_taken(path.relative_to(directory).as_posix(), results)
            # datasets may be linked to a shared cache; other links may lead to anything
            own = path.is_file() and (path.suffix == ".nc" or not path.is_symlink())
            if taken and own and not path.name.endswith(NOT_RESULTS):
                yield path


def _manifest(checksums: dict[str, str], created: str) -> str:
    """The text of ``codecheck.yml``."""
    named = [name for name in checksums if not is_note(name)]
    about = {
        "version": "https://codecheck.org.uk/spec/config/1.0/",
        "paper": {
            "title": "Critical nucleation length for accelerating frictional slip",
            "authors": [
                {"name": name}
                for name in (
                    "Michael Aldam", "Marc Weikamp", "Robert Spatschek", "Efim A. Brener",
                    "Eran Bouchbinder",
                )
            ],
            "reference": "https://doi.org/10.1002/2017GL074939",
        },
        "manifest": [{"file": name, "sha256": checksums[name]} for name in named],
        "summary": "Results of the replication; `make restore FILE=...` puts them in place",
        "created": created,
        "versions": versions(),
    }  # fmt: skip
    return yaml.safe_dump(about, sort_keys=False, allow_unicode=True)


def _read_checksums(path: Path) -> dict[str, str]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return {name: value for value, name in (line.split("  ", 1) for line in lines)}


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _checksum(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _differs(path: Path, checksum: str) -> bool:
    return not path.is_file() or _checksum(path) != checksum


@click.group()
def main() -> None:
    """Archives of all results."""


@main.command("write")
@click.argument("archive", type=click.Path(path_type=Path))
@click.argument("configuration", type=click.Path(path_type=Path), default=DEFAULT)
def write_command(archive: Path, configuration: Path) -> None:
    """Write all results of CONFIGURATION to ARCHIVE."""
    click.echo(f"{write(archive, configuration)} files are in {archive}")


@main.command("restore")
@click.argument("archive", type=click.Path(path_type=Path))
@click.argument("configuration", type=click.Path(path_type=Path), default=DEFAULT)
def restore_command(archive: Path, configuration: Path) -> None:
    """Put the results in ARCHIVE in place, where CONFIGURATION (config/config.yaml) has them."""
    count = restore(archive, load(configuration).results)
    click.echo(f"{count} files were put in place from {archive}")


if __name__ == "__main__":
    try:
        main.main(standalone_mode=True)
    except (BundleError, ValueError, OSError) as error:
        sys.exit(str(error))
