"""What a study of thousands of runs costs beside the runs: planning, tables, check, archive.

The datasets of the study are one short simulation over and over, each under a run's own key and
with its parameters, so that everything around the runs is measured in minutes: Snakemake and all
scripts take them for the results of the study.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import yaml

from ...configuration.load import Configuration, load
from ...configuration.runs import Run
from ...datasets import netcdf, provenance
from ...model.friction.registry import plugins
from ...simulation.run import simulate
from .. import code, keys
from ..keys import Store
from .processes import CHECKOUT, Cost, cost, in_a_job, snakemake, with_simulations

RUNS = (100, 1000, 5000)
"""Runs of the studies that are measured."""

HEIGHTS, AGES = 10, (1.0, 2.0, 5.0, 10.0, 20.0)
"""Heights and initial states (s) of the study; the rest is over zeta/a."""

SMALLEST = HEIGHTS * len(AGES)
"""The numbers of runs that a study can have are multiples of this."""

BRIEF = 0.5
"""End time (s) of the runs that are really made."""

STUDY = "many"
SCRIPT = CHECKOUT / "workflow" / "scripts" / "simulate.py"


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


def brief(values: dict[str, Any]) -> dict[str, Any]:
    """The same study with runs that end at once: of a job, what surrounds its steps is measured."""
    return values | {"stepping": values["stepping"] | {"end_time": BRIEF}}


def origin(run: Run) -> tuple[dict[str, Any], str, str]:
    """What a simulation depends on: its parameters, the code's digest, and its key."""
    parameters = run.parameters.to_dict()
    digest = code.digest(str(SCRIPT), *code.ALWAYS, *plugins(run.parameters))
    return parameters, digest, keys.key(digest, {"parameters": parameters}, {})


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
        parameters, digest, key = origin(run)
        path = Path(store.dataset("simulations", run.id, key))
        attributes = provenance.attributes(parameters, digest, "make bench", key=key)
        netcdf.write(record, path, **attributes)
        size += path.stat().st_size
    return size


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


def configured(values: dict[str, Any], directory: Path) -> Configuration:
    """The configuration that commands in a directory find."""
    path = directory / "config.yaml"
    path.write_text(yaml.safe_dump(values), encoding="utf-8")
    return load(path)


def measured(runs: int, directory: Path) -> dict[str, Any]:
    """The costs of all :data:`COMMANDS` for a study of so many runs, in an empty directory."""
    run = configured(brief(configuration(runs)), directory).runs[0]
    job = in_a_job("simulate", run.id, origin(run)[2])
    result: dict[str, Any] = {"job": with_simulations(job, directory)}
    settings = configured(configuration(runs), directory)
    for name, command in COMMANDS.items():
        if name == "lengths":
            result["megabytes_of_datasets"] = fill(settings, directory) / 1e6
        if name == "restore":
            (directory / "results").rename(directory / "moved")
        result[name] = cost(command, directory)._asdict()
    return result


def in_new_directory(measure: Callable[[int, Path], dict[str, Any]], runs: int) -> dict[str, Any]:
    """What is measured of so many runs, in a directory that is removed then."""
    with tempfile.TemporaryDirectory(prefix="nucleation-bench-") as directory:
        return measure(runs, Path(directory))


def report(result: dict[str, Any]) -> str:
    """The costs as a table."""
    lines = [f"{'runs':>16}  {'':14}{'s':>8}{'cpu s':>8}{'MB':>8}"]
    for runs, costs in result.items():
        for name, spent in costs.items():
            if isinstance(spent, dict):
                further = [f"{k} {v:.3g}" for k, v in spent.items() if k not in Cost._fields]
                lines.append(
                    f"{runs:>16}  {name:14}{spent['seconds']:8.1f}"
                    f"{spent['processor_seconds']:8.1f}{spent['megabytes']:8.0f}"
                    f"  {', '.join(further)}".rstrip()
                )
    return "\n".join(lines)
