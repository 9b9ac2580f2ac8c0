"""What a run costs beside its steps, and on the disk: small studies that are really run."""

from __future__ import annotations

import dataclasses
import tempfile
from pathlib import Path
from typing import Any

import yaml

from ...datasets import netcdf
from ...model.parameters import Parameters
from ...model.recording import LEVELS
from ...simulation.run import simulate
from . import scale
from .processes import snakemake, with_simulations

STUDIES = {"in batches of 25": (100, 25), "single jobs": (20, 1)}
"""Runs, and runs of one job, of the studies that are run."""


def configuration(runs: int, per_job: int) -> dict[str, Any]:
    """A study of so many short runs, from a beginning to their event, over height and seed."""
    whole = scale.configuration(scale.SMALLEST)
    study = whole["studies"][scale.STUDY]
    study["runs_per_job"] = per_job
    study["defaults"] = {
        "n_x": 60, "n_y": 6, "grading": 6.0, "record": "lengths", "perturbation": "normal_load",
        "strength": 1e-3,
    }  # fmt: skip
    study["runs"] = [{"height": [0.01, 0.02, 0.04, 0.08], "seed": list(range(1, runs // 4 + 1))}]
    return whole


def study(runs: int, per_job: int, profile: str = "default") -> dict[str, float]:
    """The cost of a whole study, from its planning to its table, run one job at a time.

    Parameters
    ----------
    runs : a multiple of 4.
    per_job : of them in one job.
    profile : below ``workflow/profiles``; of another than this machine's, the processor time is
        that of Snakemake alone, and as many jobs run as its nodes have room for, so that the
        overhead is none.
    """
    with tempfile.TemporaryDirectory(prefix="nucleation-bench-") as directory:
        values = yaml.safe_dump(configuration(runs, per_job))
        Path(directory, "config.yaml").write_text(values, encoding="utf-8")
        command = snakemake("lengths", "--quiet", "all", profile=profile)
        return with_simulations(command, Path(directory))


def on_disk(parameters: Parameters) -> dict[str, float]:
    """The size (MB) of one run's dataset, by the level at which it is recorded."""
    sizes = {}
    with tempfile.TemporaryDirectory(prefix="nucleation-bench-") as directory:
        path = Path(directory, "run.nc")
        for level in LEVELS:
            recording = dataclasses.replace(parameters.recording, record=level)
            netcdf.write(simulate(dataclasses.replace(parameters, recording=recording)), path)
            sizes[level] = path.stat().st_size / 1e6
    return sizes


def overhead(parameters: Parameters, profile: str = "default") -> dict[str, Any]:
    """All of it; `parameters` are those of the run whose size is measured."""
    studies = {name: study(*size, profile) for name, size in STUDIES.items()}
    return {"studies": studies, "megabytes_of_one_run": on_disk(parameters)}


def report(result: dict[str, Any]) -> str:
    """The costs as a table."""
    sizes = ", ".join(f"{k} {v:.2f}" for k, v in result["megabytes_of_one_run"].items())
    return scale.report({"small study": result["studies"]}) + f"\nMB of one run: {sizes}"
