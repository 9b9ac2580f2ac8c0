"""Weakening patches in a strengthening fault: outcomes of simulations, and their bounds.

A fault that is periodic along x creeps at V under a far shear stress that hardly changes. A patch
narrower than W_c keeps creeping. On a wider one the slip rate oscillates in a limit cycle of slow
slip, or the patch has an event: it slips so fast that inertia limits the slip rate,
``2 a sigma0 c_s/mu``, at which the damping ``mu v/(2 c_s)`` by radiation (Rice, 1993) is a sigma0.
"""

from collections.abc import Iterable

import numpy as np
import pandas as pd
import xarray as xr

from nucleation.datasets.variables import declared, table
from nucleation.model.quantities import ParameterError
from nucleation.run.run import Run
from nucleation.simulation.event import Outcome
from nucleation.theory.critical import largest_crossings
from nucleation.theory.evaluation import single_system
from nucleation.theory.weakening_patch import WeakeningPatch, smallest_width

from .curves import CURVES
from .rows import SHARED, Row

UNSTEADY = 2.0  # largest slip rate over V below which a patch creeps
TALL = 1e5  # m, height of bodies that are half-spaces
PERIOD = 1.03  # by which the study's periods and heights raise W_c of half-spaces at most

CREEP = "creep"
SLOW = "slow slip"
EVENT = "event"
UNDECIDED = "undecided"  # the run ended by a fall of the force before the rate of an event


COLUMNS = declared(
    """
    id
    outcome | | creep, slow slip, event or undecided
    plane velocity height a zeta
    varies | | how the surroundings differ: zeta by another b, or a at the same b
    outside_a | 1 | direct effect of the surroundings | a_out
    zeta_over_a
    strengthening | 1 | -zeta of the surroundings over zeta of the patch | r
    width critical_length
    smallest_width | m | smallest width with a growing mode, by theory | W_c
    width_ratio | 1 | width over the smallest one with a growing mode | W/W_c
    fastest | 1 | largest slip rate over V
    dynamic_rate | 1 | least slip rate of an event over V | 2 a sigma0 c_s/(mu V)
    n_x
    elements | 1 | elements in half of L_b
    period | 1 | period of the fault over the width of the patch
    """,
    SHARED | CURVES,
)

BOUNDS = declared(
    """
    varies zeta_over_a strengthening
    slow_slip_up_to | 1 | W/W_c below which no patch had an event
    events_from | 1 | W/W_c above which all patches had an event
    """,
    COLUMNS,
)


def patch_of(run: Run) -> WeakeningPatch:
    """The patch of a run, with the friction law expanded at V."""
    own = run.heterogeneity
    if own.varies not in ("zeta", "a") or own.shape != "step":
        raise ParameterError(
            f"heterogeneity = {own.varies} with shape = {own.shape} is not "
            "allowed with role = weakening_patches: it must be zeta or a with a step"
        )
    outside = single_system(run.fault)
    factor = 1.0 + own.change
    if own.varies == "zeta":
        return WeakeningPatch(outside._replace(zeta=outside.zeta * factor), outside)
    less = outside.a * (1.0 - factor)  # b is the same
    inside = outside._replace(a=outside.a - less, zeta=outside.zeta + less)
    return WeakeningPatch(inside, outside)


def outcome(fastest: float, dynamic_rate: float, dropped: bool = False) -> str:
    """Outcome of a run by its largest slip rate and that of an event, both over V."""
    if fastest >= dynamic_rate:
        return EVENT
    if dropped:
        return UNDECIDED
    return CREEP if fastest < UNSTEADY else SLOW


def weakening_patches_table(runs: Iterable[Row], simulations: Iterable[xr.Dataset]) -> xr.Dataset:
    """Simulated patches beside theory: :data:`COLUMNS` of each run on ``run``."""
    rows = []
    for entry, simulation in zip(runs, simulations, strict=True):
        run = Run.from_dict(entry["parameters"])
        row = {"id": entry["id"], **_of_patch(run)}
        row["fastest"] = float(simulation["maximal_slip_rate"].max()) / run.fault.velocity
        dropped = simulation.attrs.get("status", "").startswith(Outcome.AFTER_EVENT)
        row["outcome"] = outcome(row["fastest"], row["dynamic_rate"], dropped)
        rows.append(row)
    return table(rows, COLUMNS)


def _of_patch(run: Run) -> Row:
    """The columns about one patch and its theory."""
    fault, block = run.fault, run.block
    patch = patch_of(run.replaced(height=TALL))
    a, zeta = float(patch.inside.a[0]), float(patch.inside.zeta[0])
    critical = 2.0 * np.pi / float(largest_crossings(patch.inside)[0])
    smallest = smallest_width(patch, critical)
    width = run.heterogeneity.width
    strength = a * fault.normal_stress / fault.shear_modulus
    zone = 0.5 * critical * zeta / (np.pi * (a + zeta))  # L_b/2 of half-spaces
    return {
        "plane": fault.plane,
        "velocity": fault.velocity,
        "height": fault.height,
        "a": a,
        "zeta": zeta,
        "varies": run.heterogeneity.varies,
        "outside_a": float(patch.outside.a[0]),
        "zeta_over_a": zeta / a,
        "strengthening": -float(patch.outside.zeta[0]) / zeta,
        "width": width,
        "critical_length": critical,
        "smallest_width": smallest,
        "width_ratio": width / smallest,
        "dynamic_rate": 2.0 * strength * run.upper.material.shear_wave_speed / fault.velocity,
        "n_x": block.n_x,
        "elements": zone * block.n_x / block.length,
        "period": block.length / width,
    }


def patch_outcomes_table(patches: xr.Dataset) -> xr.Dataset:
    """Bounds of slow slip and events: :data:`BOUNDS` of each simulated friction on ``run``."""
    frame = patches.to_dataframe()
    keys = [frame["varies"], frame["zeta_over_a"].round(4), frame["strengthening"].round(4)]
    found = []
    for key, own in frame.groupby(keys):
        found.append(dict(zip(BOUNDS, (*key, *bounds_of(own)), strict=True)))
    return table(found, BOUNDS)


def bounds_of(runs: pd.DataFrame) -> tuple[float, float]:
    """W/W_c up to which no run had an event (1 if none is known), and from which all had one.

    The first one is a run's at the largest V, over the W_c of the period, which is larger at most
    by :data:`PERIOD`; the second one a run's at the least V, infinite if there is none.
    """
    width, velocity = runs["width_ratio"], runs["velocity"]
    no_event = runs["outcome"] != EVENT
    first = width[~no_event | (runs["outcome"] == UNDECIDED)].min()
    slow = width[(velocity == velocity.max()) & ~(width >= first)]
    last = width[no_event].max()
    events = width[(velocity == velocity.min()) & ~(width <= last)]
    return max([1.0, *(slow / PERIOD)]), min(events, default=np.inf)
