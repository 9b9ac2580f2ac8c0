"""Workflows to disturb: a directory with one, its processes, and what an undisturbed one makes."""

from __future__ import annotations

import contextlib
import dataclasses
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import ClassVar

import numpy as np
import psutil
import xarray as xr
import yaml

from nucleation import datasets
from nucleation.check import Finding, check_results
from nucleation.configuration import load

ROOT = Path(__file__).parents[2]
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
ENVIRONMENT = {
    "NUCLEATION_CHECKPOINT_EVERY": "0.05",
    "OMP_NUM_THREADS": "1",
    "PYTHONPATH": str(ROOT / "src"),
}
PATIENCE = 600.0
"""Seconds after which a process that should have ended is taken to hang."""
COSTS = {"wall_seconds", "peak_megabytes"}
"""Variables that tell of the machine: they differ between any two runs."""


class Lost(AssertionError):
    """A fault has damaged or lost something, or ended without a clear error."""


def require(condition: object, message: str) -> None:
    """Raise :class:`Lost` with the message unless the condition holds."""
    if not condition:
        raise Lost(message)


@dataclasses.dataclass(frozen=True)
class Done:
    """A process that has ended: exit status, all it wrote, processor time (s) with its children."""

    status: int
    output: str
    cpu: float


class Running:
    """A process with its children, in a process group of its own as in a terminal of its own."""

    started: ClassVar[list[Running]] = []

    def __init__(
        self, command: list[str], directory: Path, prepare: Callable[[], object] | None = None,
        **environment: str,
    ) -> None:  # fmt: skip
        def before() -> None:
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                signal.signal(number, signal.SIG_DFL)  # a shell's background job ignores Ctrl-C
            if prepare is not None:
                prepare()

        self._output = directory.parent / f"{directory.name}.{time.monotonic_ns()}.output"
        with self._output.open("wb") as output:
            self.process = subprocess.Popen(
                command, cwd=directory, env={**os.environ, **ENVIRONMENT, **environment},
                stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                start_new_session=True, preexec_fn=before,
            )  # fmt: skip
        self.pid = self.process.pid
        self.started.append(self)

    def tree(self) -> list[psutil.Process]:
        """The process and all below it, as far as they are alive."""
        with contextlib.suppress(psutil.NoSuchProcess):
            top = psutil.Process(self.pid)
            return [top, *top.children(recursive=True)]
        return []

    def scripts(self) -> list[psutil.Process]:
        """The Python processes that run simulations."""
        found = []
        for process in self.tree():
            with contextlib.suppress(psutil.Error):
                if re.search(r"/tmp\w*\.simulate\.py$", " ".join(process.cmdline())):
                    found.append(process)
        return found

    def ended(self) -> bool:
        """Whether it has ended; its status stays to be read, together with what it used."""
        return os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None

    def wait_for(self, condition: Callable[[], object]) -> bool:
        """Whether a condition came true before the process ended."""
        begin = time.monotonic()
        while not self.ended():
            if condition():
                return True
            require(time.monotonic() - begin < PATIENCE, "a process hangs")
            time.sleep(0.01)
        return False

    def spend(self, seconds: float) -> bool:
        """Let it use so much processor time, a measure of its progress on a busy machine too."""
        return self.wait_for(lambda: processor_time(self.tree()) >= seconds)

    def signal(self, number: signal.Signals, *, group: bool = False) -> None:
        """Send it a signal, alone or to all it has started, unless it has ended."""
        with contextlib.suppress(ProcessLookupError):
            (os.killpg if group else os.kill)(self.pid, number)

    @classmethod
    def kill_all(cls) -> None:
        """End what is left of all that were started."""
        while cls.started:
            cls.started.pop().signal(signal.SIGKILL, group=True)

    def end(self) -> Done:
        """Wait for its end."""
        begin = time.monotonic()
        while True:
            pid, status, usage = os.wait4(self.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - begin > PATIENCE:
                self.signal(signal.SIGKILL, group=True)
                raise Lost(f"a process hangs: {self._output.read_text(errors='replace')[-2000:]}")
            time.sleep(0.01)
        self.process.returncode = os.waitstatus_to_exitcode(status)
        cpu = usage.ru_utime + usage.ru_stime
        return Done(self.process.returncode, self._output.read_text(errors="replace"), cpu)


def processor_time(processes: list[psutil.Process]) -> float:
    """Processor time (s) that processes have used, and their children that have ended."""
    total = 0.0
    for process in processes:
        with contextlib.suppress(psutil.Error):
            total += sum(process.cpu_times()[:4])
    return total


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

    @property
    def results(self) -> Path:
        """Where the results are."""
        return self.directory / "results"

    def simulation(self, id: str) -> Path:
        """The dataset of one simulation."""
        return self.results / "simulations" / f"{id}.nc"

    def checkpoint(self, id: str) -> Path:
        """The checkpoint of one simulation."""
        return self.simulation(id).with_suffix(".checkpoint.npz")

    def log(self, id: str) -> str:
        """What a simulation has written to its log."""
        return (self.results / "logs" / "simulate" / f"{id}.log").read_text(errors="replace")

    def start(
        self, *arguments: str, prepare: Callable[[], object] | None = None, **environment: str
    ) -> Running:
        """Start snakemake."""
        command = [sys.executable, "-m", "snakemake", *(arguments or ("lengths",))]
        command += ["--snakefile", str(ROOT / "Snakefile"), "--configfile", "config.yaml"]
        command += ["--workflow-profile", str(ROOT / "workflow/profiles/default")]
        return Running(command, self.directory, prepare, **environment)

    def start_alone(self, id: str, prepare: Callable[[], object] | None = None) -> Running:
        """Start the script of one simulation without Snakemake."""
        command = [sys.executable, str(Path(__file__).with_name("alone.py")), id]
        return Running(command, self.directory, prepare)

    def run(self, *arguments: str, **environment: str) -> Done:
        """Run snakemake to its end."""
        return self.start(*arguments, **environment).end()

    def run_alone(self, id: str) -> Done:
        """Run the script of one simulation to its end."""
        return self.start_alone(id).end()

    def finish(self, **environment: str) -> bool:
        """What a user does next: run it again and do what messages ask for, if it stops with any.

        Returns whether it did.
        """
        for attempt in range(4):
            done = self.run(**environment)
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
            damaged = re.findall(r"DatasetError: (\S+) is damaged", done.output)
            require(damaged, f"it can't be finished: {done.output[-3000:]}")
            for path in damaged:
                (self.directory / path).unlink(missing_ok=True)
        raise Lost(f"it can't be finished: {done.output[-3000:]}")

    def contents(self) -> dict[Path, xr.Dataset]:
        """All datasets below the results, by path."""
        paths = [path for path in self.results.rglob("*.nc") if not path.name.startswith(".")]
        return {path.relative_to(self.directory): datasets.read(path) for path in paths}

    def findings(self) -> list[Finding]:
        """What target `check` would list."""
        settings = load(self.directory / "config.yaml")
        return check_results(settings, self.directory)

    def require_same(self, reference: Reference) -> None:
        """Every dataset has the undisturbed one's values, bit for bit."""
        try:
            contents = self.contents()
        except datasets.DatasetError as error:
            raise Lost(str(error)) from error
        require(contents.keys() == reference.contents.keys(), f"datasets are {sorted(contents)}")
        for path, dataset in contents.items():
            difference = first_difference(dataset, reference.contents[path])
            require(difference is None, f"{path} differs from the undisturbed one: {difference}")

    @contextlib.contextmanager
    def unharmed(self) -> Iterator[None]:
        """Whatever happens within: each simulation that exists before is the same after."""
        before = {path: path.read_bytes() for path in self.results.glob("simulations/*.nc")}
        yield
        for path, content in before.items():
            require(path.exists(), f"{path.name} was lost")
            require(path.read_bytes() == content, f"{path.name} was changed")


def first_difference(one: xr.Dataset, other: xr.Dataset) -> str | None:
    """The first variable in which two datasets differ in a bit."""
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
    workflow = whole.run()
    require(workflow.status == 0, workflow.output)
    reference = Reference(whole.directory, directory / "stopped", whole.contents(), 0.0, 0.0)

    place = copy_of(reference, directory / "halfway", missing=IDS)
    reference.checkpoints.mkdir()
    for id in IDS:
        running = place.start_alone(id)
        require(running.wait_for(place.checkpoint(id).exists), "it has left no checkpoint")
        running.signal(signal.SIGTERM)
        require(running.end().status != 0, "it did not stop")
        require("stopped by SIGTERM" in place.log(id), "its log does not say why it stopped")
        shutil.copy2(place.checkpoint(id), reference.checkpoints)
    place.checkpoint(id).unlink()
    alone = place.run_alone(id)
    require(alone.status == 0, alone.output)
    return dataclasses.replace(reference, alone=alone.cpu, workflow=workflow.cpu)


def copy_of(reference: Reference, directory: Path, missing: tuple[str, ...] = ()) -> Place:
    """A copy of the finished workflow in which some simulations are still to be made."""
    shutil.copytree(reference.directory, directory, symlinks=True)
    place = Place(directory)
    for id in missing:
        place.simulation(id).unlink()
    return place
