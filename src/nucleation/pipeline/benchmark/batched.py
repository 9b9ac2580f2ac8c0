"""What a map of thousands of runs costs beside them, where one job makes many of them.

As in :mod:`.scale` the datasets are one short simulation over and over; here the tables of the
batches are made up as well.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ...analysis import lengths
from ...configuration.load import Configuration
from ...configuration.runs import Run
from ...datasets import netcdf, provenance
from ...model.friction.registry import plugins
from ...patch.batches import STABILITY
from .. import code, keys
from ..keys import Store
from . import scale
from .processes import cost, in_a_job, snakemake, with_simulations

STUDY, PER_JOB, SEEDS = "map", 50, (1, 2, 3, 4, 5)
SCRIPT = scale.SCRIPT.with_name("batch.py")
UNSTABLE_AT = 0.55
"""The made-up length at which patches turn unstable, over the theory's."""

COMMANDS = {
    "figure_map": snakemake("figure_map", "--quiet", "all"),
    **{name: scale.COMMANDS[name] for name in ("report", "nothing_to_do", "check")},
}
"""What is measured once all runs and the tables of their batches are there."""


def configuration(runs: int) -> dict[str, Any]:
    """A map of so many runs over height, zeta/a and seed, on a small mesh."""
    whole = scale.configuration(runs)
    study = whole["studies"].pop(scale.STUDY)
    study |= {"table": "own", "runs_per_job": PER_JOB, "measure": "stability"}
    study["defaults"] |= {"perturbation": "normal_load", "strength": 1e-3, "record": "lengths"}
    (values,) = study["runs"]
    values["seed"] = list(SEEDS)
    del values["phi0"]
    whole["studies"][STUDY] = study
    return whole


def batches_of(runs: Iterable[Run]) -> dict[str, list[Run]]:
    """The runs of each batch, by the batch's name."""
    found: dict[str, list[Run]] = {}
    for run in runs:
        found.setdefault(run.batch, []).append(run)
    return found


def origin(settings: Configuration, runs: list[Run]) -> tuple[dict[str, Any], str, str]:
    """What the table of a batch depends on: its parameters, the code's digest, and its key."""
    laws = sorted({law for run in runs for law in plugins(run.parameters)})
    digest = code.digest(str(SCRIPT), *code.ALWAYS, *laws)
    parameters = {
        "runs": [run.to_dict() for run in runs],
        "extraction": asdict(settings.extraction),
        "measure": settings.studies[STUDY].measure,
    }
    return parameters, digest, keys.key(digest, parameters, {})


def fill(settings: Configuration, directory: Path) -> int:
    """Write a dataset for each run, and the table of each batch.

    Returns
    -------
    int
        The size of the runs' datasets together (bytes).
    """
    size = scale.fill(settings, directory)
    store = Store(directory / settings.results)
    first = settings.runs[0]
    record = netcdf.read(store.dataset("simulations", first.id, scale.origin(first)[2]))
    for name, runs in batches_of(settings.runs).items():
        parameters, digest, key = origin(settings, runs)
        rows = (lengths.gather([run.to_dict()], [record], settings.extraction) for run in runs)
        table = lengths.join(rows)
        unstable = UNSTABLE_AT * table["theory_length"].values
        values = zip(STABILITY.items(), (unstable, 0.01 * unstable), strict=True)
        table = table.assign({n: ("run", v, c.attributes) for (n, c), v in values})
        attributes = provenance.attributes(parameters, digest, "make bench", key=key)
        netcdf.write(table, store.dataset("batches", name, key), **attributes)
    return size


def first_batch(settings: Configuration) -> list[str]:
    """The command by which a cluster's job makes the first batch."""
    name, runs = next(iter(batches_of(settings.runs).items()))
    return in_a_job("batch", name, origin(settings, runs)[2])


def measured(runs: int, directory: Path) -> dict[str, Any]:
    """The costs of a map of so many runs, in an empty directory."""
    values = configuration(runs)
    job = first_batch(scale.configured(scale.brief(values), directory))
    result: dict[str, Any] = {"job": with_simulations(job, directory)}
    settings = scale.configured(values, directory)
    dry_run = snakemake("figure_map", "--dry-run", "--quiet", "all")
    result["dry_run"] = cost(dry_run, directory)._asdict()
    result["megabytes_of_datasets"] = fill(settings, directory) / 1e6
    for name, command in COMMANDS.items():
        result[name] = cost(command, directory)._asdict()
    return result
