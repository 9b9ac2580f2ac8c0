"""Disks that are full and directories that can't be written."""

import contextlib
import os
import random
import resource
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from harness import IDS, Place, Reference
from processes import Done, require
from registry import fault, says


def _failed_for_want_of_space(done: Done, place: Place, id: str) -> None:
    said = done.output + place.log(id)
    require(done.status != 0, "it ended well without space")
    clear = any(text in said for text in ("No space left on device", "File too large"))
    require(clear, f"it does not say that space is lacking: {said[-1500:]}")
    places = (place.store.directory, place.checkpoint(id).parent)
    left = [path.name for directory in places for path in directory.glob(".*.tmp")]
    require(not left, f"halves of files were left: {left}")
    require(not place.simulation(id).exists(), "there is a result")


def _small_disk(place: Place, reference: Reference, random: random.Random, id: str):
    """A limit on files' sizes: of a checkpoint, or only of the larger dataset."""
    place.forget(id)
    size = Place(reference.directory).simulation(id).stat().st_size
    limit = random.randrange(30_000, size)
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))


@fault
def full_disk(place, reference, random):
    """Writes fail in the middle of a file."""
    id = random.choice(IDS)
    prepare = _small_disk(place, reference, random, id)
    with place.unharmed():
        _failed_for_want_of_space(place.start_alone(id, prepare).end(), place, id)
        place.run_alone(id)


@fault
def full_disk_of_the_workflow(place, reference, random):
    """The disk of the results fills up under snakemake, which names the job that failed."""
    id = random.choice(IDS)
    prepare = _small_disk(place, reference, random, id)
    with place.unharmed():
        _failed_for_want_of_space(place.start(prepare=prepare).end(), place, id)
        place.finish()


@contextlib.contextmanager
def read_only(directory: Path) -> Iterator[None]:
    """A directory that can't be written to: not even by root, who may mount it so."""
    root = os.geteuid() == 0
    if not root:
        directory.chmod(0o555)
    elif subprocess.run(["mount", "--bind", directory, directory]).returncode != 0:
        pytest.skip("root must be allowed to mount")
    else:
        subprocess.run(["mount", "-o", "remount,bind,ro", directory], check=True)
    try:
        yield
    finally:
        if root:
            subprocess.run(["umount", "--lazy", directory], check=True)
        else:
            directory.chmod(0o755)


@fault
def read_only_results(place, reference, random):
    id = random.choice(IDS)
    place.forget(id)
    with place.unharmed():
        with read_only(place.results):
            says(place.run(), "is not writable", "Read-only file system", "Permission denied")
        place.finish()


@fault
def read_only_store(place, reference, random):
    """A directory below the results, which a job finds once it has made its own."""
    id = random.choice(IDS)
    place.forget(id)
    with place.unharmed():
        with read_only(place.store.directory):
            done = place.start_alone(id).end()
            said = done.output + place.log(id)
            clear = ("Read-only file system", "Permission denied", "Operation not permitted")
            require(done.status != 0, "it ended well")
            require(any(text in said for text in clear), f"no clear error: {said}")
        place.run_alone(id)


@fault
def file_in_place_of_the_results(place, reference, random):
    aside = place.results.rename(place.directory / "aside")
    place.results.write_text("not a directory")
    says(place.run(), "is no directory")
    require(place.results.read_text() == "not a directory", "the file was touched")
    place.results.unlink()
    aside.rename(place.results)
