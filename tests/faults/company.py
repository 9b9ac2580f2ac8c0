"""Others at work in the same place, and clocks."""

from __future__ import annotations

import contextlib
import datetime
import os
import random
import shutil
import time

from harness import (
    CONFIG,
    IDS,
    OTHER,
    Place,
    configure,
    others,
    require_nothing_made,
    require_same,
)  # fmt: skip
from processes import require
from registry import CLEAR_ERROR, RECOVERED, fault, says


@fault("two snakemakes at once")
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
            return CLEAR_ERROR
    return RECOVERED  # the first was done before the second began


@fault("two configurations at once")
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
            first.spend(random.uniform(0.0, 1.0) * reference.workflow)
        ended = [running.end() for running in (first, second.start())]
        for done in ended:
            require(done.status == 0, done.output)
        require_same(place.contents(), reference.contents | whole)
        require(whole.keys() <= place.contents().keys(), "a result of the second is not there")
        configure(place, CONFIG)
        require_nothing_made(place.run())
    shutil.rmtree(second.directory)
    place.prune()
    return RECOVERED


@fault("two simulations at once")
def two_scripts_of_one_simulation(place, reference, random):
    """As after a kill of snakemake alone: the old script goes on beside the new one."""
    id = random.choice(IDS)
    place.forget(id)
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
    place.forget(random.choice(IDS))
    _move_clock(place, random, (DAY * random.uniform(0.01, 4000),))
    with place.unharmed():
        stopped = place.finish()
    return CLEAR_ERROR if stopped else RECOVERED


@fault("clock set back")
def clock_set_back_during_the_run(place, reference, random):
    """The clock jumps while a simulation runs: what was made before is of the future."""
    place.forget(random.choice(IDS))
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
    place.forget(random.choice(IDS))
    _move_clock(place, random, (-20000 * DAY, -DAY, 0.0, DAY))
    with place.unharmed():
        stopped = place.finish()
    return CLEAR_ERROR if stopped else RECOVERED
