"""Workflows to disturb: a directory with one, and what an undisturbed one makes."""

from __future__ import annotations

import contextlib
import dataclasses
import math
import os
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

from nucleation.configuration.load import load
from nucleation.configuration.runs import Run
from nucleation.datasets import netcdf, variables
from nucleation.model.friction.registry import plugins
from nucleation.pipeline import code, keys
from nucleation.pipeline.check import Finding
from nucleation.pipeline.keys import Store

SCRIPT = ROOT / "workflow" / "scripts" / "simulate.py"
IDS = tuple(f"faults-aging-H{height}-phi1" for height in (0.02, 0.1))
CONFIG = {
    "studies": {
        "faults": {
            "length_over_critical": 4.0,
            "defaults": {"n_x": 60, "n_y": 4, "grading": 2.0, "time_after_event": 0.01,
                         "tolerance": 0.1, "longest_step": 0.2},
            "runs": [{"height": [0.02, 0.1]}],
        }
    }
}  # fmt: skip
COSTS = {"wall_seconds", "peak_megabytes"}
"""Variables and attributes that tell of the machine: they differ between any two runs."""

OF_THE_MOMENT = COSTS | {"created", "content", "command"}
"""Attributes that do: the digest of the content covers the others."""


@dataclasses.dataclass(frozen=True)
class Reference:
    """An undisturbed workflow, and runs stopped halfway.

    Attributes
    ----------
    directory : Path
        The finished workflow.
    checkpoints : Path
        A directory with the checkpoint of each simulation, stopped by a signal in its middle.
    contents : dict
        Its datasets, by path below `directory`.
    alone, workflow : float
        Processor time (s) of one simulation's script, and of the whole workflow.
    """

    directory: Path
    checkpoints: Path
    contents: dict[Path, xr.Dataset]
    alone: float
    workflow: float


@dataclasses.dataclass(frozen=True)
class Place:
    """A directory in which the workflow runs."""

    directory: Path

    def copy(self, directory: Path) -> Place:
        """The same in another directory."""
        return Place(shutil.copytree(self.directory, directory, symlinks=True))

    @property
    def results(self) -> Path:
        """Where the results are."""
        return self.directory / "results"

    def simulation(self, id: str) -> Path:
        """The dataset of one simulation."""
        run = next(run for run in load(self.directory / "config.yaml").runs if run.id == id)
        return Path(Store(self.results).dataset("simulations", id, keys.joined(made(run))))

    def checkpoint(self, id: str) -> Path:
        """The checkpoint of one simulation."""
        return self.simulation(id).with_suffix(".checkpoint.npz")

    def log(self, id: str) -> str:
        """What a simulation has written to its log."""
        name = self.simulation(id).with_suffix(".log").name
        return (self.results / "logs" / "simulate" / name).read_text(errors="replace")

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

    def start_alone(
        self, id: str, prepare: Callable[[], object] | None = None, *, stop_after: int | None = None
    ) -> Running:
        """Start the script of one simulation without Snakemake, to be stopped after some steps."""
        command = [sys.executable, str(Path(__file__).with_name("alone.py")), id]
        command += [] if stop_after is None else [str(stop_after)]
        return Running(command, self.directory, prepare)

    def run(self, *arguments: str, **environment: str) -> Done:
        """Run snakemake to its end, with nothing that disturbs it on the way."""
        with tempfile.TemporaryDirectory() as place:
            asked, printed = _asked(arguments, ROOT), Path(place, "printed")
            done = warm()(asked, self.directory, printed, **{**ENVIRONMENT, **environment})
        return Done(done.returncode, done.stdout, math.nan)

    def run_alone(self, id: str) -> Done:
        """Run the script of one simulation to its end, a good one."""
        done = self.start_alone(id).end()
        require(done.status == 0, done.output + self.log(id))
        return done

    def finish(self, *targets: str, **environment: str) -> bool:
        """What a user does next: run it again and do what messages ask for, if it stops with any.

        Returns whether it did.
        """
        for attempt in range(4):
            done = self.run(*targets, **environment)
            if done.status == 0:
                return attempt > 0
            if "cannot be locked" in done.output:
                require(self.run("--unlock").status == 0, "it can't be unlocked")
                continue
            if "clock skew" in done.output:
                now = time.time()
                for path in self.results.rglob("*"):
                    os.utime(path, (now, now))
                continue
            damaged = re.findall(r"(results/\S+) is (?:damaged|another result)", done.output)
            require(damaged, f"it can't be finished: {done.output[-3000:]}")
            for path in set(damaged):
                (self.directory / path).unlink(missing_ok=True)
        raise Lost(f"it can't be finished: {done.output[-3000:]}")

    def contents(self) -> dict[Path, xr.Dataset]:
        """All datasets below the results, by path."""
        paths = [*self.results.glob("[!.]*.nc"), *self.results.glob("[!.]*/[!.]*.nc")]
        return {path.relative_to(self.directory): netcdf.read(path) for path in paths}

    def findings(self) -> list[Finding]:
        """What target `check` lists."""
        listed = re.findall(r"^(\w+) +(results/\S+): (.+)$", self.run("check").output, re.M)
        return [Finding(self.directory / path, state, why) for state, path, why in listed]

    def require_same(self, reference: Reference) -> None:
        """Every dataset has the undisturbed one's values, bit for bit."""
        self.require_contents(reference.contents)

    def require_contents(self, expected: dict[Path, xr.Dataset]) -> None:
        """The datasets are those, by path below the directory."""
        try:
            contents = self.contents()
        except variables.DatasetError as error:
            raise Lost(str(error)) from error
        require(contents.keys() == expected.keys(), f"datasets are {sorted(contents)}")
        for path, dataset in contents.items():
            difference = first_difference(dataset, expected[path])
            require(difference is None, f"{path} differs from the undisturbed one: {difference}")

    @contextlib.contextmanager
    def unharmed(self) -> Iterator[None]:
        """Whatever happens within: each simulation that exists before is the same after."""
        before = {path: path.read_bytes() for path in self.results.glob("simulations/*.nc")}
        yield
        for path, content in before.items():
            require(path.exists(), f"{path.name} was lost")
            require(path.read_bytes() == content, f"{path.name} was changed")


def _asked(arguments: Sequence[str], checkout: Path) -> list[str]:
    """What snakemake is asked for: the lengths, if nothing else is."""
    asked = [*(arguments or ("lengths",)), "--snakefile", str(checkout / "Snakefile")]
    asked += ["--workflow-profile", str(checkout / "workflow/profiles/default")]
    return [*asked, "--configfile", "config.yaml"]


def made(run: Run) -> dict[str, str]:
    """What makes a simulation, as the workflow says it."""
    digest = code.digest(str(SCRIPT), *code.ALWAYS, *plugins(run.parameters))
    return keys.parts(digest, {"parameters": run.parameters.to_dict()}, {})


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
    """Run the workflow undisturbed, and stop each simulation once in its middle."""
    whole = Place(directory / "undisturbed")
    whole.directory.mkdir(parents=True)
    (whole.directory / "config.yaml").write_text(yaml.safe_dump(CONFIG))
    workflow = whole.start().end()
    require(workflow.status == 0, workflow.output)
    require(not list(whole.results.glob(".kept/*")), "second names were left")

    place, checkpoints = whole.copy(directory / "halfway"), directory / "stopped"
    checkpoints.mkdir()
    for id in IDS:
        place.simulation(id).unlink()
        steps = int(netcdf.read(whole.simulation(id)).attrs["steps"])
        stopped = place.start_alone(id, stop_after=steps // 2).end()
        require(stopped.status != 0, "it did not stop")
        require("stopped by SIGTERM" in place.log(id), "its log does not say why it stopped")
        shutil.copy2(place.checkpoint(id), checkpoints)
    place.checkpoint(id).unlink()
    alone = place.run_alone(id)
    return Reference(whole.directory, checkpoints, whole.contents(), alone.cpu, workflow.cpu)
