"""L_s by the theory of the creeping patch beside L_s of simulations: a row for each fault."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr

from ..model.linearised import linearised
from ..model.parameters import Parameters
from ..theory.closed_forms import bimaterial_contrast
from ..theory.creep.front import advance, first_growing, oscillating
from ..theory.creep.lengths import NoPatch, Patches, stability_point
from ..theory.creep.thin import thin_limit

COLUMNS = (
    "id", "study", "law", "friction_law", "height", "zeta_over_a", "f_beta", "theory_length",
    "stability_length", "creep_length", "front_length", "front_frequency", "front_time",
)  # fmt: skip
"""``stability_length`` is that of the simulations, a mean over what differs in noise and mesh."""

CURVE = np.geomspace(0.2, 30.0, 40)  # zeta/a of the thin limit's curve
PROFILES = 4  # faults whose creep is shown: evenly over the contrasts


def gather(runs: Iterable[dict[str, Any]], table: xr.Dataset) -> xr.Dataset:
    """The table, the thin limit's curve and the creep of some faults.

    Parameters
    ----------
    runs : from :meth:`nucleation.configuration.studies.Run.to_dict`.
    table : on ``run``, with ``id``, ``theory_length`` and ``stability_length`` (m) of at least
        these runs; those without a stability length are left out.

    Returns
    -------
    Dataset
        :data:`COLUMNS` on ``run``; ``curve_ratio`` and ``curve_length`` (L_s/L_c) on ``curve``;
        ``shown_beta`` on ``case``, and ``shown_x`` (over L_s), ``shown_rate`` (over V) and
        ``shown_stress`` (over sigma0) on ``case`` and ``place``.
    """
    known = {str(i): n for n, i in enumerate(table["id"].values)}
    faults: dict[Any, list[tuple[dict[str, Any], int]]] = {}
    for run in runs:
        at = known.get(run["id"])
        if at is not None and np.isfinite(table["stability_length"].values[at]):
            own = Parameters.from_dict(run["parameters"])
            faults.setdefault(_fault(own, run["study"]), []).append((run, at))
    rows = []
    for same in faults.values():
        measured = float(np.mean([table["stability_length"].values[at] for _, at in same]))
        rows.append(_row(same[0][0], float(table["theory_length"].values[same[0][1]]), measured))
    data: dict[str, Any] = {n: ("run", [row[n] for row in rows]) for n in COLUMNS}
    data["curve_ratio"] = "curve", CURVE
    data["curve_length"] = "curve", [thin_limit(ratio).length_ratio for ratio in CURVE]
    first = {row["id"]: same[0][0] for row, same in zip(rows, faults.values(), strict=True)}
    return xr.Dataset(data | _profiles(rows, first))


def _fault(parameters: Parameters, study: str) -> Any:
    """What makes runs those of one fault."""
    return study, parameters.friction, parameters.material, parameters.loading, (
        parameters.geometry.height, parameters.second_body,
    )  # fmt: skip


def _row(run: dict[str, Any], critical: float, measured: float) -> dict[str, Any]:
    parameters = Parameters.from_dict(run["parameters"])
    interface, below = linearised(parameters.friction, parameters.loading), parameters.below
    f_beta = 0.0
    if below is not None:
        f_beta = interface.friction * bimaterial_contrast(parameters.material, below.material)
    patches, loading = Patches.of(parameters), parameters.loading
    start = loading.initial_state, loading.initial_shear_stress / loading.normal_stress
    row = {
        "id": run["id"], "study": run["study"], "law": parameters.friction.evolution,
        "friction_law": parameters.friction.law, "height": parameters.geometry.height,
        "zeta_over_a": interface.zeta / interface.a, "f_beta": f_beta, "theory_length": critical,
        "stability_length": measured,
        **dict.fromkeys(("creep_length", "front_length", "front_frequency", "front_time"),
                        math.nan),
    }  # fmt: skip
    try:
        row["creep_length"] = stability_point(Patches(patches.one), critical).length
        row["front_length"] = first_growing(patches, critical, *start)
        made = advance(patches, [row["front_length"]], *start)
        row["front_frequency"] = float(oscillating(made)[0].imag) / parameters.memory_time
        row["front_time"] = float(made.time[0])
    except NoPatch:
        pass
    return row


def _profiles(rows: list[dict[str, Any]], runs: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """The creep of some faults at their L_s, over the range of contrasts."""
    ordered = sorted((row for row in rows if row["front_length"] > 0.0), key=lambda r: r["f_beta"])
    if not ordered:
        return {}
    ordered = list({round(row["f_beta"], 6): row for row in ordered}.values())
    shown = [ordered[i] for i in np.linspace(0, len(ordered) - 1, PROFILES).round().astype(int)]
    shown = list({row["id"]: row for row in shown}.values())
    x, rate, stress = [], [], []
    for row in shown:
        parameters = Parameters.from_dict(runs[row["id"]]["parameters"])
        made = advance(
            Patches.of(parameters), [row["front_length"]], parameters.loading.initial_state
        )
        creep = made.creeps[0]
        x.append(np.cos(creep.response.modes.theta))
        rate.append(creep.slip_rate)
        stress.append(creep.normal_stress)
    return {
        "shown_beta": ("case", [row["f_beta"] for row in shown]),
        "shown_x": (("case", "place"), np.array(x)),
        "shown_rate": (("case", "place"), np.array(rate)),
        "shown_stress": (("case", "place"), np.array(stress)),
    }
