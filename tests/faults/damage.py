"""Files that are damaged, disks that are full or read-only, clocks, and others at work."""

import contextlib
import datetime
import os
import random
import resource
import shutil
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from harness import (
    CONFIG,
    IDS,
    OTHER,
    Place,
    configure,
    fault,
    others,
    require_nothing_made,
    require_same,
    says,
)
from processes import require

from replication.pipeline.store import NOTE, read_note


def truncate(content: bytearray, random: random.Random) -> None:
    """Cut off a random part of the end."""
    del content[random.randrange(len(content)) :]


def flip(content: bytearray, random: random.Random) -> None:
    """Change one bit."""
    content[random.randrange(len(content))] ^= 1 << random.randrange(8)


def zero(content: bytearray, random: random.Random) -> None:
    """Blocks that a computer without power never wrote are zeros."""
    begin = random.randrange(len(content))
    content[begin : begin + 4096] = bytes(len(content[begin : begin + 4096]))


DAMAGE = (truncate, flip, zero)


def damage(path: Path, how: Callable, random: random.Random) -> None:
    """Damage a file in one of these ways."""
    content = bytearray(path.read_bytes())
    how(content, random)
    path.chmod(0o644)  # entries of stores are read-only
    path.write_bytes(content)


@fault
def damaged_entry(place, reference, random):
    """Check lists it; nothing is made from it, and it is made again."""
    entry = place.store.entry(random.choice(place.store.listed()))
    path = entry / random.choice([*read_note(entry)["files"], NOTE])
    before = path.stat()
    damage(path, random.choice(DAMAGE), random)
    if random.choice((True, False)):  # as by a failing disk, that leaves its time as it was
        os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))
    listed = any(
        path == entry and state in ("damaged", "foreign") for path, state, _ in place.findings()
    )
    if not listed:  # a bit without meaning, in what a note says of the rest
        require(path.name == NOTE, f"check does not list the damaged {path}")
        return
    if random.choice((True, False)):
        place.forget_tables()
    place.finish()


@fault
def lost_notes(place, reference, random):
    """The directory .snakemake is removed, or a random note in it is cut or emptied."""
    place.forget(IDS[0])
    if random.random() < 0.5:
        shutil.rmtree(place.directory / ".snakemake")
    else:
        notes = sorted((place.directory / ".snakemake" / "metadata").rglob("*"))
        note = random.choice([path for path in notes if path.is_file()])
        damage(note, truncate, random)
    with place.unharmed():
        place.finish()


@fault
def full_disk(place, reference, random):
    """Writes fail in the middle of a checkpoint, or only of the larger dataset."""
    id = random.choice(IDS)
    size = place.simulation(id).stat().st_size
    limit = random.randrange(30_000, size)
    place.forget(id)

    def prepare() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    with place.unharmed():
        done = place.start(prepare=prepare).end()
        said = done.output + place.log(id)
        require(done.status != 0, "it ended well without space")
        clear = any(text in said for text in ("No space left on device", "File too large"))
        require(clear, f"it does not say that space is lacking: {said[-1500:]}")
        places = (place.store.directory, place.checkpoint(id).parent)
        left = [path.name for directory in places for path in directory.glob(".*.tmp")]
        require(not left, f"halves of files were left: {left}")
        require(not place.simulation(id).exists(), "there is a result")
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
def two_snakemakes(place, reference, random):
    """The second stops and says why; the first goes on."""
    place.forget(random.choice(IDS))
    with place.unharmed():
        first = place.start()
        locks = place.directory / ".snakemake" / "locks"
        require(first.wait_for(lambda: any(locks.glob("*"))), "it ended without a lock")
        second = place.run()
        running = not first.ended()
        done = first.end()
        require(done.status == 0, done.output)
        if running:
            says(second, "locked", ".snakemake/locks/")  # the second: removed as it was met


@fault
def two_directories_with_one_store(place, reference, random):
    """Two working directories with other parameters and one place of results, at once."""
    whole = others(reference.directory.parent)
    place.forget(*IDS)
    place.forget_tables()
    second = Place(place.directory.parent / f"{place.directory.name}.second")
    second.directory.mkdir()
    for one, config in ((place, CONFIG), (second, OTHER)):
        configure(one, {**config, "results": str(place.results)})
    with place.unharmed():
        first = place.start()
        if random.choice((True, False)):
            first.spend(random.uniform(0.0, 1.0) * reference.cpu)
        ended = [running.end() for running in (first, second.start())]
        for done in ended:
            require(done.status == 0, done.output)
        require_same(place.contents(), reference.contents | whole)
        require(whole.keys() <= place.contents().keys(), "a result of the second is not there")
        configure(place, CONFIG)
        place.finish()  # both have laid files of one name, and each taken away the other's
        require_nothing_made(place.run())
    shutil.rmtree(second.directory)
    place.prune()


DAY = datetime.timedelta(days=1).total_seconds()


@fault
def times_at_random(place, reference, random):
    """As after a copy from machines whose clocks differ, or after a clock was set back."""
    place.forget(random.choice(IDS))
    for path in sorted(place.results.rglob("*")):
        then = time.time() + DAY * random.choice((-20000, -1, 0, 1, 4000))
        with contextlib.suppress(FileNotFoundError):  # a temporary one
            os.utime(path, (then, then))
    with place.unharmed():
        place.finish()
