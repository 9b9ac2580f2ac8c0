"""Workflows to disturb: a directory with one, and what an undisturbed one makes.

A fault is a function that does what can go wrong, and then what a user would do next. It gets a
copy of the undisturbed workflow, what an undisturbed one makes, and a source of random numbers. It
leaves a workflow that is finished again: its datasets are compared. It raises Lost if something was
damaged, or if it ended without a clear error.
"""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import math
import os
import random
import re
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
import xarray as xr
import yaml
from processes import ENVIRONMENT, ROOT, Done, Lost, Running, require
from warm_snakemake import warm

from nucleation.datasets import netcdf, variables
from nucleation.model.friction import plugins
from replication.configuration.load import load
from replication.pipeline.check import LEFTOVERS, OWN, Finding
from replication.pipeline.making import SIMULATE, UNFINISHED
from replication.pipeline.recipes import Recipe, key_in
from replication.pipeline.store import Store, read_note

IDS = tuple(f"faults-aging-H{height}-phi1" for height in (0.02, 0.1))
CONFIG = {
    "studies": {
        "faults": {
            "length_over_critical": 4.0,
            "defaults": {
                "n_x": 60,
                "n_y": 4,
                "grading": 2.0,
                "time_after_event": 0.01,
                "tolerance": 0.1,
                "longest_step": 0.2,
            },
            "runs": [{"height": [0.02, 0.1]}],
        }
    }
}
OTHER = {**CONFIG, "friction": {"aging_coefficient": 0.08}}
"""The same runs with other parameters."""

COSTS = {"wall_seconds", "peak_megabytes"}
"""Variables and attributes that tell of the machine: they differ between any two runs."""

OF_THE_MOMENT = COSTS | {"created", "content", "command", "history"}
"""Attributes that differ between any two runs; the digest of the content covers the others."""


@dataclasses.dataclass(frozen=True)
class Reference:
    """An undisturbed workflow."""

    directory: Path
    contents: dict[str, xr.Dataset]  # its datasets, by key
    shown: dict[Path, str | None]  # keys of what is shown, by path below the results
    cpu: float  # processor time that it took (s)


@dataclasses.dataclass(frozen=True)
class Place:
    """A directory in which the workflow runs."""

    directory: Path

    @property
    def results(self) -> Path:
        """Where the results are."""
        return self.directory / "results"

    @property
    def store(self) -> Store:
        """The store of the results, as it is now."""
        return Store(self.results / "store")

    def key(self, id: str) -> str:
        """The key of a simulation."""
        run = load(self.directory / "config.yaml").run(id).run
        values = {"parameters": run.to_dict()}
        return Recipe(id, [], "results", SIMULATE, plugins(run.law), values, {}, []).key

    def simulation(self, id: str) -> Path:
        """The dataset of one simulation."""
        return self.store.entry(self.key(id)) / "result.nc"

    def forget(self, *ids: str) -> None:
        """Remove simulations from the store; the links to them lead nowhere then."""
        for id in ids:
            shutil.rmtree(self.simulation(id).parent, ignore_errors=True)

    def forget_tables(self) -> None:
        """Remove all from the store that is made of simulations."""
        for key in self.store.listed():
            if self.store.has(key) and read_note(self.store.entry(key))["rule"] != "simulate":
                self.store.remove(key)

    def checkpoint(self, id: str) -> Path:
        """The checkpoint of one simulation."""
        return self.results / UNFINISHED / f"{id}.checkpoint.npz"

    def log(self, id: str) -> str:
        """What a simulation has written to its log."""
        return (self.results / "logs" / "batches" / f"{id}.log").read_text(errors="replace")

    def start(
        self,
        *arguments: str,
        prepare: Callable[[], object] | None = None,
        checkout: Path = ROOT,
        **environment: str,
    ) -> Running:
        """Start snakemake, by the code of a checkout."""
        command = [sys.executable, "-m", "snakemake", *_asked(arguments, checkout)]
        return Running(command, self.directory, prepare, **environment)

    def run(self, *arguments: str, **environment: str) -> Done:
        """Run snakemake to its end, with nothing that disturbs it on the way."""
        with tempfile.TemporaryDirectory() as place:
            asked, printed = _asked(arguments, ROOT), Path(place, "printed")
            done = warm()(asked, self.directory, printed, **{**ENVIRONMENT, **environment})
        return Done(done.returncode, done.stdout, math.nan)

    def finish(self) -> None:
        """What a user does next: run it again and do what messages ask for, if it stops."""
        for _ in range(4):
            done = self.run()
            if done.status == 0:
                return
            if "cannot be locked" in done.output:
                require(self.run("--unlock").status == 0, "it can't be unlocked")
                continue
            if "clock skew" in done.output:
                now = time.time()
                for path in self.results.rglob("*"):
                    os.utime(path, (now, now))
                continue
            aside = "It was moved aside: run this again" in done.output
            require(aside, f"it can't be finished: {done.output[-3000:]}")
        raise Lost(f"it can't be finished: {done.output[-3000:]}")

    def contents(self) -> dict[str, xr.Dataset]:
        """All datasets of the store, by key."""
        return datasets(self.store)

    def shown(self) -> dict[Path, str | None]:
        """Keys of all that the directory of results shows, by path below it."""
        names = (path.relative_to(self.results) for path in self.results.rglob("*"))
        return {
            name: key_in(os.path.realpath(self.results / name))
            for name in names
            if name.parts[0] not in {*OWN, UNFINISHED} and not (self.results / name).is_dir()
        }

    def prune(self) -> None:
        """Remove what nothing refers to."""
        done = self.run("prune", PRUNE="yes")
        require(done.status == 0, done.output)

    def findings(self) -> list[Finding]:
        """What target `check` lists."""
        listed = re.findall(r"^(\w+) +(results/\S+): (.+)$", self.run("check").output, re.M)
        return [(self.directory / path, state, why) for state, path, why in listed]

    def require_same(self, reference: Reference) -> None:
        """Every dataset has the undisturbed one's values, bit for bit, and its name leads to it."""
        try:
            contents = self.contents()
        except variables.DatasetError as error:
            raise Lost(str(error)) from error
        require(contents.keys() == reference.contents.keys(), f"datasets are {sorted(contents)}")
        require_same(contents, reference.contents)
        shown = self.shown()
        require(shown == reference.shown, f"shown are {shown}")

    @contextlib.contextmanager
    def unharmed(self) -> Iterator[None]:
        """Whatever happens within: each entry that exists before is the same after."""
        whole = (self.store.entry(key) for key in self.store.listed() if self.store.has(key))
        paths = [path for entry in whole for path in entry.iterdir()]
        before = {path: path.read_bytes() for path in paths}
        yield
        for path, content in before.items():
            require(path.exists(), f"{path} was lost")
            require(path.read_bytes() == content, f"{path} was changed")


def configure(place: Place, config: dict) -> None:
    """Give a place another configuration."""
    (place.directory / "config.yaml").write_text(yaml.safe_dump(config))


@functools.cache
def others(directory: Path) -> dict[str, xr.Dataset]:
    """What :data:`OTHER` makes by itself, beside the workflows of a reference."""
    place = Place(directory / "others")
    place.directory.mkdir()
    configure(place, OTHER)
    require((done := place.run()).status == 0, done.output)
    return place.contents()


def datasets(store: Store) -> dict[str, xr.Dataset]:
    """All datasets of a store, by key, once every entry is found to be whole."""
    for key in store.listed():
        read_note(store.entry(key), whole=True)
    paths = [store.entry(key) / "result.nc" for key in store.listed()]
    return {str(key_in(path)): netcdf.read(path) for path in paths if path.exists()}


def require_same(datasets: dict[str, xr.Dataset], expected: dict[str, xr.Dataset]) -> None:
    """Datasets have the values that are expected of their keys, bit for bit."""
    for key, dataset in datasets.items():
        difference = first_difference(dataset, expected[key])
        require(difference is None, f"{key} differs from the undisturbed one: {difference}")


def rules(done: Done) -> set[str]:
    """The rules that were run, without the target of the lengths."""
    if "Nothing to be done" in done.output:
        return set()
    table = re.search(r"Job stats:\njob +count\n-+ +-+\n(.*?)\ntotal", done.output, re.S)
    require(table, f"it ran nothing: {done.output[-1500:]}")
    return {line.split()[0] for line in table[1].splitlines()} - {"lengths"}


def require_nothing_made(done: Done) -> None:
    """It ended well and has made nothing."""
    require(done.status == 0 and not rules(done), f"it ran again: {done.output[-1500:]}")


def _asked(arguments: Sequence[str], checkout: Path) -> list[str]:
    """What snakemake is asked for: the lengths, if nothing else is."""
    asked = [*(arguments or ("lengths",)), "--snakefile", str(checkout / "Snakefile")]
    asked += ["--workflow-profile", str(checkout / "profiles/default")]
    return [*asked, "--configfile", "config.yaml"]


def first_difference(one: xr.Dataset, other: xr.Dataset) -> str | None:
    """The first attribute, or variable in a bit, in which two datasets differ."""
    for name in (one.attrs.keys() | other.attrs.keys()) - OF_THE_MOMENT:
        if not np.array_equal(one.attrs.get(name), other.attrs.get(name)):
            return f"the attribute {name}"
    if one.variables.keys() != other.variables.keys():
        return "names of variables"
    for name in one.variables.keys() - COSTS:
        a, b = one[name].values, other[name].values
        same = a.shape == b.shape and a.dtype.kind == b.dtype.kind
        if same and a.dtype.kind == "f":
            same = a.dtype == b.dtype and a.tobytes() == b.tobytes()
        if not (same and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")):
            return str(name)
    return None


def make_reference(directory: Path) -> Reference:
    """Run the workflow undisturbed."""
    whole = Place(directory / "undisturbed")
    whole.directory.mkdir(parents=True)
    configure(whole, CONFIG)
    done = whole.start().end()
    require(done.status == 0, done.output)
    require(not list(whole.store.directory.glob(".*")), f"{LEFTOVERS['.*.tmp']}")
    return Reference(whole.directory, whole.contents(), whole.shown(), done.cpu)


Fault = Callable[[Place, Reference, random.Random], object]
FAULTS: dict[str, Fault] = {}


def fault(function: Fault) -> Fault:
    """Enter a function into the registry."""
    FAULTS[function.__name__] = function
    return function


def says(done: Done, *texts: str) -> None:
    """Require that it stopped with one of the texts in its output."""
    require(done.status != 0, "it ended well")
    require(any(text in done.output for text in texts), f"no clear error: {done.output[-2000:]}")


def disturb(name: str, reference: Reference, directory: Path, seed: str) -> None:
    """Let one fault happen to a copy of the workflow, which must be as undisturbed in the end."""
    place = Place(shutil.copytree(reference.directory, directory, symlinks=True))
    try:
        FAULTS[name](place, reference, random.Random(seed))
        place.require_same(reference)
    finally:
        Running.kill_all()
