"""L_s by the theory of the creeping patch beside L_s of simulations: a row for each fault."""

import contextlib
import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import xarray as xr

from nucleation.datasets.variables import Column, columns, table
from nucleation.extraction import definitions
from nucleation.run.derived import fault
from nucleation.run.run import Run
from nucleation.theory.creep.front import first_growing
from nucleation.theory.creep.lengths import stability_point
from nucleation.theory.status import NoLength

from . import columns as col
from .curves import f_beta
from .lengths import description
from .rows import Row

COLUMNS = columns(
    col.ID,
    col.STUDY,
    col.ROLE,
    col.EVOLUTION,
    col.FRICTION_LAW,
    col.HEIGHT,
    col.ZETA_OVER_A,
    col.F_BETA,
    col.CRITICAL_LENGTH,
    definitions.STABILITY_LENGTH,
    Column("creep_length", "m", "L_s by theory with constant a and b", "L_s"),
    col.FRONT_LENGTH,
    col.FAULT,
)
"""``stability_length`` is that of the simulations, a mean over runs with other noise or mesh."""


def theory_table(runs: Iterable[Row], tables: Iterable[xr.Dataset]) -> xr.Dataset:
    """:data:`COLUMNS` of each fault whose L_s is known from simulations."""
    known: dict[str, float] = {}
    for measured in tables:
        known |= measured.set_index(run="id")["stability_length"].to_series().to_dict()
    faults: dict[tuple[str, str], list[Row]] = {}
    for run in runs:
        if math.isfinite(known.get(run["id"], math.nan)):
            key = run["study"], fault(Run.from_dict(run["parameters"]))
            faults.setdefault(key, []).append(run)
    rows = []
    for own in faults.values():
        mean = float(np.mean([known[run["id"]] for run in own]))
        rows.append(_row(own[0]) | {"stability_length": mean})
    return table(rows, COLUMNS)


def _row(run: Row) -> Row:
    """The columns of one fault by theory, from its first run."""
    parameters = Run.from_dict(run["parameters"])
    own, patches = parameters.fault, parameters.patches
    critical = run["critical_length"]
    row = description(run) | {
        "zeta_over_a": own.zeta / own.a,
        "f_beta": f_beta(parameters),
        "creep_length": math.nan,
        "front_length": math.nan,
    }
    stress = parameters.start.initial_shear_stress / own.normal_stress
    with contextlib.suppress(NoLength):
        row["creep_length"] = stability_point(replace(patches, law=None), critical)[0]
        row["front_length"] = first_growing(patches, critical, own.initial_state, stress)
    return row
