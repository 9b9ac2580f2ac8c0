"""The table of lengths at the drop: one row for each simulation, SI units."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from nucleation.datasets.variables import Variable, some, table
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.extraction import Record, extract
from nucleation.extraction.measures import MEASURED, MEASURES, measure
from nucleation.run.identity import ensemble, fault
from nucleation.run.run import Run
from nucleation.theory.status import UNKNOWN, VALUE, NoLength
from nucleation.types import Array

from .rows import SHARED, Row

_OVER_REALISATIONS: dict[str, Callable[[Array], Any]] = {
    "onset_time": np.mean,
    "onset_time_low": np.min,
    "onset_time_high": np.max,
    "length": np.mean,
    "length_low": np.min,
    "length_high": np.max,
    **dict.fromkeys(MEASURES, np.mean),
}
"""How each number that differs between the realisations of one fault is aggregated."""

DIAGNOSTICS = {
    "status": Variable("", "how the simulation ended"),
    "steps": Variable("1", "number of time steps"),
    "wall_seconds": Variable("s", "wall time of the simulation"),
    "peak_megabytes": Variable("Mbyte", "largest memory of the simulation"),
}
"""Attributes of a simulation's dataset that go into the table."""

COLUMNS = {
    "id": SHARED["id"],
    "study": Variable("", "study of the configuration"),
    "role": Variable("", "what the study is for"),
    "evolution": Variable("", "state evolution law"),
    "height": SHARED["height"],
    "initial_state": Variable("s", "initial state variable", "phi0"),
    **some(SHARED, "n_x n_y"),
    **MEASURED,
    "critical_length": Variable("m", "critical nucleation length", "L_c"),
    "stability_length": Variable("m", "patch length where growth begins", "L_s"),
    "stability_status": Variable("", "value, or why there is none: stable, beyond or unknown"),
    **DIAGNOSTICS,
    "block_length": Variable("m", "length of the block", "L"),
    "grading": Variable("1", "largest over smallest element along y"),
    "tolerance": Variable("1", "tolerance of the local error per step"),
    "longest_step": Variable("1", "longest time step over the memory time D/V"),
    "density": Variable("kg/m^3", "mass density", "rho"),
    **some(SHARED, "slip_distance velocity normal_stress shear_modulus poisson_ratio"),
    **some(SHARED, "friction a zeta"),
    "friction_law": Variable("", "law of the friction coefficient"),
    "below": Variable("", "what the block slides on"),
    "initial_stress": Variable("", "static field at the start"),
    "initial_shear_stress": Variable("Pa", "shear stress at the start, if it is uniform", "tau0"),
    "simulated_time": Variable("s", "time at the end of the run", "t"),
    "reached_length": Variable(
        "m", "patch length at the onset, or at the end of a run without an event", "L(t)"
    ),
    "kind": Variable("", "perturbed quantity"),
    "strength": Variable("1", "relative strength of the declared perturbation", "eps"),
    "seed": Variable("1", "seed of its realisation"),
    "correlation_length": Variable("m", "its correlation length along x"),
    "far_side": SHARED["far_side"],
    **some(SHARED, "second_height second_shear_modulus second_poisson_ratio"),
    "plane": SHARED["plane"],
    "loading": Variable("", "what loads the fault: edge or remote"),
    "fault": Variable("", "digest of all that the fault's physics depends on"),
    "ensemble": Variable("", "digest of all that the run is given but its seed"),
}
"""Name of the simulation, its measured lengths, its cost, and its parameters."""

GIVEN = {
    "evolution": "evolution",
    "height": "height",
    "n_x": "n_x",
    "n_y": "n_y",
    "grading": "grading",
    "tolerance": "tolerance",
    "longest_step": "longest_step",
    "density": "density",
    "shear_modulus": "shear_modulus",
    "poisson_ratio": "poisson_ratio",
    "plane": "plane",
    "velocity": "velocity",
    "initial_stress": "initial_stress",
    "initial_shear_stress": "initial_shear_stress",
    "kind": "perturbation",
    "seed": "seed",
    "correlation_length": "correlation_length",
    "initial_state": "initial_state",
    "loading": "loading",
    "normal_stress": "normal_stress",
    "block_length": "block_length",
    "slip_distance": "slip_distance",
    "friction_law": "friction_law",
    "below": "second_body",
}
"""Columns that are a parameter, and its name."""


COMPARED = (
    *("id", "study", "role", "evolution", "height", "initial_state", "a", "zeta"),
    *("kind", "strength", "seed"),
    *("onset_time", "onset_time_low", "onset_time_high", "length", "length_low", "length_high"),
    *("critical_length", "stability_length", "stability_status"),
    *("status", "simulated_time", "reached_length"),
)
"""Columns of every CSV file."""

PARAMETERS = (
    *GIVEN,
    *("friction", "far_side", "second_height", "second_shear_modulus", "second_poisson_ratio"),
)
"""Columns of a CSV file whose runs differ in them."""


def lengths_table(
    runs: Iterable[Row], simulations: Iterable[xr.Dataset], settings: ExtractionSettings
) -> xr.Dataset:
    """Extract the lengths of simulations into a table."""
    by_theory: dict[str, Row] = {}  # by fault
    rows = []
    for run, simulation in zip(runs, simulations, strict=True):
        row = _row(run, simulation, settings)
        own_fault = row["fault"]
        if own_fault not in by_theory:
            by_theory[own_fault] = _stability(run)
        rows.append(row | by_theory[own_fault])
    measured = all(row.keys() >= MEASURES.keys() for row in rows)
    return table(rows, COLUMNS | MEASURES if measured else COLUMNS)


def _stability(run: Row) -> Row:
    """L_s (m) of the run's fault and its status (docs/creeping_patch.md).

    Without an edge it is unknown where stress or parameters, not only f, vary along the interface.
    """
    from nucleation.theory.creep.lengths import stability_point

    parameters = Run.from_dict(run["parameters"])
    length, status = float("nan"), UNKNOWN
    is_uniform = parameters.heterogeneity.varies in ("none", "friction")
    if parameters.fault.loading == "edge" or is_uniform:
        try:
            length = stability_point(parameters.patches, run["critical_length"]).length
            status = VALUE
        except NoLength as none:
            status = none.status
    return {"stability_length": length, "stability_status": status}


def join(tables: Iterable[xr.Dataset]) -> xr.Dataset:
    """One table of the rows of several."""
    joined = xr.concat(list(tables), dim="run", combine_attrs="override")
    return joined.drop_attrs(deep=False)


def realisations(table: xr.Dataset) -> list[list[int]]:
    """The rows of each run of a study in a table of lengths, which differ in the seed alone."""
    studies = table["study"].values.tolist()
    ensembles = table["ensemble"].values.tolist()
    rows: dict[tuple[str, str], list[int]] = {}
    for i, key in enumerate(zip(studies, ensembles, strict=True)):
        rows.setdefault(key, []).append(i)
    return list(rows.values())


def over_realisations(table: xr.Dataset) -> xr.Dataset:
    """Aggregate a table of lengths to one row for each fault.

    Onset and length are the means of the realisations, the ends of their ranges are the outermost
    ones; NaN if a realisation has no event. All other columns are those of the first realisation.
    The column ``realisations`` counts them.
    """
    faults = realisations(table)
    columns = {}
    for column in table.data_vars:
        name = str(column)
        values = table[name].values
        aggregate = _OVER_REALISATIONS.get(name, _first)
        columns[name] = np.array([aggregate(values[rows]) for rows in faults])
    columns["realisations"] = np.array([len(rows) for rows in faults])
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


def _first(values: Array) -> Any:
    return values[0]


def description(run: Row) -> Row:
    """The columns with the run's parameters, and the theory's length for them."""
    parameters = Run.from_dict(run["parameters"])
    values = run["parameters"]
    theory = run["theory"]
    quiet = values["perturbation"] == "none"
    return {
        **{name: values[parameter] for name, parameter in GIVEN.items()},
        **second_body(parameters),
        "strength": 0.0 if quiet else values["strength"],
        "fault": fault(parameters),
        "ensemble": ensemble(parameters),
        "id": run["id"],
        "study": run["study"],
        "role": run["role"],
        "critical_length": run["critical_length"],
        "friction": theory["friction"],
        "a": theory["a"],
        "zeta": theory["zeta"],
    }


def second_body(parameters: Run) -> Row:
    """The columns of the second body: a rigid base has no far side and an infinite modulus."""
    below = parameters.below
    if below is None:
        return {
            "far_side": "none",
            "second_height": np.nan,
            "second_shear_modulus": np.inf,
            "second_poisson_ratio": np.nan,
        }
    return {
        "far_side": below.far_side,
        "second_height": below.height,
        "second_shear_modulus": below.material.shear_modulus,
        "second_poisson_ratio": below.material.poisson_ratio,
    }


def _row(run: Row, simulation: xr.Dataset, settings: ExtractionSettings) -> Row:
    """A row of the table, without the theory's L_s."""
    record = Record(simulation, settings)
    measured = extract(simulation, settings)
    reached = record.lengths[-1] if record.onset is None else measured["length"]
    return {
        **description(run),
        **measured,
        **measure(record),
        **{name: simulation.attrs[name] for name in DIAGNOSTICS},
        "simulated_time": float(simulation["step_time"].values[-1]),
        "reached_length": float(reached),
    }


def row(table: xr.Dataset, id: str) -> xr.Dataset:
    """The row of one simulation."""
    (index,) = np.flatnonzero(table["id"].values == id)
    return table.isel(run=int(index))


def files(table: xr.Dataset) -> dict[str, Any]:
    """A table as netCDF, and as CSV what people compare: results, and parameters that vary."""
    frame = table.to_dataframe()
    names = []
    for name in map(str, table.data_vars):
        varies = name in PARAMETERS and frame[name].nunique(dropna=False) > 1
        if name in COMPARED or varies:
            names.append(name)
    return {".nc": table, ".csv": frame[names].to_csv(index=False)}


def of_study(
    runs: Iterable[Row], simulations: Iterable[xr.Dataset], settings: ExtractionSettings
) -> dict[str, Any]:
    """:func:`lengths_table` as files."""
    return files(lengths_table(runs, simulations, settings))


def of_studies(tables: Iterable[xr.Dataset]) -> dict[str, Any]:
    """The table of several studies, and unit and meaning of all its columns."""
    columns = COLUMNS | MEASURES
    described = [{"column": name, **column._asdict()} for name, column in columns.items()]
    meanings = pd.DataFrame(described).rename(columns={"long_name": "meaning"})
    return {**files(join(tables)), ".columns.csv": meanings.to_csv(index=False)}
