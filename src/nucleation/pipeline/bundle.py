"""All results in one archive with a manifest, and a checkout that starts from such an archive.

The archive is a plain tar file: results with their times (links are followed), Snakemake's notes
on them, the configuration, ``codecheck.yml`` (https://codecheck.org.uk/spec/) that says what they
are, and a checksum of each file. After :func:`restore` the workflow finds nothing to be done.
"""

from __future__ import annotations

import datetime
import hashlib
import io
import os
import shutil
import sys
import tarfile
import tempfile
from collections.abc import Iterator
from pathlib import Path

import click
import yaml

from ..configuration.load import load
from ..datasets.files import replacing
from ..datasets.provenance import versions

MANIFEST = "codecheck.yml"
CHECKSUMS = "manifest-sha256.txt"
NOTES = ".snakemake/metadata"  # Snakemake's, of what made each file
NOT_RESULTS = (".tmp", ".checkpoint.npz", ".failed.nc")


class BundleError(ValueError):
    """An archive that can't be written, or is damaged, or would replace what is there."""


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
    results = load(configuration).results
    if archive.exists():
        raise BundleError(f"{archive} exists already: remove it or give another name")
    if Path(results).is_absolute():
        raise BundleError(f"results = {results!r} lies outside of the directory of the workflow")
    files = list(_result_files(directory, results))
    if not any(path.is_relative_to(directory / results) for path in files):
        raise BundleError(f"there are no results in {directory / results}")
    checksums = {str(path.relative_to(directory)): _checksum(path) for path in files}
    texts = {
        "config.yaml": configuration.read_text(encoding="utf-8"),
        MANIFEST: _manifest(checksums),
    }
    checksums |= {name: hashlib.sha256(text.encode()).hexdigest() for name, text in texts.items()}
    texts[CHECKSUMS] = "".join(f"{value}  {name}\n" for name, value in checksums.items())
    with replacing(archive) as temporary, tarfile.open(temporary, "w", dereference=True) as tar:
        for name, text in texts.items():
            entry = tarfile.TarInfo(name)
            entry.size = len(text.encode())
            tar.addfile(entry, io.BytesIO(text.encode()))
        for path in files:
            entry = tar.gettarinfo(path, str(path.relative_to(directory)))
            # what Snakemake takes for the time of a linked file
            entry.mtime = max(path.stat().st_mtime, path.lstat().st_mtime)
            with path.open("rb") as file:
                tar.addfile(entry, file)
    return len(files)


def restore(archive: Path, directory: Path = Path()) -> int:
    """Unpack an archive into a checkout, once every file in it has been found whole.

    Files that are there already, and the same, are left alone.

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
    directory.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=directory, prefix=".restore-") as temporary:
        unpacked = Path(temporary)
        try:
            with tarfile.open(archive) as tar:
                tar.extractall(unpacked, filter="data")
            checksums = _read_checksums(unpacked / CHECKSUMS)
        except (tarfile.TarError, OSError, ValueError, EOFError) as error:
            raise BundleError(f"{archive} is damaged or no archive of results: {error}") from error
        for name, value in checksums.items():
            if not (unpacked / name).is_file() or _checksum(unpacked / name) != value:
                raise BundleError(f"{archive} is damaged: {name} is not what was packed")
        names = [name for name in checksums if name not in ("config.yaml", MANIFEST)]
        there = [name for name in names if os.path.lexists(directory / name)]
        results = [name for name in there if not name.startswith(NOTES)]
        differing = [name for name in results if _differs(directory / name, checksums[name])]
        if differing:
            raise BundleError(
                f"{differing[0]} and {len(differing) - 1} other files are here already, and not "
                "those of the archive: move them away"
            )
        new = [name for name in names if name not in there]
        for name in new:
            (directory / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.move(unpacked / name, directory / name)
    return len(new)


def _result_files(directory: Path, results: str) -> Iterator[Path]:
    """All finished results and Snakemake's notes, without the committed reference set."""
    reference = directory / results / "reference"
    for root in (directory / results, directory / NOTES):
        for path in sorted(root.rglob("*")):
            finished = not path.name.endswith(NOT_RESULTS)
            if path.is_file() and finished and not path.is_relative_to(reference):
                yield path


def _manifest(checksums: dict[str, str]) -> str:
    """The text of ``codecheck.yml``."""
    named = [name for name in checksums if not name.startswith(NOTES)]
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
        "created": datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds"),
        "versions": versions(),
    }  # fmt: skip
    return yaml.safe_dump(about, sort_keys=False, allow_unicode=True)


def _read_checksums(path: Path) -> dict[str, str]:
    pairs = (line.split("  ", 1) for line in path.read_text(encoding="utf-8").splitlines())
    checksums = {name: value for value, name in pairs}
    if any(Path(name).is_absolute() or ".." in Path(name).parts for name in checksums):
        raise ValueError("its manifest names files outside of it")
    return checksums


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
@click.argument("configuration", type=click.Path(path_type=Path, exists=True))
def write_command(archive: Path, configuration: Path) -> None:
    """Write all results of CONFIGURATION to ARCHIVE."""
    click.echo(f"{write(archive, configuration)} files are in {archive}")


@main.command("restore")
@click.argument("archive", type=click.Path(path_type=Path))
def restore_command(archive: Path) -> None:
    """Put the results in ARCHIVE in place."""
    click.echo(f"{restore(archive)} files were put in place from {archive}")


if __name__ == "__main__":
    try:
        main.main(standalone_mode=True)
    except (BundleError, ValueError) as error:
        sys.exit(str(error))
