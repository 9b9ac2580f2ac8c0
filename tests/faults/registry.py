"""What can go wrong, each as a function that does it and then what a user would do next.

A fault gets a copy of the undisturbed workflow and a source of random numbers. It returns how the
disturbance ended, and leaves a workflow that is finished again: the caller compares the datasets.
It raises :class:`harness.Lost` if something was damaged, or if it ended without a clear error.
"""

from __future__ import annotations

import contextlib
import datetime
import os
import random
import resource
import shutil
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from harness import IDS, Done, Place, Reference, Running, processor_time, require

RECOVERED = "recovered"
CLEAR_ERROR = "clear error"
"""It stopped with a message that names what is wrong, and was finished once that was removed."""

Fault = Callable[[Place, Reference, random.Random], str]
FAULTS: dict[str, tuple[str, Fault]] = {}
"""Kind and function of each fault, by name."""


def fault(kind: str) -> Callable[[Fault], Fault]:
    """Enter a function into the registry."""

    def enter(function: Fault) -> Fault:
        FAULTS[function.__name__] = (kind, function)
        return function

    return enter


# Kills. The moment is a random part of the processor time that an undisturbed run takes.


def _stop_alone(
    place: Place, reference: Reference, random: random.Random, number: signal.Signals
) -> str:
    """Signals, up to three times, to a simulation's script, which is then run to its end."""
    id = random.choice(IDS)
    place.simulation(id).unlink()
    with place.unharmed():
        for _ in range(random.choice((1, 1, 1, 3))):
            running = place.start_alone(id)
            if running.spend(random.uniform(0.3, 1.0) * reference.alone):
                running.signal(number)
            done = running.end()
            require(done.status != 0 or place.simulation(id).exists(), "it left no result")
            begun = "starts at the beginning" in place.log(id)
            require(not begun, f"a checkpoint was refused: {place.log(id)}")
        if not place.simulation(id).exists():
            require((done := place.run_alone(id)).status == 0, done.output + place.log(id))
    return RECOVERED


@fault("SIGKILL of a simulation")
def sigkill_simulation(place, reference, random):
    return _stop_alone(place, reference, random, signal.SIGKILL)


@fault("SIGTERM")
def sigterm_simulation(place, reference, random):
    return _stop_alone(place, reference, random, signal.SIGTERM)


@fault("Ctrl-C")
def sigint_simulation(place, reference, random):
    return _stop_alone(place, reference, random, signal.SIGINT)


@fault("SIGHUP")
def sighup_simulation(place, reference, random):
    return _stop_alone(place, reference, random, signal.SIGHUP)


def _stop_workflow(
    place: Place, reference: Reference, random: random.Random, number: signal.Signals, group: bool
) -> str:
    """A signal to snakemake, or to all its processes as from a terminal; then the next steps."""
    gone = random.sample(IDS, random.choice((1, 2)))
    for id in gone:
        place.simulation(id).unlink()
    with place.unharmed():
        running = place.start()
        if running.spend(random.uniform(0.1, 1.0) * reference.workflow):
            running.signal(number, group=group)
        running.end()
        place.finish()
    return RECOVERED


@fault("SIGKILL of a simulation")
def sigkill_simulation_in_workflow(place, reference, random):
    """Snakemake is told of the failure, and says which job it was."""
    id = random.choice(IDS)
    place.simulation(id).unlink()
    with place.unharmed():
        running = place.start()
        moment = random.uniform(0.1, 1.0) * reference.alone
        if running.wait_for(lambda: processor_time(running.scripts()) >= moment):
            for process in running.scripts():
                process.kill()
        done = running.end()
        if done.status == 0:
            return RECOVERED  # the kill came too late
        require(f"{id}.nc" in done.output, f"the failed job is not named: {done.output}")
        place.finish()
    return CLEAR_ERROR


@fault("SIGKILL of snakemake")
def sigkill_snakemake(place, reference, random):
    """Snakemake alone: its simulation goes on while the next workflow begins."""
    return _stop_workflow(place, reference, random, signal.SIGKILL, group=False)


@fault("SIGKILL of snakemake")
def sigkill_snakemake_and_all_its_processes(place, reference, random):
    return _stop_workflow(place, reference, random, signal.SIGKILL, group=True)


@fault("SIGTERM")
def sigterm_snakemake(place, reference, random):
    return _stop_workflow(place, reference, random, signal.SIGTERM, group=False)


@fault("SIGTERM")
def sigterm_snakemake_and_all_its_processes(place, reference, random):
    return _stop_workflow(place, reference, random, signal.SIGTERM, group=True)


@fault("Ctrl-C")
def ctrl_c(place, reference, random):
    return _stop_workflow(place, reference, random, signal.SIGINT, group=True)


@fault("SIGHUP")
def closed_terminal(place, reference, random):
    return _stop_workflow(place, reference, random, signal.SIGHUP, group=True)


@fault("SIGKILL between writing and renaming")
def killed_before_renaming(place, reference, random):
    """Halves of a checkpoint and of a dataset lie there under temporary names."""
    id = random.choice(IDS)
    dataset, checkpoint = place.simulation(id), reference.checkpoints / place.checkpoint(id).name
    for path in (dataset, checkpoint):
        content = path.read_bytes()
        half = dataset.with_name(f".{path.name}.{random.randrange(1, 99999)}.tmp")
        half.write_bytes(content[: random.randrange(len(content))])
    dataset.unlink()
    found = [finding for finding in place.findings() if "half a file" in finding.reason]
    require(len(found) == 2, "check does not list the halves")
    require((done := place.run_alone(id)).status == 0, done.output + place.log(id))
    return RECOVERED


# Disks that are full and directories that can't be written.


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
    left = [path.name for path in place.simulation(id).parent.glob(".*.tmp")]
    require(not left, f"halves of files were left: {left}")
    require(not place.simulation(id).exists(), "there is a result")


@fault("full disk")
def full_disk(place, reference, random):
    """A simulation on a small disk; a limit on files' sizes where no disk can be mounted."""
    id = random.choice(IDS)
    place.simulation(id).unlink()
    directory, aside = place.results / "simulations", place.directory / "aside"
    shutil.copytree(directory, aside)
    used = sum(path.stat().st_size for path in aside.iterdir())
    space = used + random.randrange(10_000, _size_of_result(reference, id))
    with _mounted(directory, "-t", "tmpfs", "-o", f"size={space}", "tmpfs") as mounted:
        if not mounted:
            shutil.rmtree(aside)
            return file_size_limit(place, reference, random)
        shutil.copytree(aside, directory, dirs_exist_ok=True)
        with place.unharmed():
            _failed_for_want_of_space(place.run_alone(id), place, id)
            subprocess.run(["mount", "-o", "remount,size=64m", str(directory)], check=True)
            require((done := place.run_alone(id)).status == 0, done.output + place.log(id))
        shutil.rmtree(aside)
        shutil.copytree(directory, aside)
    shutil.copytree(aside, directory, dirs_exist_ok=True)
    shutil.rmtree(aside)
    return CLEAR_ERROR


@fault("full disk")
def file_size_limit(place, reference, random):
    """Writes fail in the middle of a file: of a checkpoint, or only of the larger dataset."""
    id = random.choice(IDS)
    place.simulation(id).unlink(missing_ok=True)
    limit = random.randrange(30_000, _size_of_result(reference, id))

    def prepare():
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    with place.unharmed():
        _failed_for_want_of_space(place.start_alone(id, prepare).end(), place, id)
        require((done := place.run_alone(id)).status == 0, done.output + place.log(id))
    return CLEAR_ERROR


@fault("full disk")
def full_disk_of_the_workflow(place, reference, random):
    """The disk of the results fills up under snakemake, which names the job that failed."""
    id = random.choice(IDS)
    limit = random.randrange(30_000, _size_of_result(reference, id))
    place.simulation(id).unlink()

    def prepare():
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    with place.unharmed():
        done = place.start(prepare=prepare).end()
        _failed_for_want_of_space(done, place, id)
        place.finish()
    return CLEAR_ERROR


@contextlib.contextmanager
def _read_only(directory: Path) -> Iterator[None]:
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


def _says(done: Done, *texts: str) -> None:
    require(done.status != 0, "it ended well")
    require(any(text in done.output for text in texts), f"no clear error: {done.output[-2000:]}")


@fault("read-only results")
def read_only_results(place, reference, random):
    id = random.choice(IDS)
    place.simulation(id).unlink()
    with place.unharmed():
        with _read_only(place.results):
            _says(place.run(), "is not writable", "Read-only file system", "Permission denied")
        place.finish()
    return CLEAR_ERROR


@fault("read-only results")
def read_only_simulations(place, reference, random):
    """A directory below the results."""
    id = random.choice(IDS)
    place.simulation(id).unlink()
    with place.unharmed():
        with _read_only(place.results / "simulations"):
            done = place.start_alone(id).end()
            said = done.output + place.log(id)
            clear = ("Read-only file system", "Permission denied", "Operation not permitted")
            require(done.status != 0, "it ended well")
            require(any(text in said for text in clear), f"no clear error: {said}")
        require((done := place.run_alone(id)).status == 0, done.output + place.log(id))
    return CLEAR_ERROR


@fault("read-only results")
def file_in_place_of_the_results(place, reference, random):
    aside = place.results.rename(place.directory / "aside")
    place.results.write_text("not a directory")
    _says(place.run(), "is no directory")
    require(place.results.read_text() == "not a directory", "the file was touched")
    place.results.unlink()
    aside.rename(place.results)
    return CLEAR_ERROR


# Damage.


def truncate(path: Path, random: random.Random) -> None:
    """Cut off a random part of the end."""
    content = path.read_bytes()
    path.write_bytes(content[: random.randrange(len(content))])


def flip(path: Path, random: random.Random) -> None:
    """Change one bit."""
    content = bytearray(path.read_bytes())
    content[random.randrange(len(content))] ^= 1 << random.randrange(8)
    path.write_bytes(content)


def zero(path: Path, random: random.Random) -> None:
    """Blocks that a computer without power never wrote are zeros."""
    content = bytearray(path.read_bytes())
    begin = random.randrange(len(content))
    content[begin : begin + 4096] = bytes(len(content[begin : begin + 4096]))
    path.write_bytes(content)


def _without_a_trace(path: Path, damage: Callable, random: random.Random) -> None:
    """Damage as by a failing disk, that leaves the time of the last change as it was."""
    before = path.stat()
    damage(path, random)
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


def _damaged_dataset(place: Place, reference: Reference, random: random.Random, damage) -> str:
    """Check lists it; and what is made from it is not made."""
    paths = [place.simulation(id) for id in IDS]
    paths += [place.results / "lengths.nc", place.results / "lengths" / "faults.nc"]
    path = random.choice(paths)
    traceless = random.choice((True, False))
    if traceless:
        _without_a_trace(path, damage, random)
    else:
        damage(path, random)
    listed = any(f.path == path and f.state == "damaged" for f in place.findings())
    if not listed:  # a bit without meaning
        place.require_same(reference)
        return RECOVERED
    done = place.run("lengths", "--forcerun", "extract" if path in paths[:2] else "gather_lengths")
    if path.name == "lengths.nc":
        require(done.status == 0, done.output)
        return RECOVERED  # made again
    require(done.status != 0, "a table was made from a damaged dataset")
    name = path.relative_to(place.directory)
    require(f"{name} is damaged" in done.output, f"no clear error: {done.output[-2000:]}")
    place.finish()
    return CLEAR_ERROR


@fault("damaged dataset")
def truncated_dataset(place, reference, random):
    return _damaged_dataset(place, reference, random, truncate)


@fault("damaged dataset")
def flipped_dataset(place, reference, random):
    return _damaged_dataset(place, reference, random, flip)


@fault("damaged dataset")
def zeroed_dataset(place, reference, random):
    return _damaged_dataset(place, reference, random, zero)


def _bad_checkpoint(place: Place, id: str, *, refused: bool | None) -> str:
    """Run on from a checkpoint that must be refused, or used, or (None) may be either."""
    place.simulation(id).unlink()
    with place.unharmed():
        require((done := place.run_alone(id)).status == 0, done.output + place.log(id))
    said = place.log(id)
    if refused is not None:
        expected = "the run starts at the beginning" if refused else "the run goes on from"
        require(expected in said, f"it does not say {expected!r}: {said}")
    return RECOVERED


def _stopped(place: Place, reference: Reference, id: str) -> Path:
    """A checkpoint in the middle of the run."""
    name = place.checkpoint(id).name
    return Path(shutil.copy2(reference.checkpoints / name, place.checkpoint(id)))


@fault("damaged checkpoint")
def truncated_checkpoint(place, reference, random):
    id = random.choice(IDS)
    truncate(_stopped(place, reference, id), random)
    return _bad_checkpoint(place, id, refused=True)


@fault("damaged checkpoint")
def flipped_checkpoint(place, reference, random):
    id = random.choice(IDS)
    flip(_stopped(place, reference, id), random)
    return _bad_checkpoint(place, id, refused=None)  # some bits have no meaning


@fault("damaged checkpoint")
def zeroed_checkpoint(place, reference, random):
    id = random.choice(IDS)
    zero(_stopped(place, reference, id), random)
    return _bad_checkpoint(place, id, refused=None)


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


def _damaged_cache(place: Place, reference: Reference, random: random.Random, damage) -> str:
    """Fill a cache, damage entries, and take results from it."""
    cache = place.directory.parent / f"{place.directory.name}.cache"
    cache.mkdir()
    variables = {"SNAKEMAKE_OUTPUT_CACHE": str(cache)}
    try:
        place.simulation(IDS[0]).unlink()
        require((done := place.run("simulations", **variables)).status == 0, done.output)
        (entry,) = cache.glob("*.nc")
        damage(entry, random)
        place.simulation(IDS[0]).unlink()
        place.finish(**variables)
        place.require_same(reference)
        target = place.simulation(IDS[0])
        shutil.copy2(target.resolve(), place.directory / "copy.nc")
        target.unlink()
        shutil.move(place.directory / "copy.nc", target)
    finally:
        shutil.rmtree(cache)
    return RECOVERED


@fault("damaged cache entry")
def truncated_cache_entry(place, reference, random):
    return _damaged_cache(place, reference, random, truncate)


@fault("damaged cache entry")
def flipped_cache_entry(place, reference, random):
    return _damaged_cache(place, reference, random, flip)


@fault("damaged notes of snakemake")
def lost_notes(place, reference, random):
    """The directory .snakemake is removed, or a random note in it is cut or emptied."""
    place.simulation(IDS[0]).unlink()
    if random.random() < 0.5:
        shutil.rmtree(place.directory / ".snakemake")
    else:
        notes = sorted((place.directory / ".snakemake" / "metadata").rglob("*"))
        note = random.choice([path for path in notes if path.is_file()])
        truncate(note, random)
    with place.unharmed():
        place.finish()
    return RECOVERED


# Others at work, and clocks.


@fault("two snakemakes at once")
def two_snakemakes(place, reference, random):
    """The second stops and says why; the first goes on."""
    place.simulation(random.choice(IDS)).unlink()
    with place.unharmed():
        first = place.start()
        locks = place.directory / ".snakemake" / "locks"
        require(first.wait_for(lambda: any(locks.glob("*"))), "it ended without a lock")
        second = place.run()
        running = not first.ended()
        done = first.end()
        require(done.status == 0, done.output)
        if running:
            _says(second, "locked")
            return CLEAR_ERROR
    return RECOVERED  # the first was done before the second began


@fault("two simulations at once")
def two_scripts_of_one_simulation(place, reference, random):
    """As after a kill of snakemake alone: the old script goes on beside the new one."""
    id = random.choice(IDS)
    place.simulation(id).unlink()
    with place.unharmed():
        first = place.start_alone(id)
        first.spend(random.uniform(0.3, 1.0) * reference.alone)
        second = place.start_alone(id)
        for running in (first, second):
            done = running.end()
            require(done.status == 0, done.output + place.log(id))
    return RECOVERED


def _move_clock(place: Place, random: random.Random, offsets: tuple[float, ...]) -> None:
    for path in sorted(place.results.rglob("*")):
        then = time.time() + random.choice(offsets)
        with contextlib.suppress(FileNotFoundError):  # a temporary one
            os.utime(path, (then, then))


DAY = datetime.timedelta(days=1).total_seconds()


@fault("clock set back")
def results_from_the_future(place, reference, random):
    place.simulation(random.choice(IDS)).unlink()
    _move_clock(place, random, (DAY * random.uniform(0.01, 4000),))
    with place.unharmed():
        stopped = place.finish()
    return CLEAR_ERROR if stopped else RECOVERED


@fault("clock set back")
def clock_set_back_during_the_run(place, reference, random):
    """The clock jumps while a simulation runs: what was made before is of the future."""
    place.simulation(random.choice(IDS)).unlink()
    with place.unharmed():
        running = place.start()
        running.spend(random.uniform(0.2, 0.9) * reference.workflow)
        _move_clock(place, random, (DAY * random.uniform(-1.0, 1.0), 0.0))
        running.end()
        stopped = place.finish()
    return CLEAR_ERROR if stopped else RECOVERED


@fault("clock set back")
def times_at_random(place, reference, random):
    """As after a copy from machines whose clocks differ."""
    place.simulation(random.choice(IDS)).unlink()
    _move_clock(place, random, (-20000 * DAY, -DAY, 0.0, DAY))
    with place.unharmed():
        stopped = place.finish()
    return CLEAR_ERROR if stopped else RECOVERED


def disturb(name: str, reference: Reference, directory: Path, seed: str) -> str:
    """Let one fault happen to a copy of the workflow; how it ended.

    Raises
    ------
    harness.Lost
        If the datasets are not those of the undisturbed workflow in the end.
    """
    shutil.copytree(reference.directory, directory, symlinks=True)
    place = Place(directory)
    _, function = FAULTS[name]
    try:
        outcome = function(place, reference, random.Random(seed))
        place.require_same(reference)
    finally:
        Running.kill_all()
    return outcome
