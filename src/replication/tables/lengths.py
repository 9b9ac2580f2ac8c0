"""The table of lengths at the drop: one row for each simulation, SI units."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from nucleation.datasets.variables import declared, table
from nucleation.extraction.definitions import MEASURED, ExtractionSettings
from nucleation.extraction.extraction import Record, extracted
from nucleation.extraction.measures import MEASURES, measure
from nucleation.fault.parameters import parameters as known_parameters
from nucleation.run.derived import ensemble, fault
from nucleation.run.run import Run
from nucleation.theory.status import UNKNOWN, VALUE, NoLength
from nucleation.types import Array

from .rows import SHARED, Row, groups

_OVER_REALISATIONS: dict[str, Callable[[Array], Any]] = {
    "onset_time": np.mean,
    "onset_time_low": np.min,
    "onset_time_high": np.max,
    "length": np.mean,
    "length_low": np.min,
    "length_high": np.max,
    "length_ratio": np.mean,
    "length_ratio_low": np.min,
    "length_ratio_high": np.max,
    **dict.fromkeys(MEASURES, np.mean),
}
"""How each number that differs between the realisations of one fault is aggregated."""

DIAGNOSTICS = declared("""
    status | | how the simulation ended
    steps | 1 | number of time steps
    wall_seconds | s | wall time of the simulation
    peak_megabytes | Mbyte | largest memory of the simulation
""")
"""Attributes of a simulation's dataset that go into the table."""

COLUMNS = declared(
    """
    id
    study | | study of the configuration
    role | | what the study is for
    evolution | | state evolution law
    height
    initial_state | s | initial state variable | phi0
    n_x n_y onset_time onset_time_low onset_time_high length length_low length_high
    critical_length | m | critical nucleation length | L_c
    stability_length | m | patch length where growth begins | L_s
    stability_status | | value, or why there is none: stable, beyond or unknown
    status steps wall_seconds peak_megabytes
    block_length | m | length of the block | L
    grading | 1 | largest over smallest element along y
    tolerance | 1 | tolerance of the local error per step
    longest_step | 1 | longest time step over the memory time D/V
    density | kg/m^3 | mass density | rho
    slip_distance velocity normal_stress shear_modulus poisson_ratio friction a zeta
    friction_law | | law of the friction coefficient
    below | | what the block slides on
    initial_stress | | static field at the start
    initial_shear_stress | Pa | shear stress at the start, if it is uniform | tau0
    simulated_time | s | time at the end of the run | t
    reached_length | m | patch length at the onset, or at the end of a run without an event | L(t)
    kind | | perturbed quantity
    strength | 1 | relative strength of the declared perturbation | eps
    seed | 1 | seed of its realisation
    correlation_length | m | its correlation length along x
    far_side second_height second_shear_modulus second_poisson_ratio plane
    loading | | what loads the fault: edge or remote
    fault | | digest of all that the fault's physics depends on
    ensemble | | digest of all that the run is given but its seed
    """,
    SHARED | MEASURED | DIAGNOSTICS,
)
"""Name of the simulation, its measured lengths, its cost, and its parameters."""

_OF_SECOND_BODY = ("far_side", "second_height", "second_shear_modulus", "second_poisson_ratio")

COMPARED = declared(
    "id study role evolution height initial_state a zeta kind strength seed onset_time "
    "onset_time_low onset_time_high length length_low length_high critical_length "
    "stability_length stability_status status simulated_time reached_length",
    COLUMNS,
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
    return table(rows, COLUMNS | MEASURES if measured else COLUMNS)


def stability_of(run: Row) -> Row:
    """L_s (m) of the run's fault and its status (docs/creeping_patch.md).

    Without an edge it is unknown where stress or parameters, not only f, vary along the interface.
    """
    from nucleation.theory.creep.lengths import stability_point

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
        aggregate = _OVER_REALISATIONS.get(name, lambda values: values[0])
        columns[name] = np.array([aggregate(values[rows]) for rows in faults])
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
    columns = COLUMNS | MEASURES
    described = [{"column": name, **column._asdict()} for name, column in columns.items()]
    meanings = pd.DataFrame(described).rename(columns={"long_name": "meaning"})
    return {**files(join(tables)), ".columns.csv": meanings.to_csv(index=False)}
