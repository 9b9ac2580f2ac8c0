"""What has fooled the reuse of results: lost notes, copies, edits, stores that are not right."""

from __future__ import annotations

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
    Reference,
    configure,
    datasets,
    first_difference,
    require_nothing_made,
    require_same,
    rules,
)  # fmt: skip
from processes import ROOT, require
from registry import CLEAR_ERROR, RECOVERED, fault, says

from nucleation.datasets import netcdf
from nucleation.pipeline.store import Store

EDITED = "src/nucleation/simulation/control.py"


def _lengths(place: Place) -> bytes:
    return (place.results / "lengths.csv").read_bytes()


def _there_and_back(place: Place, reference: Reference) -> None:
    """Other parameters give other lengths; back at the first ones, nothing is made again."""
    first = _lengths(place)
    configure(place, OTHER)
    require(place.run().status == 0, "it could not be run with other parameters")
    require(_lengths(place) != first, "lengths of other parameters were kept")
    configure(place, CONFIG)
    require_nothing_made(place.run())
    place.prune()


@fault("lost notes, other parameters")
def notes_lost_and_parameters_changed(place, reference, random):
    shutil.rmtree(place.directory / ".snakemake")
    with place.unharmed():
        _there_and_back(place, reference)
    return RECOVERED


@fault("plain copy")
def plain_copy(place, reference, random):
    """Without notes and with times in any order; nothing is made again."""
    aside = place.directory / "aside"
    shutil.move(place.results, aside)
    files = sorted(path for path in aside.rglob("*") if path.is_file())
    random.shuffle(files)
    for path in files:
        target = place.results / path.relative_to(aside)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, target)
    shutil.rmtree(aside)
    shutil.rmtree(place.directory / ".snakemake")
    require_nothing_made(place.run())
    return RECOVERED


@fault("moved results")
def results_by_another_name(place, reference, random):
    """An absolute path, a slash more, another directory: the same results."""
    names = ("results/", "./results", str(place.results))
    configure(place, {**CONFIG, "results": random.choice(names)})
    require_nothing_made(place.run())
    moved = place.results.rename(place.directory / "elsewhere")
    configure(place, {**CONFIG, "results": "elsewhere"})
    require_nothing_made(place.run())
    moved.rename(place.results)
    configure(place, CONFIG)
    return RECOVERED


@fault("renamed study")
def study_renamed_and_back(place, reference, random):
    with place.unharmed():
        configure(place, {"studies": {"others": CONFIG["studies"]["faults"]}})
        done = place.run()
        require(done.status == 0 and "simulate" not in rules(done), "simulated again")
        require(b"others-aging" in _lengths(place), "the table has the old names")
        configure(place, CONFIG)
        require_nothing_made(place.run())
        place.prune()
    return RECOVERED


@fault("swapped results")
def entries_swapped(place, reference, random):
    """Two whole results under each other's key: found at planning, and made again."""
    one, other = (place.simulation(id).parent for id in IDS)
    _swap(one, other)
    listed = {found.path for found in place.findings() if found.state == "foreign"}
    require({one, other} <= listed, "check does not list them")
    done = place.run("lengths", "--dry-run")
    require(rules(done) == {"simulate"}, f"planning does not find them: {done.output[-2000:]}")
    require(done.output.count("holds the result of another key") >= 2, done.output)
    require(not place.finish(), "it was stopped")
    return RECOVERED


@fault("swapped results")
def files_of_entries_swapped(place, reference, random):
    """Only the datasets, in entries whose notes stay: no table is made of the wrong one."""
    _swap(*(place.simulation(id) for id in IDS))
    listed = {found.path for found in place.findings() if found.state == "damaged"}
    require({place.simulation(id).parent for id in IDS} <= listed, "check does not list them")
    place.forget_tables()
    return CLEAR_ERROR if place.finish() else RECOVERED


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


@fault("code edited during a run")
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
        refused = done.status != 0
        if refused:
            says(done, "have changed since this job was planned")
        file.write_text(text)
        os.utime(file)
        done = place.start(checkout=checkout, NUCLEATION_STORES=str(other)).end()
        require(done.status == 0, done.output)
        require_same(datasets(Store(other)), reference.contents)
    return CLEAR_ERROR if refused else RECOVERED


SAME_SIZE = {
    "src/nucleation/model/friction/evolutions/aging.py": ("-step / (1.0", "-step / (1.1"),
    "src/nucleation/simulation/newton.py": ("resolved[i]", "resolved[0]"),  # compiled
}
"""Edits that change results, but not the size of a source."""


@fault("code edited, its time kept")
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
    return RECOVERED


@contextlib.contextmanager
def _other_store(place: Place) -> Iterator[Path]:
    directory = place.directory.parent / f"{place.directory.name}.store"
    directory.mkdir()
    yield directory
    shutil.rmtree(directory)


@fault("swapped entries elsewhere")
def entries_of_another_store_swapped(place, reference, random):
    with _other_store(place) as other:
        one, two = (place.simulation(id).parent for id in IDS)
        shutil.copytree(one, other / two.name)
        shutil.copytree(two, other / one.name)
        place.forget(*IDS)
        require((done := place.run(NUCLEATION_STORES=str(other))).status == 0, done.output)
        said = "".join(place.log(id) for id in IDS)
        require(said.count("holds the result of another key") == 2, said)
    return RECOVERED


@fault("store that can't be written")
def unwritable_store(place, reference, random):
    """A mistyped one stops it before the first job; a read-only one loses no result."""
    place.forget(random.choice(IDS))
    says(place.run(NUCLEATION_STORES=str(place.directory / "mistyped")), "is no directory")
    with _other_store(place) as other, read_only(other):
        done = place.run(NUCLEATION_STORES=str(other))
        require(done.status == 0, f"the result was lost: {done.output[-1500:]}")
    return CLEAR_ERROR


@fault("results elsewhere")
def results_from_another_store(place, reference, random):
    """Without results of its own, it takes all from another store and computes nothing."""
    with _other_store(place) as other:
        shutil.rmtree(other)
        shutil.copytree(place.store.directory, other)
        with place.unharmed():
            aside = place.results.rename(place.directory / "aside")
            require((done := place.run(NUCLEATION_STORES=str(other))).status == 0, done.output)
            require(all("taken from" in place.log(id) for id in IDS), "simulated again")
            shutil.rmtree(aside)
    return RECOVERED


@fault("killed scheduler")
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
    return RECOVERED
