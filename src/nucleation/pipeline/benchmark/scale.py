"""What a study of thousands of runs costs beside the runs: planning, tables, check, archive.

The datasets of the study are one short simulation over and over, each under a run's own key and
with its parameters, so that everything around the runs is measured in minutes: Snakemake and all
scripts take them for the results of the study.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from ...configuration.load import Configuration, load
from ...datasets import netcdf, provenance
from ...model.friction.registry import plugins
from ...simulation.run import simulate
from .. import code, keys
from ..code import ROOT
from ..keys import Store

CHECKOUT = ROOT.parent.parent
RUNS = (100, 1000, 5000)
"""Runs of the studies that are measured."""

HEIGHTS, AGES = 10, (1.0, 2.0, 5.0, 10.0, 20.0)
"""Heights and initial states (s) of the study; the rest is over zeta/a."""

SMALLEST = HEIGHTS * len(AGES)
"""The numbers of runs that a study can have are multiples of this."""

STUDY = "many"
SCRIPT = CHECKOUT / "workflow" / "scripts" / "simulate.py"


class Cost(NamedTuple):
    """What a command takes, with all processes that it starts."""

    seconds: float  # of wall time
    processor_seconds: float
    megabytes: float  # of its largest process


def configuration(runs: int) -> dict[str, Any]:
    """A study of so many runs over height, age and zeta/a, on a small mesh."""
    ratios = runs // SMALLEST
    over = {"start": 1.0, "stop": 2.0, "num": ratios} if ratios > 1 else 1.0
    return {
        "stepping": {
            "end_time": 40.0, "time_after_event": 0.0, "tolerance": 0.1, "longest_step": 0.4,
        },
        "studies": {
            STUDY: {
                "description": "one simulation under many names, to measure what surrounds runs",
                "length_over_critical": 4.0,
                "defaults": {"n_x": 40, "n_y": 4},
                "runs": [{
                    "height": {"start": 0.005, "stop": 0.1, "num": HEIGHTS, "scale": "log"},
                    "zeta_over_a": over,
                    "phi0": list(AGES),
                }],
            }
        },
    }  # fmt: skip


def fill(settings: Configuration, directory: Path) -> int:
    """Write a dataset for each run of a configuration, all with the values of the first run.

    Of its fields every tenth time is kept, so that thousands take a gigabyte and not ten.

    Returns
    -------
    int
        Their size together (bytes).
    """
    record = simulate(settings.runs[0].parameters).isel(time=slice(None, None, 10))
    store, size = Store(directory / settings.results), 0
    for run in settings.runs:
        parameters = run.parameters.to_dict()
        digest = code.digest(str(SCRIPT), *code.ALWAYS, *plugins(run.parameters))
        key = keys.key(digest, {"parameters": parameters}, {})
        path = Path(store.dataset("simulations", run.id, key))
        attributes = provenance.attributes(parameters, digest, "make bench", key=key)
        netcdf.write(record, path, **attributes)
        size += path.stat().st_size
    return size


def cost(command: list[str], directory: Path) -> Cost:
    """Run a command of Python's, ``-m`` and what follows, in a directory; what it took.

    Raises
    ------
    RuntimeError
        With its output, if it fails.
    """
    environment = os.environ | {"PYTHONPATH": str(ROOT.parent)}
    start = time.perf_counter()
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(
            [sys.executable, *command], cwd=directory, env=environment, stdin=subprocess.DEVNULL,
            stdout=output, stderr=subprocess.STDOUT,
        )  # fmt: skip
        _, status, used = os.wait4(process.pid, 0)  # of its own children too
        process.returncode = os.waitstatus_to_exitcode(status)
        if status:
            output.seek(0)
            said = output.read().decode(errors="replace")
            raise RuntimeError(f"{' '.join(command)} failed:\n{said[-4000:]}")
    return Cost(time.perf_counter() - start, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024.0)


def snakemake(*arguments: str) -> list[str]:
    """Snakemake on the present configuration, one job at a time."""
    profile = str(CHECKOUT / "workflow" / "profiles" / "default")
    return [
        "-m", "snakemake", *arguments, "--snakefile", str(CHECKOUT / "Snakefile"),
        "--workflow-profile", profile, "--configfile", "config.yaml", "--cores", "1",
    ]  # fmt: skip


BUNDLE = ["-m", "nucleation.pipeline.bundle"]

COMMANDS = {
    "dry_run": snakemake("lengths", "--dry-run", "--quiet", "all"),
    "lengths": snakemake("lengths", "--quiet", "all"),
    "figures": snakemake("figure_studies", "--quiet", "all"),
    "report": snakemake("report", "--quiet", "all"),
    "nothing_to_do": snakemake("report", "--quiet", "all"),
    "check": snakemake("check", "--quiet", "all"),
    "bundle": [*BUNDLE, "write", "results.tar", "config.yaml"],
    "restore": [*BUNDLE, "restore", "results.tar", "config.yaml"],
}
"""What is measured, in this order. The dry run has all runs before it; all else finds them made."""


def measured(runs: int, directory: Path) -> dict[str, Any]:
    """The costs of all :data:`COMMANDS` for a study of so many runs, in an empty directory."""
    path = directory / "config.yaml"
    path.write_text(yaml.safe_dump(configuration(runs)), encoding="utf-8")
    result: dict[str, Any] = {}
    for name, command in COMMANDS.items():
        if name == "lengths":
            result["megabytes_of_datasets"] = fill(load(path), directory) / 1e6
        if name == "restore":
            (directory / "results").rename(directory / "moved")
        result[name] = cost(command, directory)._asdict()
    return result


def scale(numbers: tuple[int, ...] = RUNS) -> dict[str, Any]:
    """The costs for studies of so many runs each."""
    result = {}
    for runs in numbers:
        with tempfile.TemporaryDirectory(prefix="nucleation-bench-") as directory:
            result[str(runs)] = measured(runs, Path(directory))
    return result


def report(result: dict[str, Any]) -> str:
    """The costs as a table."""
    lines = [f"{'runs':>6}  {'':14}{'s':>8}{'cpu s':>8}{'MB':>8}"]
    for runs, costs in result.items():
        for name, spent in costs.items():
            if isinstance(spent, dict):
                lines.append(
                    f"{runs:>6}  {name:14}{spent['seconds']:8.1f}"
                    f"{spent['processor_seconds']:8.1f}{spent['megabytes']:8.0f}"
                )
    return "\n".join(lines)
