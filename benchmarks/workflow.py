"""The cost beside the simulations: planning, a run's overhead, tables, figures, checks, archives.

Studies of short runs to their event are made in batches, by the commands of the workflow.
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
"""Numbers of runs of the studies that are planned."""

MADE = 1000
"""Studies of up to this number of runs are made."""

HEIGHTS, AGES = 10, (1.0, 2.0, 5.0, 10.0, 20.0)
"""Number of heights and the initial states (s) of the studies; the rest varies zeta/a."""

SMALLEST = HEIGHTS * len(AGES)
"""The number of runs of a study is a multiple of this."""

PER_JOB = 50
END_TIME = 40.0  # s; most runs end before, with their event

Costs = dict[str, dict[str, dict[str, float]]]
"""Costs by study and command."""


class _Cost(NamedTuple):
    """The cost of a command, with all processes that it starts.

    Parameters
    ----------
    seconds, processor_seconds : float
        Wall time and processor time (s).
    megabytes : float
        Memory of its largest process (MB).
    """

    seconds: float
    processor_seconds: float
    megabytes: float


def _cost(command: list[str], directory: Path) -> _Cost:
    """Run a command of Python's, ``-m`` and its arguments, in a directory; return its cost.

    A command that fails is a RuntimeError with its output.
    """
    environment = os.environ | {"PYTHONPATH": str(CHECKOUT / "src")}
    start = time.perf_counter()
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(
            [sys.executable, *command],
            cwd=directory,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )
        _, status, used = os.wait4(process.pid, 0)  # with its children
        process.returncode = os.waitstatus_to_exitcode(status)
        if status:
            output.seek(0)
            text = output.read().decode(errors="replace")
            raise RuntimeError(f"{' '.join(command)} failed:\n{text[-4000:]}")
    seconds = time.perf_counter() - start
    return _Cost(seconds, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024.0)


def snakemake(*arguments: str) -> list[str]:
    """Return a command of Snakemake on the present configuration, one job at a time."""
    return [
        "-m",
        "snakemake",
        *arguments,
        "--quiet",
        "all",
        "--cores",
        "1",
        "--snakefile",
        str(CHECKOUT / "Snakefile"),
        "--configfile",
        "config.yaml",
        "--workflow-profile",
        str(CHECKOUT / "profiles" / "default"),
    ]


COMMANDS = {
    "figures": snakemake("figures"),
    "nothing_to_do": snakemake("figures"),
    "check": snakemake("check"),
}
"""The commands that are measured once all runs of a study and its table are made."""


def configuration(runs: int, per_job: int) -> dict[str, Any]:
    """Write the configuration of a study over height, age and zeta/a, on a small mesh.

    Parameters
    ----------
    runs : int
        Number of runs, a multiple of :data:`SMALLEST`.
    per_job : int
        Number of runs in a job.

    Returns
    -------
    dict
    """
    ratios = runs // SMALLEST
    zeta_over_a: Any = 1.0
    if ratios > 1:
        zeta_over_a = {"start": 1.0, "stop": 2.0, "num": ratios}
    heights = {"start": 0.005, "stop": 0.1, "num": HEIGHTS, "scale": "log"}
    study = {
        "description": "short runs, to measure the cost beside them",
        "length_over_critical": 4.0,
        "runs_per_job": per_job,
        "defaults": {"n_x": 40, "n_y": 4, "record": "lengths"},
        "runs": [{"height": heights, "zeta_over_a": zeta_over_a, "initial_state": list(AGES)}],
    }
    stepping = {
        "end_time": END_TIME,
        "time_after_event": 0.0,
        "tolerance": 0.1,
        "longest_step": 0.4,
    }
    return {"stepping": stepping, "studies": {"many": study}}


def _planned(runs: int, per_job: int, directory: Path) -> dict[str, float]:
    """The cost of a dry run of a study; its configuration stays in the directory."""
    text = yaml.safe_dump(configuration(runs, per_job))
    (directory / "config.yaml").write_text(text, encoding="utf-8")
    return _cost(snakemake("lengths", "--dry-run"), directory)._asdict()


def _made(directory: Path) -> dict[str, float]:
    """The cost of a study's runs and their table, and the part of it beside their steps.

    `overhead_seconds` is the wall time of a run without that of its steps, and
    `megabytes_of_datasets` the size of all records.
    """
    spent = _cost(snakemake("lengths"), directory)
    paths = list((directory / "results" / "simulations").glob("[!.]*.nc"))
    stepping = sum(float(netcdf.attributes(path)["wall_seconds"]) for path in paths)
    size = sum(path.stat().st_size for path in paths)
    return spent._asdict() | {
        "runs": len(paths),
        "overhead_seconds": (spent.seconds - stepping) / len(paths),
        "megabytes_of_datasets": size / 1e6,
    }


def _study_costs(runs: int, per_job: int, makes: bool) -> dict[str, dict[str, float]]:
    """The costs of one study by command, in a directory that is removed afterwards."""
    with tempfile.TemporaryDirectory(prefix="nucleation-bench-") as name:
        directory = Path(name)
        costs = {"planning": _planned(runs, per_job, directory)}
        if not makes:
            return costs
        costs["lengths"] = _made(directory)
        if per_job == 1:
            return costs
        for command, arguments in COMMANDS.items():
            costs[command] = _cost(arguments, directory)._asdict()
        return costs


def measure_workflow(numbers: Sequence[int] = RUNS) -> Costs:
    """Return the costs of studies of some numbers of runs, with one run and more in a job."""
    costs = {}
    for runs in sorted(numbers):
        for per_job in (1, PER_JOB):
            smallest = runs == min(numbers)
            makes = runs <= MADE and (per_job > 1 or smallest)
            costs[f"{runs}, {per_job} in a job"] = _study_costs(runs, per_job, makes)
    return costs


def workflow_table(costs: Costs) -> str:
    """Return the costs as text."""
    lines = [f"{'runs':>20}  {'':14}{'s':>8}{'cpu s':>8}{'MB':>8}"]
    for runs, by_command in costs.items():
        for name, spent in by_command.items():
            seconds, processor_seconds, megabytes = (spent[field] for field in _Cost._fields)
            further = [f"{k} {v:.3g}" for k, v in spent.items() if k not in _Cost._fields]
            line = f"{runs:>20}  {name:14}{seconds:8.1f}{processor_seconds:8.1f}{megabytes:8.0f}"
            lines.append(f"{line}  {', '.join(further)}".rstrip())
    return "\n".join(lines)
