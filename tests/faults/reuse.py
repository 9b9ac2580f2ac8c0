"""Code that is edited, in ways that have fooled the reuse of results."""

import contextlib
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from harness import (
    IDS,
    Place,
    datasets,
    fault,
    first_difference,
    require_nothing_made,
    require_same,
    rules,
    says,
)
from processes import ROOT, require

from nucleation.datasets import netcdf
from nucleation.pipeline.store import Store

EDITED = "src/nucleation/simulation/control.py"


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
        running.spend(random.uniform(0.0, 1.0) * reference.cpu)
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
