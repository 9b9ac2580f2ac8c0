"""``python -m benchmarks.crosscheck``: three runs by FreeFem++ and by this project, compared."""

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from nucleation.extraction.extraction import Record, extract
from nucleation.run.run import Run
from nucleation.simulation.run import simulate
from replication.configuration.load import load
from replication.tables.curves import main_text

from .freefem import FIXED, solve

SETTLED = 20.0  # start of the comparison, in units of D/V
BEFORE_ONSET = 0.9  # end of the comparison, as a part of the earlier onset
INSTANTS = 2000  # at which two records are compared
LENGTH = 2.0  # of the blocks over the theory's critical length

COMMON = FIXED | {
    "perturbation": "normal_load",
    "strength": 1e-4,
    "seed": 1,
    "time_after_event": 0.05,
    "n_x": 800,
    "n_y": 8,
}
STIFFER = {"second_body": "deformable", "second_far_side": "clamped", "second_shear_modulus": 6.2e9}
RUNS: dict[str, dict[str, Any]] = {
    "H0.005": {"height": 0.005},
    "H0.05": {"height": 0.05},
    "pair": {"height": 0.02, "n_x": 300, "n_y": 6, **STIFFER},
}


def runs() -> dict[str, Run]:
    """The runs by name, with material, friction and steps of the paper's configuration."""
    settings = load("config/config.yaml")
    found = {}
    for name, changes in RUNS.items():
        run = settings.base.replaced(**COMMON | changes)
        length = LENGTH * main_text(run.fault).critical_length()
        found[name] = run.replaced(block_length=float(f"{length:.4g}"))
    return found


def compare(own: xr.Dataset, theirs: xr.Dataset) -> dict[str, float]:
    """Onset (s), length (m) and differences of two records of one run.

    Differences of L(t) and f_d(t) are relative to the own record; the largest of L(t) is given in
    elements as well. NaN where a run has no event or no patch.
    """
    record, record_freefem = Record(own), Record(theirs)
    parameters = record.run
    found, found_freefem = extract(own), extract(theirs)
    end = BEFORE_ONSET * min(found["onset_time"], found_freefem["onset_time"])
    instants = np.linspace(SETTLED * parameters.memory_time, end, INSTANTS)
    patch = np.interp(instants, record.time, record.lengths)
    patch_freefem = np.interp(instants, record_freefem.time, record_freefem.lengths)
    exists = (patch > 0.0) & (patch_freefem > 0.0)
    longer = patch_freefem[exists] - patch[exists]
    force, force_freefem = (
        np.interp(instants, run["step_time"].values, run["driving_force"].values)
        for run in (own, theirs)
    )
    stronger = force_freefem / force - 1.0
    element = parameters.block.length / parameters.block.n_x
    return {
        "height": parameters.fault.height,
        "n_x": parameters.block.n_x,
        "n_y": parameters.block.n_y,
        "onset_time": found["onset_time"],
        "onset_time_freefem": found_freefem["onset_time"],
        "length": found["length"],
        "length_freefem": found_freefem["length"],
        "patch_length_rms": _root_mean_square(longer / patch[exists]),
        "patch_length_largest": _largest(longer / patch[exists]),
        "patch_length_elements": _largest(longer / element),
        "driving_force_rms": _root_mean_square(stronger),
        "driving_force_largest": _largest(stronger),
        "steps": own.attrs["steps"],
        "steps_freefem": theirs.attrs["steps"],
    }


def _root_mean_square(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2))) if values.size else np.nan


def _largest(values: np.ndarray) -> float:
    return float(np.abs(values).max()) if values.size else np.nan


def main() -> None:
    rows = []
    for name, run in runs().items():
        with TemporaryDirectory() as directory:
            theirs = solve(Path(directory), run)
        rows.append({"id": name, **compare(simulate(run), theirs)})
        print(pd.Series(rows[-1]).to_string(), flush=True)
    path = Path("results", "crosscheck.csv")
    path.parent.mkdir(exist_ok=True)
    pd.DataFrame(rows).to_csv(path, index=False)


if __name__ == "__main__":
    main()
