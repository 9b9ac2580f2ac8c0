"""The table of lengths at the drop: one row for each simulation, SI units."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from nucleation.datasets.variables import Column, DatasetError, Rule, columns, first, rules, table
from nucleation.extraction import definitions
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.extraction import Record, extracted
from nucleation.extraction.measures import MEASURES, measure
from nucleation.fault.parameters import parameters as known_parameters
from nucleation.run.derived import ensemble, fault
from nucleation.run.run import Run
from nucleation.theory.creep.lengths import stability_point
from nucleation.theory.status import UNKNOWN, VALUE, NoLength

from . import columns as col
from .rows import Row, groups

DIAGNOSTICS = columns(col.STATUS, col.STEPS, col.WALL_SECONDS, col.PEAK_MEGABYTES)
"""Attributes of a simulation's dataset that go into the table."""

COLUMNS = columns(
    col.ID,
    col.STUDY,
    col.ROLE,
    col.EVOLUTION,
    col.HEIGHT,
    col.INITIAL_STATE,
    col.N_X,
    col.N_Y,
    definitions.ONSET_TIME,
    definitions.ONSET_TIME_LOW,
    definitions.ONSET_TIME_HIGH,
    definitions.LENGTH,
    definitions.LENGTH_LOW,
    definitions.LENGTH_HIGH,
    col.CRITICAL_LENGTH,
    definitions.STABILITY_LENGTH,
    col.STABILITY_STATUS,
    col.STATUS,
    col.STEPS,
    col.WALL_SECONDS,
    col.PEAK_MEGABYTES,
    col.BLOCK_LENGTH,
    col.GRADING,
    col.TOLERANCE,
    col.LONGEST_STEP,
    Column("density", "kg/m^3", "mass density", "rho", realisations=first),
    col.SLIP_DISTANCE,
    col.VELOCITY,
    col.NORMAL_STRESS,
    col.SHEAR_MODULUS,
    col.POISSON_RATIO,
    col.FRICTION,
    col.A,
    col.ZETA,
    col.FRICTION_LAW,
    col.BELOW,
    Column("initial_stress", "", "static field at the start", realisations=first),
    Column(
        "initial_shear_stress",
        "Pa",
        "shear stress at the start, if it is uniform",
        "tau0",
        realisations=first,
    ),
    col.SIMULATED_TIME,
    col.REACHED_LENGTH,
    col.KIND,
    col.STRENGTH,
    col.SEED,
    col.CORRELATION_LENGTH,
    col.FAR_SIDE,
    col.SECOND_HEIGHT,
    col.SECOND_SHEAR_MODULUS,
    col.SECOND_POISSON_RATIO,
    col.PLANE,
    Column("loading", "", "what loads the fault: edge or remote", realisations=first),
    col.FAULT,
    col.ENSEMBLE,
)
"""Name of the simulation, its measured lengths, its cost, and its parameters."""

_ALL = COLUMNS | MEASURES  # of runs whose interface is recorded
RULES = rules(_ALL)
"""How each column is aggregated over the realisations of one fault."""

_OF_SECOND_BODY = ("far_side", "second_height", "second_shear_modulus", "second_poisson_ratio")

COMPARED = columns(
    col.ID,
    col.STUDY,
    col.ROLE,
    col.EVOLUTION,
    col.HEIGHT,
    col.INITIAL_STATE,
    col.A,
    col.ZETA,
    col.KIND,
    col.STRENGTH,
    col.SEED,
    definitions.ONSET_TIME,
    definitions.ONSET_TIME_LOW,
    definitions.ONSET_TIME_HIGH,
    definitions.LENGTH,
    definitions.LENGTH_LOW,
    definitions.LENGTH_HIGH,
    col.CRITICAL_LENGTH,
    definitions.STABILITY_LENGTH,
    col.STABILITY_STATUS,
    col.STATUS,
    col.SIMULATED_TIME,
    col.REACHED_LENGTH,
)
"""Columns of every CSV file; parameters are there if the runs differ in them."""


def lengths_table(
    runs: Iterable[Row], simulations: Iterable[xr.Dataset], settings: ExtractionSettings
) -> xr.Dataset:
    """Extract the lengths of simulations into a table."""
    by_theory: dict[str, Row] = {}  # by fault
    rows = []
    for run, simulation in zip(runs, simulations, strict=True):
        row = description(run)
        if row["fault"] not in by_theory:
            by_theory[row["fault"]] = stability_of(run)
        record = Record(simulation, settings)
        found = extracted(record)
        reached = record.lengths[-1] if record.onset is None else found["length"]
        row |= by_theory[row["fault"]] | found | measure(record)
        row |= {name: simulation.attrs[name] for name in DIAGNOSTICS}
        row["simulated_time"] = float(simulation["step_time"].values[-1])
        row["reached_length"] = float(reached)
        rows.append(row)
    measured = all(row.keys() >= MEASURES.keys() for row in rows)
    return table(rows, _ALL if measured else COLUMNS)


def stability_of(run: Row) -> Row:
    """L_s (m) of the run's fault and its status (docs/creeping_patch.md).

    Without an edge it is unknown where stress or parameters, not only f, vary along the interface.
    """
    parameters = Run.from_dict(run["parameters"])
    length, status = float("nan"), UNKNOWN
    is_uniform = parameters.heterogeneity.varies in ("none", "friction")
    if parameters.fault.loading == "edge" or is_uniform:
        try:
            length = stability_point(parameters.patches, run["critical_length"])[0]
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
    return groups(table, "study", "ensemble")


def over_realisations(table: xr.Dataset, rules: Mapping[str, Rule] = RULES) -> xr.Dataset:
    """Aggregate a table of lengths to one row for each fault, each column by its rule.

    Onset and length are the means of the realisations, the ends of their ranges are the outermost
    ones; NaN if a realisation has no event. The column ``realisations`` counts them.
    """
    unknown = [str(name) for name in table.data_vars if name not in rules]
    if unknown:
        raise DatasetError(f"columns without a rule for the realisations of one fault: {unknown}")
    faults = realisations(table)
    columns = {}
    for name in map(str, table.data_vars):
        values = table[name].values
        columns[name] = np.array([rules[name](values[rows]) for rows in faults])
    columns["realisations"] = np.array([len(rows) for rows in faults])
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


def description(run: Row) -> Row:
    """The columns with the run's parameters, and the theory's length for them.

    A rigid base has no far side and an infinite modulus.
    """
    parameters = Run.from_dict(run["parameters"])
    values = run["parameters"]
    below = parameters.below
    second = ("none", np.nan, np.inf, np.nan)
    if below is not None:
        material = below.material
        second = (below.far_side, below.height, material.shear_modulus, material.poisson_ratio)
    quiet = values["perturbation"] == "none"
    return {
        **{name: values.get(name) for name in COLUMNS if name in known_parameters()},
        **dict(zip(_OF_SECOND_BODY, second, strict=True)),
        "kind": values["perturbation"],
        "below": values["second_body"],
        **{name: run[name] for name in ("id", "study", "role", "critical_length")},
        **{name: run["theory"][name] for name in ("friction", "a", "zeta")},
        "strength": 0.0 if quiet else values["strength"],
        "fault": fault(parameters),
        "ensemble": ensemble(parameters),
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
        of_run = name in known_parameters() and name not in MEASURES
        is_given = of_run or name in ("kind", "below", "far_side")
        if name in COMPARED or (is_given and frame[name].nunique(dropna=False) > 1):
            names.append(name)
    return {".nc": table, ".csv": frame[names].to_csv(index=False)}


def of_study(
    runs: Iterable[Row], simulations: Iterable[xr.Dataset], settings: ExtractionSettings
) -> dict[str, Any]:
    """:func:`lengths_table` as files."""
    return files(lengths_table(runs, simulations, settings))


def of_batches(tables: Iterable[xr.Dataset], ids: Sequence[str]) -> dict[str, Any]:
    """The table of a study that was run in several batches, in the order of its runs, as files."""
    joined = join(tables)
    places = {name: i for i, name in enumerate(joined["id"].values.tolist())}
    return files(joined.isel(run=[places[name] for name in ids]))


def of_studies(tables: Iterable[xr.Dataset]) -> dict[str, Any]:
    """The table of several studies, and unit and meaning of all its columns."""
    described = [
        {
            "column": name,
            "units": column.units,
            "meaning": column.long_name,
            "symbol": column.symbol,
        }
        for name, column in _ALL.items()
    ]
    meanings = pd.DataFrame(described)
    return {**files(join(tables)), ".columns.csv": meanings.to_csv(index=False)}
