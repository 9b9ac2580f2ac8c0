"""What surrounds runs: planning, a run's overhead, tables, report, checks and archives.

Studies of short runs to their event are really made, in batches, by the commands of the workflow.
"""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from nucleation.datasets import netcdf

CHECKOUT = Path(__file__).parents[1]
RUNS = (100, 1000, 5000)
"""Runs of the studies that are planned."""

MADE = 1000
"""Studies of so many runs and fewer are made."""

HEIGHTS, AGES = 10, (1.0, 2.0, 5.0, 10.0, 20.0)
"""Heights and initial states (s) of the studies; the rest is over zeta/a."""

SMALLEST = HEIGHTS * len(AGES)
"""The numbers of runs that a study can have are multiples of this."""

PER_JOB = 50
END_TIME = 40.0  # s; most runs end before, with their event


class Cost(NamedTuple):
    """What a command takes, with all processes that it starts."""

    seconds: float  # of wall time
    processor_seconds: float
    megabytes: float  # of its largest process


def cost(command: list[str], directory: Path) -> Cost:
    """Run a command of Python's, ``-m`` and what follows, in a directory; what it took.

    Raises
    ------
    RuntimeError
        With its output, if it fails.
    """
    environment = os.environ | {"PYTHONPATH": str(CHECKOUT / "src")}
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
    return [
        "-m", "snakemake", *arguments, "--quiet", "all", "--cores", "1",
        "--snakefile", str(CHECKOUT / "Snakefile"), "--configfile", "config.yaml",
        "--workflow-profile", str(CHECKOUT / "profiles" / "default"),
    ]  # fmt: skip


BUNDLE = ["-m", "nucleation.pipeline.bundle"]
COMMANDS = {
    "report": snakemake("report"),
    "nothing_to_do": snakemake("report"),
    "check": snakemake("check"),
    "bundle": [*BUNDLE, "write", "results.tar", "config.yaml"],
    "restore": [*BUNDLE, "restore", "results.tar", "config.yaml"],
}
"""What is measured once all runs of a study and its table are there."""


def configuration(runs: int, per_job: int) -> dict[str, Any]:
    """A study of so many runs over height, age and zeta/a, on a small mesh."""
    ratios = runs // SMALLEST
    over = {"start": 1.0, "stop": 2.0, "num": ratios} if ratios > 1 else 1.0
    heights = {"start": 0.005, "stop": 0.1, "num": HEIGHTS, "scale": "log"}
    study = {
        "description": "short runs, to measure what surrounds them",
        "length_over_critical": 4.0,
        "runs_per_job": per_job,
        "defaults": {"n_x": 40, "n_y": 4, "record": "lengths"},
        "runs": [{"height": heights, "zeta_over_a": over, "phi0": list(AGES)}],
    }
    stepping = {
        "end_time": END_TIME, "time_after_event": 0.0, "tolerance": 0.1, "longest_step": 0.4,
    }  # fmt: skip
    return {"stepping": stepping, "studies": {"many": study}}


def planned(runs: int, per_job: int, directory: Path) -> dict[str, float]:
    """The cost of a dry run of a study, whose configuration it leaves in the directory."""
    text = yaml.safe_dump(configuration(runs, per_job))
    (directory / "config.yaml").write_text(text, encoding="utf-8")
    return cost(snakemake("lengths", "--dry-run"), directory)._asdict()


def made(directory: Path) -> dict[str, float]:
    """The cost of a study's runs and their table, and what of it is not their steps.

    `overhead_seconds` is that of a run (wall time, as that of its steps), and
    `megabytes_of_datasets` that of all.
    """
    spent = cost(snakemake("lengths"), directory)
    paths = list((directory / "results" / "simulations").glob("[!.]*.nc"))
    stepping = sum(float(netcdf.attributes(path)["wall_seconds"]) for path in paths)
    return spent._asdict() | {
        "runs": len(paths),
        "overhead_seconds": (spent.seconds - stepping) / len(paths),
        "megabytes_of_datasets": sum(path.stat().st_size for path in paths) / 1e6,
    }


def measured(numbers: Sequence[int] = RUNS) -> dict[str, dict[str, dict[str, float]]]:
    """The costs of studies of so many runs, in directories that are removed then."""
    result: dict[str, dict[str, dict[str, float]]] = {}
    for runs in sorted(numbers):
        for per_job in (1, PER_JOB):
            costs = result[f"{runs}, {per_job} in a job"] = {}
            with tempfile.TemporaryDirectory(prefix="nucleation-bench-") as name:
                costs["planning"] = planned(runs, per_job, Path(name))
                if runs > MADE or (per_job == 1 and runs > min(numbers)):
                    continue
                costs["lengths"] = made(Path(name))
                for what, command in COMMANDS.items() if per_job > 1 else ():
                    if what == "restore":
                        Path(name, "results").rename(Path(name, "moved"))
                    costs[what] = cost(command, Path(name))._asdict()
    return result


def table(result: dict[str, dict[str, dict[str, float]]]) -> str:
    """The costs as text."""
    lines = [f"{'runs':>20}  {'':14}{'s':>8}{'cpu s':>8}{'MB':>8}"]
    for runs, costs in result.items():
        for name, spent in costs.items():
            further = [f"{k} {v:.3g}" for k, v in spent.items() if k not in Cost._fields]
            lines.append(
                f"{runs:>20}  {name:14}{spent['seconds']:8.1f}{spent['processor_seconds']:8.1f}"
                f"{spent['megabytes']:8.0f}  {', '.join(further)}".rstrip()
            )
    return "\n".join(lines)
