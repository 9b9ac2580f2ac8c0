"""Commands of the workflow, and what they take with all processes that they start."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from ...datasets import netcdf
from ..code import ROOT

CHECKOUT = ROOT.parent.parent


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


def with_simulations(command: list[str], directory: Path) -> dict[str, float]:
    """The cost of a command that makes simulations, the first ones in the directory.

    Returns
    -------
    dict
        As :class:`Cost`, and: `first_step_seconds` from its start to the beginning of the first
        simulation, `stepping_seconds` of all simulations, `runs`, their number, and
        `overhead_seconds` of a run beside its steps, where there is one after another: wall time,
        as that of the steps is.
    """
    began = time.time()
    spent = cost(command, directory)
    paths = list((directory / "results" / "simulations").glob("[!.]*.nc"))
    seconds = {path: float(netcdf.attributes(path)["wall_seconds"]) for path in paths}
    first = min(path.stat().st_mtime - of_run for path, of_run in seconds.items())
    stepping = sum(seconds.values())
    return spent._asdict() | {
        "first_step_seconds": first - began,
        "stepping_seconds": stepping,
        "runs": len(paths),
        "overhead_seconds": (spent.seconds - stepping) / len(paths),
    }


def snakemake(*arguments: str, profile: str = "default") -> list[str]:
    """Snakemake on the present configuration, on this machine one job at a time."""
    here = ["--cores", "1"] if profile == "default" else []
    return [
        "-m", "snakemake", *arguments, "--snakefile", str(CHECKOUT / "Snakefile"),
        "--workflow-profile", str(CHECKOUT / "workflow" / "profiles" / profile),
        "--configfile", "config.yaml", *here,
    ]  # fmt: skip


def in_a_job(rule: str, name: str, key: str) -> list[str]:
    """The Snakemake in a cluster's job that makes one dataset.

    Before it another one is started there, which does nothing but start this one.
    """
    job = f"{rule}:name={name},key={key}"
    options = ["--allowed-rules", rule, "--mode", "remote", "--nolock", "--force-use-threads"]
    return snakemake("--target-jobs", job, *options)
