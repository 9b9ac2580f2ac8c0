"""The table of critical lengths: one row for each simulation, SI units."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from ..datasets.variables import VARIABLES
from ..model.parameters import Parameters
from .definitions import ExtractionSettings
from .extraction import extract
from .record import Record

Array = NDArray[np.float64]

OVER_REALISATIONS: dict[str, Callable[[Array], Any]] = {
    "onset_time": np.mean, "onset_time_low": np.min, "onset_time_high": np.max,
    "length": np.mean, "length_low": np.min, "length_high": np.max,
}  # fmt: skip
"""What the realisations of one fault have in common: of each number that differs."""

MEASURED = tuple(OVER_REALISATIONS)
"""What :func:`nucleation.analysis.extraction.extract` reads from a simulation."""

DIAGNOSTICS = ("status", "steps", "wall_seconds", "peak_megabytes")
"""Attributes of a simulation's dataset that go into the table."""

SECOND_BODY = ("second_height", "second_shear_modulus", "second_poisson_ratio")

COLUMNS = (
    "id", "study", "law", "height", "phi0", "n_x", "n_y", *MEASURED, "theory_length", *DIAGNOSTICS,
    "block_length", "grading", "tolerance", "longest_step", "density", "slip_distance", "velocity",
    "applied_stress", "shear_modulus", "poisson_ratio", "friction_coefficient", "direct_effect",
    "velocity_weakening", "friction_law", "below", "initial_stress", "initial_shear_stress",
    "simulated_time", "reached_length", "kind", "strength", "seed",
    "correlation_length", "far_side", *SECOND_BODY,
)  # fmt: skip
"""Which simulation a row is about, what was measured, what it cost, and what it was given."""

EITHER = ("id", "seed", *MEASURED, *DIAGNOSTICS, "simulated_time", "reached_length")
"""Columns in which realisations of one fault may differ."""


def gather(
    runs: Iterable[dict[str, Any]],
    simulations: Iterable[xr.Dataset],
    settings: ExtractionSettings,
) -> xr.Dataset:
    """The table of runs, with what is extracted from their simulations.

    Parameters
    ----------
    runs : iterable of dict
        From :meth:`nucleation.configuration.runs.Run.to_dict`.
    simulations : iterable of Dataset
        Their simulations, in the same order.
    settings : ExtractionSettings
        How lengths are read.

    Returns
    -------
    Dataset
        The variables :data:`COLUMNS` on the dimension ``run``.
    """
    rows = [
        _row(run, simulation, settings) for run, simulation in zip(runs, simulations, strict=True)
    ]
    return xr.Dataset({name: ("run", [row[name] for row in rows]) for name in COLUMNS})


def join(tables: Iterable[xr.Dataset]) -> xr.Dataset:
    """One table of the rows of several."""
    return xr.concat(list(tables), dim="run", combine_attrs="drop")


def realisations(table: xr.Dataset) -> list[list[int]]:
    """The rows of each fault in a table of lengths, which differ in the declared seed alone."""
    same = [
        [None if value != value else value for value in table[name].values.tolist()]  # NaN
        for name in table.data_vars
        if name not in EITHER
    ]
    faults: dict[tuple[Any, ...], list[int]] = {}
    for i, key in enumerate(zip(*same, strict=True)):
        faults.setdefault(key, []).append(i)
    return list(faults.values())


def over_realisations(table: xr.Dataset) -> xr.Dataset:
    """A table of lengths with one row for each fault, the mean of its realisations.

    The row has their mean onset and length, the outermost ends of their ranges, and everything else
    of the first of them; ``realisations`` counts them. NaN if one of them has no event.
    """
    faults = realisations(table)
    columns = {}
    for name in map(str, table.data_vars):
        values = table[name].values
        if name in OVER_REALISATIONS:
            columns[name] = np.array([OVER_REALISATIONS[name](values[rows]) for rows in faults])
        else:
            columns[name] = values[[rows[0] for rows in faults]]
    columns["realisations"] = np.array([len(rows) for rows in faults])
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


def declared(run: dict[str, Any]) -> dict[str, Any]:
    """The columns that say how a run is perturbed; the strength of a quiet one is zero."""
    perturbation = run["parameters"]["perturbation"]
    acts = perturbation["kind"] != "none"
    return {
        "kind": perturbation["kind"],
        "strength": perturbation["strength"] if acts else 0.0,
        "seed": perturbation["seed"],
        "correlation_length": perturbation["correlation_length"],
    }


def description(run: dict[str, Any]) -> dict[str, Any]:
    """The columns that say which simulation a row is about, and the theory's length for it."""
    parameters = run["parameters"]
    return declared(run) | {
        "id": run["id"],
        "study": run["study"],
        "law": parameters["friction"]["evolution"],
        "height": parameters["geometry"]["height"],
        "phi0": parameters["loading"]["initial_state"],
        "n_x": parameters["mesh"]["n_x"],
        "n_y": parameters["mesh"]["n_y"],
        "theory_length": run["theory_length"],
        "block_length": parameters["geometry"]["length"],
        "grading": parameters["mesh"]["grading"],
        "tolerance": parameters["stepping"]["tolerance"],
        "longest_step": parameters["stepping"]["longest_step"],
        "density": parameters["material"]["density"],
        "slip_distance": parameters["friction"]["characteristic_slip_distance"],
        "velocity": parameters["loading"]["velocity"],
        "applied_stress": parameters["loading"]["normal_stress"],
    }


def _given(run: dict[str, Any]) -> dict[str, Any]:
    """What else a run was given: material, friction of the theory, start."""
    parameters, interface = run["parameters"], run["interface"]
    return second_body(Parameters.from_dict(parameters)) | {
        "shear_modulus": parameters["material"]["shear_modulus"],
        "poisson_ratio": parameters["material"]["poisson_ratio"],
        "friction_coefficient": interface["friction"],
        "direct_effect": interface["a"],
        "velocity_weakening": interface["zeta"],
        "friction_law": parameters["friction"]["law"],
        "below": parameters.get("second_body", {}).get("kind", "rigid"),
        "initial_stress": parameters["loading"]["initial_stress"],
        "initial_shear_stress": parameters["loading"]["initial_shear_stress"],
    }


def second_body(parameters: Parameters) -> dict[str, Any]:
    """The columns on what lies below: a rigid base has no far side and an infinite modulus."""
    below = parameters.below
    if below is None:
        unknown = dict.fromkeys(("height", "poisson_ratio"), np.nan)
        values = {"shear_modulus": np.inf, **unknown}
    else:
        values = dataclasses.asdict(below.material) | {"height": below.geometry.height}
    return {
        "far_side": "none" if below is None else below.bottom,
        **{name: values[name.removeprefix("second_")] for name in SECOND_BODY},
    }


def _row(
    run: dict[str, Any], simulation: xr.Dataset, settings: ExtractionSettings
) -> dict[str, Any]:
    measured = extract(simulation, settings)
    reached = measured["length"]
    if np.isnan(reached):
        reached = Record(simulation, settings).lengths[-1]
    return {
        **description(run),
        **_given(run),
        **{name: float(measured[name]) for name in MEASURED},
        **{name: simulation.attrs[name] for name in DIAGNOSTICS},
        "simulated_time": float(simulation["step_time"].values[-1]),
        "reached_length": float(reached),
    }


def row(table: xr.Dataset, identifier: str) -> xr.Dataset:
    """The row of one simulation, by its id."""
    (index,) = np.flatnonzero(table["id"].values == identifier)
    return table.isel(run=int(index))


def columns_csv(columns: tuple[str, ...] = COLUMNS) -> str:
    """Unit and meaning of every column of a table, as comma-separated text."""
    described = [{"column": name, **VARIABLES[name]._asdict()} for name in columns]
    return pd.DataFrame(described).rename(columns={"long_name": "meaning"}).to_csv(index=False)


def to_csv(table: xr.Dataset, columns: tuple[str, ...] = COLUMNS) -> str:
    """A table of runs as comma-separated text, in the order of the columns."""
    return table.to_dataframe()[list(columns)].to_csv(index=False)
