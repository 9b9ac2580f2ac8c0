"""What has fooled the reuse of results: lost notes, copies, edits, caches that are not right."""

from __future__ import annotations

import contextlib
import os
import random
import shutil
import signal
from collections.abc import Iterator
from pathlib import Path

import yaml
from disks import read_only
from harness import CONFIG, IDS, Place, Reference
from processes import ROOT, require
from registry import CLEAR_ERROR, RECOVERED, fault, says

OTHER = {**CONFIG, "friction": {"aging_coefficient": 0.08}}
EDITED = "src/nucleation/simulation/control.py"


def _configure(place: Place, config: dict) -> None:
    (place.directory / "config.yaml").write_text(yaml.safe_dump(config))


def _lengths(place: Place) -> bytes:
    return (place.results / "lengths.csv").read_bytes()


def _there_and_back(place: Place, reference: Reference) -> None:
    """Other parameters give other lengths; back at the first ones, nothing is simulated again."""
    first = _lengths(place)
    simulations = {path: path.stat().st_mtime_ns for path in place.results.glob("simulations/*.nc")}
    _configure(place, OTHER)
    require(place.run().status == 0, "it could not be run with other parameters")
    require(_lengths(place) != first, "lengths of other parameters were kept")
    _configure(place, CONFIG)
    done = place.run()
    require(done.status == 0 and "Simulation" not in done.output, "simulated again")
    for path, moment in simulations.items():
        require(path.stat().st_mtime_ns == moment, f"{path} was written again")
    require(place.run("prune").status == 0, "it could not be pruned")


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
    done = place.run()
    require("Nothing to be done" in done.output, f"it ran again: {done.output[-1500:]}")
    return RECOVERED


@fault("moved results")
def results_by_another_name(place, reference, random):
    """An absolute path, a slash more, another directory: the same results."""
    names = ("results/", "./results", str(place.results))
    _configure(place, {**CONFIG, "results": random.choice(names)})
    done = place.run()
    require("Nothing to be done" in done.output, f"it ran again: {done.output[-1500:]}")
    moved = place.results.rename(place.directory / "elsewhere")
    _configure(place, {**CONFIG, "results": "elsewhere"})
    done = place.run()
    require("Nothing to be done" in done.output, f"it ran again: {done.output[-1500:]}")
    moved.rename(place.results)
    _configure(place, CONFIG)
    return RECOVERED


@fault("renamed study")
def study_renamed_and_back(place, reference, random):
    with place.unharmed():
        _configure(place, {"studies": {"others": CONFIG["studies"]["faults"]}})
        done = place.run()
        require(done.status == 0 and "Simulation" not in done.output, "simulated again")
        require(b"others-aging" in _lengths(place), "the table has the old names")
        _configure(place, CONFIG)
        require((done := place.run()).status == 0, done.output)
    (place.results / "lengths" / "others.nc").unlink()
    return RECOVERED


@fault("swapped datasets")
def datasets_swapped(place, reference, random):
    """Two whole datasets under each other's name: refused by name, and made again."""
    one, other = (place.simulation(id) for id in IDS)
    aside = one.rename(one.with_suffix(".aside"))
    other.rename(one)
    aside.rename(other)
    listed = {found.path for found in place.findings() if found.state == "foreign"}
    require({one, other} <= listed, "check does not list them")
    says(place.run("lengths", "--forcerun", "extract"), "is another result than it should be")
    place.finish()
    return CLEAR_ERROR


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
    """At any moment: what is kept is of the code that made it, also in the cache."""
    cache = place.directory.parent / f"{place.directory.name}.cache"
    cache.mkdir()
    for id in IDS:
        place.simulation(id).unlink()
    with _checkout(place) as checkout:
        file = checkout / EDITED
        text = file.read_text()
        running = place.start(checkout=checkout, SNAKEMAKE_OUTPUT_CACHE=str(cache))
        running.spend(random.uniform(0.0, 1.0) * reference.workflow)
        file.write_text(text.replace("SAFETY = 0.85", "SAFETY = 0.5"))
        done = running.end()
        refused = done.status != 0
        if refused:
            says(done, "has changed since this job was planned", "is not of the present")
        file.write_text(text)
        os.utime(file)
        done = place.start(checkout=checkout, SNAKEMAKE_OUTPUT_CACHE=str(cache)).end()
        require(done.status == 0, done.output)
    shutil.rmtree(cache)
    return CLEAR_ERROR if refused else RECOVERED


@fault("swapped cache entries")
def cache_entries_swapped(place, reference, random):
    cache = place.directory.parent / f"{place.directory.name}.cache"
    cache.mkdir()
    variables = {"SNAKEMAKE_OUTPUT_CACHE": str(cache)}
    one, other = (cache / f"{place.simulation(id).name.split('.')[-2]}.nc" for id in IDS)
    shutil.copyfile(place.simulation(IDS[0]), other)
    shutil.copyfile(place.simulation(IDS[1]), one)
    for id in IDS:
        place.simulation(id).unlink()
    require((done := place.run(**variables)).status == 0, done.output)
    shutil.rmtree(cache)
    return RECOVERED


@fault("cache that can't be written")
def unwritable_cache(place, reference, random):
    """A mistyped one stops it before the first job; a read-only one loses no result."""
    id = random.choice(IDS)
    place.simulation(id).unlink()
    says(place.run(SNAKEMAKE_OUTPUT_CACHE=str(place.directory / "mistyped")), "is no directory")
    cache = place.directory.parent / f"{place.directory.name}.cache"
    cache.mkdir()
    with read_only(cache):
        done = place.run(SNAKEMAKE_OUTPUT_CACHE=str(cache))
        require(done.status == 0, f"the result was lost: {done.output[-1500:]}")
    shutil.rmtree(cache)
    return CLEAR_ERROR


@fault("killed scheduler")
def scheduler_killed_and_parameters_changed(place, reference, random: random.Random):
    """Its simulation goes on to its end; meanwhile the configuration changes, and back again."""
    id = random.choice(IDS)
    place.simulation(id).unlink()
    with place.unharmed():
        moment = random.uniform(0.2, 0.9) * reference.workflow
        place.start().interrupt(signal.SIGKILL, moment)
        _configure(place, OTHER)
        place.finish()
        _configure(place, CONFIG)
        place.finish()
        require(place.run("prune").status == 0, "it could not be pruned")
    return RECOVERED
