"""Others at work in the same place, and clocks."""

import contextlib
import datetime
import os
import shutil
import time

from harness import CONFIG, IDS, OTHER, Place, configure, others, require_nothing_made, require_same
from processes import require
from registry import fault, says


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


@fault
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
