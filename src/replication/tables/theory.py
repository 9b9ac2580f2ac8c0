"""L_s by the theory of the creeping patch beside L_s of simulations: a row for each fault."""

import contextlib
import math
from collections.abc import Iterable
from dataclasses import replace
from operator import itemgetter
from typing import Any

import numpy as np
import xarray as xr
from scipy.interpolate import CubicSpline

from nucleation.datasets.variables import annotate, declared, table, to_csv
from nucleation.extraction.growth import FITTED
from nucleation.run.derived import fault
from nucleation.run.run import Run
from nucleation.theory.closed_forms import bimaterial_contrast, thin_limit
from nucleation.theory.creep.front import advance, first_growing
from nucleation.theory.creep.lengths import stability_point
from nucleation.theory.status import NoLength

from .lengths import COLUMNS as LENGTHS
from .lengths import description
from .rows import SHARED, Row

COLUMNS = declared(
    """
    id study role evolution friction_law height zeta_over_a f_beta critical_length
    stability_length
    creep_length | m | L_s by theory with constant a and b | L_s
    front_length | m | L_s by theory, with the advancing front | L_s
    fault
    """,
    LENGTHS | SHARED | FITTED,
)
"""``stability_length`` is that of the simulations, a mean over runs with other noise or mesh."""

DRAWN = declared("""
    curve_ratio | 1 | weakening over direct effect | zeta/a
    curve_stability | 1 | L_s over L_c | L_s/L_c
    shown_beta | 1 | friction times bimaterial contrast | f beta
    shown_x | 1 | distance from the edge over L_s | x/L_s
    shown_rate | 1 | slip rate of the creep over V | v/V
    shown_stress | 1 | compression over the applied one | sigma/sigma0
""")
"""The thin limit's curve, and the creep of some faults at their L_s."""

CURVE = np.geomspace(0.2, 30.0, 40)  # zeta/a of the thin limit's curve
PLACES = 241  # along a patch, in its angle
_SHOWN_MODES = 256  # with fewer, curves have kinks near a pushed edge under strong contrast
PROFILES = 4  # number of faults with their creep: evenly over the contrasts


def theory_files(runs: Iterable[Row], tables: Iterable[xr.Dataset]) -> dict[str, Any]:
    """The table, the thin limit's curve and the creep of some faults; the table also as CSV."""
    known: dict[str, float] = {}
    for measured in tables:
        lengths = measured["stability_length"].values.tolist()
        known |= dict(
            zip(
                measured["id"].values.tolist(),
                lengths,
                strict=True,
            )
        )
    faults: dict[tuple[str, str], list[Row]] = {}
    for run in runs:
        if math.isfinite(known.get(run["id"], math.nan)):
            key = run["study"], fault(Run.from_dict(run["parameters"]))
            faults.setdefault(key, []).append(run)
    rows = []
    for own in faults.values():
        mean = float(np.mean([known[run["id"]] for run in own]))
        rows.append(_row(own[0]) | {"stability_length": mean})
    firsts = {own[0]["id"]: own[0] for own in faults.values()}
    drawn = xr.Dataset(
        {
            "curve_ratio": ("curve", CURVE),
            "curve_stability": ("curve", [thin_limit(ratio).length_ratio for ratio in CURVE]),
            **_profiles(rows, firsts),
        }
    )
    listed = table(rows, COLUMNS)
    return {
        ".nc": annotate(
            listed.merge(drawn),
            DRAWN,
        ),
        ".csv": to_csv(listed),
    }


def _row(run: Row) -> Row:
    """The columns of one fault by theory, from its first run."""
    parameters = Run.from_dict(run["parameters"])
    own, below, patches = parameters.fault, parameters.below, parameters.patches
    critical = run["critical_length"]
    row = description(run) | {
        "zeta_over_a": own.zeta / own.a,
        "f_beta": 0.0,
        "creep_length": math.nan,
        "front_length": math.nan,
    }
    if below is not None:
        contrast = bimaterial_contrast(parameters.upper.material, below.material)
        row["f_beta"] = own.friction * contrast
    stress = parameters.start.initial_shear_stress / own.normal_stress
    with contextlib.suppress(NoLength):
        row["creep_length"] = stability_point(replace(patches, law=None), critical).length
        row["front_length"] = first_growing(
            patches,
            critical,
            own.initial_state,
            stress,
        )
    return row


def _profiles(rows: list[Row], runs: dict[str, Row]) -> Row:
    """The creep of up to :data:`PROFILES` faults at their L_s, evenly over the contrasts."""
    known = sorted((row for row in rows if row["front_length"] > 0.0), key=itemgetter("f_beta"))
    if not known:
        return {}
    different = list(
        {
            round(
                row["f_beta"],
                6,
            ): row
            for row in known
        }.values()
    )
    evenly = (
        np.linspace(
            0,
            len(different) - 1,
            PROFILES,
        )
        .round()
        .astype(int)
    )
    found = []
    for i in dict.fromkeys(evenly.tolist()):
        row = different[i]
        parameters = Run.from_dict(runs[row["id"]]["parameters"])
        start = parameters.fault.initial_state
        made = advance(
            parameters.patches,
            [row["front_length"]],
            start,
            number=_SHOWN_MODES,
        )
        (creep,) = made.creeps
        theta = creep.response.modes.theta
        angles = np.linspace(
            theta[0],
            theta[-1],
            PLACES,
        )
        rate, stress = (
            CubicSpline(theta, values)(angles) for values in (creep.slip_rate, creep.normal_stress)
        )
        found.append((row["f_beta"], np.cos(angles), rate, stress))
    names = ("shown_beta", "shown_x", "shown_rate", "shown_stress")
    columns = dict(
        zip(
            names,
            map(np.array, zip(*found, strict=True)),
            strict=True,
        )
    )
    return {name: (("case", "place")[: own.ndim], own) for name, own in columns.items()}
