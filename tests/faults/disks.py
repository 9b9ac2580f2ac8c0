"""Disks that are full and directories that can't be written."""

from __future__ import annotations

import contextlib
import os
import resource
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

from harness import IDS, Place, Reference
from processes import Done, require
from registry import CLEAR_ERROR, fault, says

PAGE = os.sysconf("SC_PAGE_SIZE")


@contextlib.contextmanager
def _mounted(directory: Path, *options: str) -> Iterator[bool]:
    """Something mounted on a directory, if this user may; else nothing is done."""
    done = subprocess.run(["mount", *options, str(directory)], capture_output=True)
    try:
        yield done.returncode == 0
    finally:
        if done.returncode == 0:
            subprocess.run(["umount", "--lazy", str(directory)], check=True)


def _size_of_result(reference: Reference, id: str) -> int:
    return Place(reference.directory).simulation(id).stat().st_size


def _failed_for_want_of_space(done: Done, place: Place, id: str) -> None:
    said = done.output + place.log(id)
    require(done.status != 0, "it ended well without space")
    clear = any(text in said for text in ("No space left on device", "File too large"))
    require(clear, f"it does not say that space is lacking: {said[-1500:]}")
    places = (place.store.directory, place.checkpoint(id).parent)
    left = [path.name for directory in places for path in directory.glob(".*.tmp")]
    require(not left, f"halves of files were left: {left}")
    require(not place.simulation(id).exists(), "there is a result")


@fault("full disk")
def full_disk(place, reference, random):
    """A simulation on a small disk; a limit on files' sizes where no disk can be mounted."""
    id = random.choice(IDS)
    place.forget(id)
    directory, aside = place.store.directory, place.directory / "aside"
    shutil.copytree(directory, aside)
    used = sum(-(-path.stat().st_size // PAGE) * PAGE for path in aside.rglob("*.*"))
    space = used + random.randrange(10_000, _size_of_result(reference, id))
    with _mounted(directory, "-t", "tmpfs", "-o", f"size={space}", "tmpfs") as mounted:
        if not mounted:
            shutil.rmtree(aside)
            return file_size_limit(place, reference, random)
        shutil.copytree(aside, directory, dirs_exist_ok=True)
        with place.unharmed():
            _failed_for_want_of_space(place.start_alone(id).end(), place, id)
            subprocess.run(["mount", "-o", "remount,size=64m", str(directory)], check=True)
            place.run_alone(id)
        shutil.rmtree(aside)
        shutil.copytree(directory, aside)
    shutil.copytree(aside, directory, dirs_exist_ok=True)
    shutil.rmtree(aside)
    return CLEAR_ERROR


@fault("full disk")
def file_size_limit(place, reference, random):
    """Writes fail in the middle of a file: of a checkpoint, or only of the larger dataset."""
    id = random.choice(IDS)
    place.forget(id)
    limit = random.randrange(30_000, _size_of_result(reference, id))

    def prepare():
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    with place.unharmed():
        _failed_for_want_of_space(place.start_alone(id, prepare).end(), place, id)
        place.run_alone(id)
    return CLEAR_ERROR


@fault("full disk")
def full_disk_of_the_workflow(place, reference, random):
    """The disk of the results fills up under snakemake, which names the job that failed."""
    id = random.choice(IDS)
    limit = random.randrange(30_000, _size_of_result(reference, id))
    place.forget(id)

    def prepare():
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    with place.unharmed():
        done = place.start(prepare=prepare).end()
        _failed_for_want_of_space(done, place, id)
        place.finish()
    return CLEAR_ERROR


@contextlib.contextmanager
def read_only(directory: Path) -> Iterator[None]:
    """A directory that can't be written to: not even by root, who may mount it so."""
    if os.geteuid() != 0:
        directory.chmod(0o555)
        try:
            yield
        finally:
            directory.chmod(0o755)
        return
    with _mounted(directory, "--bind", str(directory)) as mounted:
        if not mounted:  # root of a container without the right to mount
            subprocess.run(["chattr", "+i", str(directory)], check=True)
            try:
                yield
            finally:
                subprocess.run(["chattr", "-i", str(directory)], check=True)
            return
        subprocess.run(["mount", "-o", "remount,bind,ro", str(directory)], check=True)
        yield


@fault("read-only results")
def read_only_results(place, reference, random):
    id = random.choice(IDS)
    place.forget(id)
    with place.unharmed():
        with read_only(place.results):
            says(place.run(), "is not writable", "Read-only file system", "Permission denied")
        place.finish()
    return CLEAR_ERROR


@fault("read-only results")
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
    return CLEAR_ERROR


@fault("read-only results")
def file_in_place_of_the_results(place, reference, random):
    aside = place.results.rename(place.directory / "aside")
    place.results.write_text("not a directory")
    says(place.run(), "is no directory")
    require(place.results.read_text() == "not a directory", "the file was touched")
    place.results.unlink()
    aside.rename(place.results)
    return CLEAR_ERROR
