"""Files that are damaged or foreign: entries of stores, checkpoints, notes."""

from __future__ import annotations

import functools
import os
import random
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
from harness import IDS, Place, Reference
from processes import require
from registry import CLEAR_ERROR, RECOVERED, fault

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


def _damaged_entry(place: Place, reference: Reference, random: random.Random, damage) -> str:
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
        place.require_same(reference)
        return RECOVERED
    if random.choice((True, False)):
        place.forget_tables()
    stopped = place.finish()
    return CLEAR_ERROR if stopped else RECOVERED


def _bad_checkpoint(place: Place, id: str, *, refused: bool | None) -> str:
    """Run on from a checkpoint that must be refused, or used, or (None) may be either."""
    place.forget(id)
    with place.unharmed():
        place.run_alone(id)
    said = place.log(id)
    if refused is not None:
        expected = "the run starts at the beginning" if refused else "the run goes on from"
        require(expected in said, f"it does not say {expected!r}: {said}")
    return RECOVERED


def _stopped(place: Place, reference: Reference, id: str) -> Path:
    """A checkpoint in the middle of the run."""
    name = place.checkpoint(id).name
    return Path(shutil.copy2(reference.checkpoints / name, place.checkpoint(id)))


def _damaged_checkpoint(
    place: Place, reference: Reference, random: random.Random, damage, refused: bool | None
) -> str:
    id = random.choice(IDS)
    damage(_stopped(place, reference, id), random)
    return _bad_checkpoint(place, id, refused=refused)


@fault("foreign checkpoint")
def checkpoint_of_other_parameters(place, reference, random):
    one, other = random.sample(IDS, 2)
    shutil.copy2(reference.checkpoints / place.checkpoint(other).name, place.checkpoint(one))
    return _bad_checkpoint(place, one, refused=True)


@fault("foreign checkpoint")
def checkpoint_of_other_code(place, reference, random):
    """Its arrays are right, only the fingerprint is another."""
    id = random.choice(IDS)
    path = _stopped(place, reference, id)
    with np.load(path) as stored:
        arrays = dict(stored)
    arrays["fingerprint"] = np.array(f"{random.getrandbits(256):x}")
    np.savez(path, **arrays)
    return _bad_checkpoint(place, id, refused=True)


@fault("foreign checkpoint")
def checkpoint_after_the_end(place, reference, random):
    """A kill after the dataset and before the checkpoint's removal leaves one, which is used."""
    id = random.choice(IDS)
    _stopped(place, reference, id)
    return _bad_checkpoint(place, id, refused=False)


def _damaged_elsewhere(place: Place, reference: Reference, random: random.Random, damage) -> str:
    """Fill another store, damage its entry, and ask for the result again."""
    other = place.directory.parent / f"{place.directory.name}.store"
    other.mkdir()
    variables = {"NUCLEATION_STORES": str(other)}
    try:
        place.forget(IDS[0])
        require((done := place.run("simulations", **variables)).status == 0, done.output)
        (entry,) = other.iterdir()
        damage(random.choice([*entry.iterdir()]), random)
        place.forget(IDS[0])
        require(not place.finish(**variables), "a damaged entry elsewhere stopped it")
        place.require_same(reference)
    finally:
        shutil.rmtree(other)
    return RECOVERED


_cut_checkpoint = functools.partial(_damaged_checkpoint, refused=True)
_changed_checkpoint = functools.partial(_damaged_checkpoint, refused=None)  # not all bits matter

for _name, _kind, _harm, _damage in (
    ("truncated_entry", "damaged entry", _damaged_entry, truncate),
    ("flipped_entry", "damaged entry", _damaged_entry, flip),
    ("zeroed_entry", "damaged entry", _damaged_entry, zero),
    ("truncated_checkpoint", "damaged checkpoint", _cut_checkpoint, truncate),
    ("flipped_checkpoint", "damaged checkpoint", _changed_checkpoint, flip),
    ("zeroed_checkpoint", "damaged checkpoint", _changed_checkpoint, zero),
    ("truncated_entry_elsewhere", "damaged entry elsewhere", _damaged_elsewhere, truncate),
    ("flipped_entry_elsewhere", "damaged entry elsewhere", _damaged_elsewhere, flip),
):
    fault(_kind, _name)(functools.partial(_harm, damage=_damage))


@fault("damaged notes of snakemake")
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
    return RECOVERED
