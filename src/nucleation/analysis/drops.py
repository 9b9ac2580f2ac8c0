"""Where runs drop, of which nothing else is kept: many of them in one table.

A study of strengths and seeds has hundreds of runs that differ in the declared perturbation alone
(:mod:`nucleation.model.perturbation`), and asks each for its onset and length.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from typing import Any

import xarray as xr

from ..model.parameters import Parameters
from ..simulation.run import simulate
from .definitions import ExtractionSettings
from .extraction import extract
from .lengths import description

MEASURED = ("onset_time", "length", "length_low", "length_high")

COLUMNS = (
    "study", "id", "law", "height", "phi0", "kind", "strength", "seed", "correlation_length", "n_x",
    "n_y", "longest_step", *MEASURED, "theory_length", "status", "steps", "wall_seconds",
)  # fmt: skip


def measure_drops(
    runs: Iterable[dict[str, Any]],
    settings: ExtractionSettings = ExtractionSettings(),
    simulated: Callable[[Parameters], xr.Dataset] = simulate,
) -> xr.Dataset:
    """Simulate runs one after another, and measure each: :data:`COLUMNS` on ``run``.

    Parameters
    ----------
    runs : of :meth:`nucleation.configuration.studies.Run.to_dict`.
    settings : how onset and length are read; NaN where a run has no event, as its status says.
    simulated : what gives a run's record.
    """
    rows = []
    for run in runs:
        record = simulated(Parameters.from_dict(run["parameters"]))
        measured = extract(record, settings)
        row = description(run) | {name: measured[name] for name in MEASURED}
        row["correlation_length"] = run["parameters"]["perturbation"]["correlation_length"]
        row |= {name: record.attrs[name] for name in ("status", "steps", "wall_seconds")}
        rows.append(row)
        print(
            f"{run['id']}: onset {row['onset_time']:.4f} s, length {row['length']:.5f} m, "
            f"{row['steps']} steps in {row['wall_seconds']:.1f} s",
            file=sys.stderr,
        )
    return xr.Dataset({name: ("run", [row[name] for row in rows]) for name in COLUMNS})
