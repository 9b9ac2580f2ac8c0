"""Files that are damaged or foreign: entries of stores, checkpoints, notes."""

import functools
import os
import random
import shutil
from collections.abc import Callable
from pathlib import Path

from harness import IDS, Place, Reference
from processes import require
from registry import FAULTS, fault

from nucleation.pipeline.store import NOTE, read_note


def _write(path: Path, content: bytes) -> None:
    path.chmod(0o644)  # entries of stores are read-only
    path.write_bytes(content)


def truncate(path: Path, random: random.Random) -> None:
    """Cut off a random part of the end."""
    content = path.read_bytes()
    _write(path, content[: random.randrange(len(content))])


def flip(path: Path, random: random.Random) -> None:
    """Change one bit."""
    content = bytearray(path.read_bytes())
    content[random.randrange(len(content))] ^= 1 << random.randrange(8)
    _write(path, content)


def zero(path: Path, random: random.Random) -> None:
    """Blocks that a computer without power never wrote are zeros."""
    content = bytearray(path.read_bytes())
    begin = random.randrange(len(content))
    content[begin : begin + 4096] = bytes(len(content[begin : begin + 4096]))
    _write(path, content)


def _without_a_trace(path: Path, damage: Callable, random: random.Random) -> None:
    """Damage as by a failing disk, that leaves the time of the last change as it was."""
    before = path.stat()
    damage(path, random)
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


def _damaged_entry(place: Place, reference: Reference, random: random.Random, damage) -> None:
    """Check lists it; nothing is made from it, and it is made again."""
    entry = place.store.entry(random.choice(place.store.listed()))
    path = entry / random.choice([*read_note(entry)["files"], NOTE])
    if random.choice((True, False)):
        _without_a_trace(path, damage, random)
    else:
        damage(path, random)
    listed = any(f.path == entry and f.state in ("damaged", "foreign") for f in place.findings())
    if not listed:  # a bit without meaning, in what a note says of the rest
        require(path.name == NOTE, f"check does not list the damaged {path}")
        return
    if random.choice((True, False)):
        place.forget_tables()
    place.finish()


def _bad_checkpoint(place: Place, id: str, *, refused: bool | None) -> None:
    """Run on from a checkpoint that must be refused, or used, or (None) may be either."""
    place.forget(id)
    with place.unharmed():
        place.run_alone(id)
    said = place.log(id)
    if refused is not None:
        expected = "the run starts at the beginning" if refused else "the run goes on from"
        require(expected in said, f"it does not say {expected!r}: {said}")


def _stopped(place: Place, reference: Reference, id: str) -> Path:
    """A checkpoint in the middle of the run."""
    name = place.checkpoint(id).name
    return Path(shutil.copy2(reference.checkpoints / name, place.checkpoint(id)))


def _damaged_checkpoint(
    place: Place, reference: Reference, random: random.Random, damage, refused: bool | None
) -> None:
    id = random.choice(IDS)
    damage(_stopped(place, reference, id), random)
    return _bad_checkpoint(place, id, refused=refused)


@fault
def checkpoint_of_other_parameters(place, reference, random):
    one, other = random.sample(IDS, 2)
    shutil.copy2(reference.checkpoints / place.checkpoint(other).name, place.checkpoint(one))
    return _bad_checkpoint(place, one, refused=True)


@fault
def checkpoint_after_the_end(place, reference, random):
    """A kill after the dataset and before the checkpoint's removal leaves one, which is used."""
    id = random.choice(IDS)
    _stopped(place, reference, id)
    return _bad_checkpoint(place, id, refused=False)


for _damage in (truncate, flip, zero):
    FAULTS[f"{_damage.__name__}_entry"] = functools.partial(_damaged_entry, damage=_damage)
    FAULTS[f"{_damage.__name__}_checkpoint"] = functools.partial(
        _damaged_checkpoint, damage=_damage, refused=True if _damage is truncate else None
    )  # not all bits matter


@fault
def lost_notes(place, reference, random):
    """The directory .snakemake is removed, or a random note in it is cut or emptied."""
    place.forget(IDS[0])
    if random.random() < 0.5:
        shutil.rmtree(place.directory / ".snakemake")
    else:
        notes = sorted((place.directory / ".snakemake" / "metadata").rglob("*"))
        note = random.choice([path for path in notes if path.is_file()])
        truncate(note, random)
    with place.unharmed():
        place.finish()
