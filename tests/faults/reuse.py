"""What has fooled the reuse of results: lost notes, copies, edits, stores that are not right."""

import contextlib
import os
import random
import shutil
import signal
from collections.abc import Iterator
from pathlib import Path

from disks import read_only
from harness import (
    CONFIG,
    IDS,
    OTHER,
    Place,
    configure,
    datasets,
    first_difference,
    require_nothing_made,
    require_same,
    rules,
)
from processes import ROOT, require
from registry import fault, says

from nucleation.datasets import netcdf
from nucleation.pipeline.store import Store

EDITED = "src/nucleation/simulation/control.py"


@fault
def files_of_entries_swapped(place, reference, random):
    """Only the datasets, in entries whose notes stay: no table is made of the wrong one."""
    _swap(*(place.simulation(id) for id in IDS))
    listed = {found.path for found in place.findings() if found.state == "damaged"}
    require({place.simulation(id).parent for id in IDS} <= listed, "check does not list them")
    place.forget_tables()
    place.finish()


def _swap(one: Path, other: Path) -> None:
    aside = one.rename(one.with_suffix(".aside"))
    other.rename(one)
    aside.rename(other)


@contextlib.contextmanager
def _checkout(place: Place) -> Iterator[Path]:
    """A checkout to edit."""
    checkout = place.directory.parent / f"{place.directory.name}.checkout"
    for part in ("src", "workflow", "config", "docs"):
        shutil.copytree(ROOT / part, checkout / part)
    shutil.copy(ROOT / "Snakefile", checkout)
    try:
        yield checkout
    finally:
        shutil.rmtree(checkout)


@fault
def code_edited_during_a_run(place, reference, random):
    """At any moment: what is kept is of the code that made it, also in another store."""
    place.forget(*IDS)
    with _checkout(place) as checkout, _other_store(place) as other:
        file = checkout / EDITED
        text = file.read_text()
        running = place.start(checkout=checkout, NUCLEATION_STORES=str(other))
        running.spend(random.uniform(0.0, 1.0) * reference.workflow)
        file.write_text(text.replace("SAFETY = 0.85", "SAFETY = 0.5"))
        done = running.end()
        if done.status != 0:
            says(done, "have changed since this job was planned")
        file.write_text(text)
        os.utime(file)
        done = place.start(checkout=checkout, NUCLEATION_STORES=str(other)).end()
        require(done.status == 0, done.output)
        require_same(datasets(Store(other)), reference.contents)


SAME_SIZE = {
    "src/nucleation/model/friction/evolutions/aging.py": ("-step / (1.0", "-step / (1.1"),
    "src/nucleation/simulation/newton.py": ("resolved[i]", "resolved[0]"),  # compiled
}
"""Edits that change results, but not the size of a source."""


@fault
def code_edited_with_its_time_kept(place, reference, random):
    """As by rsync: bytecode, and what numba has compiled, of before the edit are not used."""
    id, path = random.choice(IDS), random.choice(sorted(SAME_SIZE))
    first = netcdf.read(place.simulation(id))
    with _checkout(place) as checkout:
        file = checkout / path
        text, times = file.read_text(), file.stat().st_mtime_ns
        place.forget(id)
        require((done := place.start(checkout=checkout).end()).status == 0, done.output)
        with place.unharmed():
            old, new = SAME_SIZE[path]
            require(old in text, f"{path} has no {old}")
            file.write_text(text.replace(old, new))
            os.utime(file, ns=(times, times))
            check = place.start("check", checkout=checkout).end()
            require(f"stale       results/simulations/{id}.nc" in check.output, check.output)
            done = place.start(checkout=checkout).end()
            require(done.status == 0 and "simulate" in rules(done), done.output)
            edited = netcdf.read(place.results / "simulations" / f"{id}.nc")
            same = first_difference(edited.assign_attrs(first.attrs), first) is None
            require(not same, "it ran as before the edit")
            file.write_text(text)
            os.utime(file, ns=(times, times))
            require_nothing_made(place.start(checkout=checkout).end())
    place.prune()


@contextlib.contextmanager
def _other_store(place: Place) -> Iterator[Path]:
    directory = place.directory.parent / f"{place.directory.name}.store"
    directory.mkdir()
    yield directory
    shutil.rmtree(directory)


@fault
def unwritable_store(place, reference, random):
    """A mistyped one stops it before the first job; a read-only one loses no result."""
    place.forget(random.choice(IDS))
    says(place.run(NUCLEATION_STORES=str(place.directory / "mistyped")), "is no directory")
    with _other_store(place) as other, read_only(other):
        done = place.run(NUCLEATION_STORES=str(other))
        require(done.status == 0, f"the result was lost: {done.output[-1500:]}")


@fault
def scheduler_killed_and_parameters_changed(place, reference, random: random.Random):
    """Its simulation goes on to its end; meanwhile the configuration changes, and back again."""
    id = random.choice(IDS)
    place.forget(id)
    with place.unharmed():
        moment = random.uniform(0.2, 0.9) * reference.workflow
        place.start().interrupt(signal.SIGKILL, moment)
        configure(place, OTHER)
        place.finish()
        configure(place, CONFIG)
        place.finish()
        place.prune()
