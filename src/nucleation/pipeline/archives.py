"""What an archive may put in place: it comes from others, and a checkout runs what lies in it.

A checkout executes much of what is in it: modules, git's hooks, profiles, ``sitecustomize.py``. So
an archive's names, kinds and sizes are looked at before anything of it is written, and what is not
a plain result, its record or one of Snakemake's notes on it is refused by name. Nothing in it is
followed, executed or parsed here; it only gets copied, and its checksums compared.
"""

from __future__ import annotations

import base64
import binascii
import hashlib
import os
import tarfile
import time
from collections.abc import Iterable, Iterator
from pathlib import Path, PurePosixPath

from ..configuration.contradictions import CODE
from .keys import RECORDS

NOTES = ".snakemake/metadata"  # Snakemake's, of what made each file
CHECKSUMS = "manifest-sha256.txt"
MANIFEST = "codecheck.yml"
CRATE = "ro-crate-metadata.json"
CONFIGURATION = "config.yaml"
DESCRIPTIONS = (CONFIGURATION, MANIFEST, CRATE, CHECKSUMS)
"""Files at the top of an archive, which tell about it and stay in it."""

RESULTS = (
    ".nc", ".csv", ".json", ".md", ".html", ".pdf", ".png", ".gif", ".log", ".tsv", ".txt", ".tex",
)  # fmt: skip
"""Endings of the files that the workflow makes; none that Python, a shell or git would run."""

LARGEST_DESCRIPTION = 2**26  # bytes; the checksums of a hundred thousand files take 15 MB
BLOCK = 2**20


class BundleError(ValueError):
    """An archive that can't be written, or is damaged, or would replace what is there."""


def place(results: str) -> str:
    """The directory of results in a form that names in an archive can be compared with.

    Raises
    ------
    BundleError
        If it is absolute, leads out of the directory of the workflow, or is one that code lies in.
    """
    path = PurePosixPath(results)
    if path.is_absolute():
        raise BundleError(
            f"results = {results!r} lies outside of the directory of the workflow, and an archive "
            "holds what is in it: name it by a relative path, or copy that directory as it is"
        )
    parts = path.parts
    own = not parts or parts[0] in CODE or any(part.startswith(".") for part in parts)
    if own or _problem_of_name(path.as_posix()):
        raise BundleError(
            f"results = {results!r} is no place for an archive: it must be a directory of its own, "
            f"not the checkout itself, none that begins with a dot, and not {', '.join(CODE)}"
        )
    return path.as_posix()


def refuse_foreign(members: Iterable[tarfile.TarInfo], results: str, size: int) -> None:
    """Refuse an archive by its list of members.

    Parameters
    ----------
    members : of the archive.
    results : directory of the results, from :func:`place`.
    size : of the archive (bytes).

    Raises
    ------
    BundleError
        Naming what has no place among the results, or is more than the archive can hold.
    """
    seen: set[str] = set()
    problems: list[str] = []
    for member in members:
        problem = _problem(member, results) or (member.name in seen and "it is in there twice")
        if problem:
            problems.append(f"{member.name!r}: {problem}")
        seen.add(member.name)
        size -= member.size
    if size < 0:
        problems.append("its members are larger than itself")
    if problems:
        more = f", and {len(problems) - 5} more" if len(problems) > 5 else ""
        listing = "".join(f"\n  - {problem}" for problem in problems[:5])
        raise BundleError(f"the archive is refused, nothing was put in place:{listing}{more}")


def _problem(member: tarfile.TarInfo, results: str) -> str | None:
    """Why a member can't be put in place, or None."""
    # neither links and devices, nor sparse files, whose size in the archive says nothing
    if member.type not in (tarfile.REGTYPE, tarfile.AREGTYPE) or member.issparse():
        return "only plain files are taken, no directories, links and devices"
    if member.name in DESCRIPTIONS:
        return "it is too large" if member.size > LARGEST_DESCRIPTION else None
    return _problem_of_place(member.name, results)


def is_note(name: str) -> bool:
    """Whether a file of an archive tells of a result and is none: Snakemake's notes, records."""
    return name.startswith(f"{NOTES}/") or RECORDS in PurePosixPath(name).parts


def is_taken(name: str, results: str) -> bool:
    """Whether a file belongs into an archive, and may come out of one."""
    return _problem_of_place(name, results) is None


def _problem_of_place(name: str, results: str) -> str | None:
    """Why a file is neither a result nor a note on one, or None."""
    problem = _problem_of_name(name)
    if problem is not None:
        return problem
    if name.startswith(f"{NOTES}/"):
        subject = subject_of(name)
        if subject is None or _problem_of_result(subject, results):
            return f"it is no note of Snakemake's on a file below {results}"
        return None
    return _problem_of_result(name, results)


def _problem_of_name(name: str) -> str | None:
    """What is wrong with a name, wherever it leads."""
    path = PurePosixPath(name)
    if path.is_absolute() or ".." in path.parts or path.as_posix() != name:
        return "it must be a relative path in its shortest form"
    if not name.isprintable() or "\\" in name:
        return "it holds control characters or a backslash"
    return None


def _problem_of_result(name: str, results: str) -> str | None:
    """Why a file is none of the results, or None."""
    path = PurePosixPath(name)
    if _problem_of_name(name) or not name.startswith(f"{results}/"):
        return f"it does not lie below the configuration's results, {results}"
    below = path.relative_to(results).parts
    if below[:-1].count(RECORDS) == 1 and path.suffix == ".json":  # of the file whose name it has
        number = below.index(RECORDS)
        vouched = PurePosixPath(results, *below[:number], *below[number + 1 :]).with_suffix("")
        return _problem_of_result(str(vouched), results)
    if below[0] == "reference":
        return "the reference set belongs to the checkout"
    if any(part.startswith(".") for part in below) or path.suffix not in RESULTS:
        return f"results are files {', '.join(RESULTS)}"
    return None


def subject_of(note: str) -> str | None:
    """The file that one of Snakemake's notes is about: its path in base64 names the note."""
    *pieces, last = PurePosixPath(note).relative_to(NOTES).parts
    if not all(piece.startswith("@") for piece in pieces):
        return None
    text = "".join([*(piece[1:] for piece in pieces), last])
    try:
        return base64.b64decode(text, altchars=b"-_", validate=True).decode()
    except (binascii.Error, ValueError):
        return None


def refuse_links(names: Iterable[str], directory: Path) -> None:
    """Refuse names whose directory leads out of `directory`, over a link that is there already."""
    top = directory.resolve()
    for parent in {(directory / name).parent for name in names}:
        if not parent.resolve().is_relative_to(top):
            raise BundleError(
                f"{parent} leads out of {top}, to {parent.resolve()}: nothing is put there"
            )


def unpack(tar: tarfile.TarFile, directory: Path) -> Iterator[tuple[str, str]]:
    """Copy all members to a new directory, as plain files that nobody may execute.

    Yields
    ------
    name, digest
        Of each member, SHA-256.
    """
    now = time.time()
    for member in tar:
        target = directory / member.name
        target.parent.mkdir(parents=True, exist_ok=True)
        summary, source = hashlib.sha256(), tar.extractfile(member)
        assert source is not None  # of a plain file there is one
        with target.open("xb") as file:
            while block := source.read(BLOCK):
                summary.update(block)
                file.write(block)
        if target.stat().st_size != member.size:
            raise EOFError(f"{member.name} is cut off")
        moment = min(max(float(member.mtime), 0.0), now)  # Snakemake stops at times to come
        os.utime(target, (moment, moment))
        yield member.name, summary.hexdigest()
