"""The table of critical lengths: one row for each simulation, SI units."""

import dataclasses
from collections.abc import Callable, Iterable
from operator import itemgetter
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from ..datasets.shared import SHARED
from ..datasets.variables import Variable, some
from ..datasets.variables import table as table_of
from ..model.identity import ensemble, fault
from ..model.parameters import Parameters
from ..types import Array
from .definitions import ExtractionSettings
from .extraction import MEASURED, extract
from .measures import MEASURES, measure
from .record import Record

OVER_REALISATIONS: dict[str, Callable[[Array], Any]] = {
    "onset_time": np.mean, "onset_time_low": np.min, "onset_time_high": np.max,
    "length": np.mean, "length_low": np.min, "length_high": np.max,
    **dict.fromkeys(MEASURES, np.mean),
}  # fmt: skip
"""What the realisations of one fault have in common: of each number that differs."""

DIAGNOSTICS = {
    "status": Variable("", "how the simulation ended"),
    "steps": Variable("1", "number of time steps"),
    "wall_seconds": Variable("s", "wall time of the simulation"),
    "peak_megabytes": Variable("Mbyte", "largest memory of the simulation"),
}
"""Attributes of a simulation's dataset that go into the table."""

SECOND_BODY = some(SHARED, "second_height", "second_shear_modulus", "second_poisson_ratio")

COLUMNS = {
    "id": SHARED["id"],
    "study": Variable("", "study of the configuration"),
    "role": Variable("", "what the study is for"),
    "evolution": Variable("", "state evolution law"),
    "height": SHARED["height"],
    "phi0": Variable("s", "initial state variable", "phi0"),
    **some(SHARED, "n_x", "n_y"),
    **MEASURED,
    "theory_length": Variable("m", "critical nucleation length of the linear theory", "L_c"),
    "creep_length": Variable("m", "patch length at which growth begins, by theory", "L_s"),
    **DIAGNOSTICS,
    "block_length": Variable("m", "length of the block", "L"),
    "grading": Variable("1", "largest over smallest element along y"),
    "tolerance": Variable("1", "tolerance of the local error per step"),
    "longest_step": Variable("1", "longest time step over the memory time D/V"),
    "density": Variable("kg/m^3", "mass density", "rho"),
    **some(SHARED, "slip_distance", "velocity", "applied_stress", "shear_modulus", "poisson_ratio"),
    "friction_coefficient": Variable("1", "friction coefficient of the theory's interface", "f"),
    **some(SHARED, "direct_effect", "velocity_weakening"),
    "friction_law": Variable("", "law of the friction coefficient"),
    "below": Variable("", "what the block slides on"),
    "initial_stress": Variable("", "static field at the start"),
    "initial_shear_stress": Variable("Pa", "shear stress at the start, if it is uniform", "tau0"),
    "simulated_time": Variable("s", "time at the end of the run", "t"),
    "reached_length": Variable(
        "m", "patch length at the onset, or at the end of a run without an event", "L(t)"
    ),
    "kind": Variable("", "what is perturbed"),
    "strength": Variable("1", "relative strength of the declared perturbation", "eps"),
    "seed": Variable("1", "seed of its realisation"),
    "correlation_length": Variable("m", "its correlation length along x"),
    "far_side": SHARED["far_side"],
    **SECOND_BODY,
    "plane": SHARED["plane"],
    "loading": Variable("", "what loads the fault: edge, top or remote"),
    "fault": Variable("", "digest of all that the fault's physics depends on"),
    "ensemble": Variable("", "digest of all that the run is given but its seed"),
}
"""Which simulation a row is about, what was measured, what it cost, and what it was given."""


_SAME = (
    "friction.evolution", "geometry.height", "mesh.n_x", "mesh.n_y", "mesh.grading",
    "stepping.tolerance", "stepping.longest_step", "material.density", "material.shear_modulus",
    "material.poisson_ratio", "material.plane", "loading.velocity", "loading.initial_stress",
    "loading.initial_shear_stress", "perturbation.kind", "perturbation.seed",
    "perturbation.correlation_length",
)  # fmt: skip
GIVEN = {parameter.partition(".")[2]: parameter for parameter in _SAME} | {
    "phi0": "loading.initial_state",
    "loading": "loading.kind",
    "applied_stress": "loading.normal_stress",
    "block_length": "geometry.length",
    "slip_distance": "friction.characteristic_slip_distance",
    "friction_law": "friction.law",
    "below": "second_body.kind",
}
"""Columns that are a parameter, by its full name."""


def gather(
    runs: Iterable[dict[str, Any]], simulations: Iterable[xr.Dataset], settings: ExtractionSettings
) -> xr.Dataset:
    """:data:`COLUMNS` on ``run``, with what is extracted from simulations.

    And :data:`.MEASURES`, if all runs are loaded at their edge and record the interface.

    Parameters
    ----------
    runs : from :meth:`nucleation.configuration.runs.Run.to_dict`.
    simulations : of the runs, in the same order.
    settings : how lengths are read.
    """
    by_theory: dict[str, float] = {}
    rows = []
    for run, simulation in zip(runs, simulations, strict=True):
        rows.append(row := _row(run, simulation, settings))
        if row["fault"] not in by_theory:
            by_theory[row["fault"]] = _creep_length(run)
        row["creep_length"] = by_theory[row["fault"]]
    everywhere = all(row.keys() >= MEASURES.keys() for row in rows)
    return table_of(rows, COLUMNS | MEASURES if everywhere else COLUMNS)


def _creep_length(run: dict[str, Any]) -> float:
    """L_s of steady creep with constant a and b (docs/creeping_patch.md); NaN if there is none.

    Without an edge, also NaN where what varies along the interface is more than its strength.
    """
    from ..theory.creep.lengths import NoPatch, Patches, stability_point  # with SciPy, takes long

    parameters = Parameters.from_dict(run["parameters"])
    if parameters.loading.kind != "edge" and parameters.heterogeneity.varies not in ("none", "f"):
        return float("nan")
    try:
        patches = dataclasses.replace(Patches.of(parameters), law=None)
        return stability_point(patches, run["theory_length"]).length
    except NoPatch:
        return float("nan")


def join(tables: Iterable[xr.Dataset]) -> xr.Dataset:
    """One table of the rows of several."""
    joined = xr.concat(list(tables), dim="run", combine_attrs="override")
    return joined.drop_attrs(deep=False)


def realisations(table: xr.Dataset) -> list[list[int]]:
    """The rows of each run of a study in a table of lengths, which differ in the seed alone."""
    runs: dict[tuple[str, str], list[int]] = {}
    keys = zip(table["study"].values.tolist(), table["ensemble"].values.tolist(), strict=True)
    for i, key in enumerate(keys):
        runs.setdefault(key, []).append(i)
    return list(runs.values())


def over_realisations(table: xr.Dataset) -> xr.Dataset:
    """A table of lengths with one row for each fault, the mean of its realisations.

    The row has their mean onset and length, the outermost ends of their ranges, and everything else
    of the first of them; ``realisations`` counts them. NaN if one of them has no event.
    """
    faults = realisations(table)
    columns = {}
    for name in map(str, table.data_vars):
        of_all, values = OVER_REALISATIONS.get(name, itemgetter(0)), table[name].values
        columns[name] = np.array([of_all(values[rows]) for rows in faults])
    columns["realisations"] = np.array([len(rows) for rows in faults])
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


def description(run: dict[str, Any]) -> dict[str, Any]:
    """The columns that say what a run was given, and the theory's length for it."""
    parameters, interface = Parameters.from_dict(run["parameters"]), run["interface"]
    values = parameters.named()
    quiet = values["perturbation.kind"] == "none"
    return {
        **{name: values[parameter] for name, parameter in GIVEN.items()},
        **second_body(parameters),
        "strength": 0.0 if quiet else values["perturbation.strength"],
        "fault": fault(parameters),
        "ensemble": ensemble(parameters),
        **{name: run[name] for name in ("id", "study", "role", "theory_length")},
        "friction_coefficient": interface["friction"],
        "direct_effect": interface["a"],
        "velocity_weakening": interface["zeta"],
    }


def second_body(parameters: Parameters) -> dict[str, Any]:
    """The columns on what lies below: a rigid base has no far side and an infinite modulus."""
    below = parameters.below
    if below is None:
        values = {"far_side": "none", **dict.fromkeys(SECOND_BODY, np.nan)}
        return values | {"second_shear_modulus": np.inf}
    return {
        "far_side": below.bottom,
        "second_height": below.geometry.height,
        "second_shear_modulus": below.material.shear_modulus,
        "second_poisson_ratio": below.material.poisson_ratio,
    }


def _row(
    run: dict[str, Any], simulation: xr.Dataset, settings: ExtractionSettings
) -> dict[str, Any]:
    measured, record = extract(simulation, settings), Record(simulation, settings)
    reached = record.lengths[-1] if record.onset is None else measured["length"]
    measured |= measure(record)
    return {
        **description(run),
        **measured,
        **{name: simulation.attrs[name] for name in DIAGNOSTICS},
        "simulated_time": float(simulation["step_time"].values[-1]),
        "reached_length": float(reached),
    }


def row(table: xr.Dataset, identifier: str) -> xr.Dataset:
    """The row of one simulation, by its id."""
    (index,) = np.flatnonzero(table["id"].values == identifier)
    return table.isel(run=int(index))


def columns_csv() -> str:
    """Unit and meaning of every column of the table, as comma-separated text."""
    columns = COLUMNS | MEASURES
    described = [{"column": name, **column._asdict()} for name, column in columns.items()]
    return pd.DataFrame(described).rename(columns={"long_name": "meaning"}).to_csv(index=False)


def of_studies(tables: Iterable[xr.Dataset]) -> dict[str, Any]:
    """The table of several studies, and what the columns are."""
    return {".nc": join(tables), ".columns.csv": columns_csv()}
