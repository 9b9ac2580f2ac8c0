"""Weakening patches in a strengthening fault: outcomes of simulations, and their bounds.

The largest slip rate depends on the steps: with other tolerances and longest steps it is up to
twice as large or small. So a patch whose slip rate comes near that of an event is undecided.

A fault that is periodic along x creeps at V under a far shear stress that hardly changes. A patch
narrower than W_c keeps creeping. On a wider one the slip rate oscillates in a limit cycle of slow
slip, or the patch has an event: it slips so fast that inertia limits the slip rate,
``2 a sigma0 c_s/mu``, at which the damping ``mu v/(2 c_s)`` by radiation (Rice, 1993) is a sigma0.
"""

import functools
import math
from collections.abc import Iterable

import numpy as np
import pandas as pd
import xarray as xr

from nucleation.datasets.variables import Column, columns, table
from nucleation.model.quantities import ParameterError
from nucleation.run.run import Run
from nucleation.simulation.event import Outcome
from nucleation.theory.critical import largest_crossings
from nucleation.theory.evaluation import single_system
from nucleation.theory.weakening_patch import WeakeningPatch, smallest_width

from . import columns as col
from .rows import Row

UNSTEADY = 2.0  # largest slip rate over V below which a patch creeps
NEAR = 0.5  # largest slip rate over that of an event from which other steps may make it an event
TALL = 1e5  # m, height of bodies that are half-spaces
NARROW = 20  # wavenumbers of the period in the width of the patch, at least
PRECISION = 1e-3  # relative, of W_c of a period
LARGEST = 1.1  # multiple of W_c of half-spaces up to which that of a period is sought

CREEP = "creep"
SLOW = "slow slip"
EVENT = "event"
UNDECIDED = "undecided"
"""The slip rate came near that of an event, or the run ended by a fall of the force before it."""


VARIES = Column("varies", "", "how the surroundings differ: zeta by another b, or a at the same b")
STRENGTHENING = Column(
    "strengthening", "1", "-zeta of the surroundings over zeta of the patch", "r"
)

COLUMNS = columns(
    col.ID,
    Column("outcome", "", "creep, slow slip, event or undecided"),
    col.PLANE,
    col.VELOCITY,
    col.HEIGHT,
    col.A,
    col.ZETA,
    VARIES,
    Column("outside_a", "1", "direct effect of the surroundings", "a_out"),
    col.ZETA_OVER_A,
    STRENGTHENING,
    col.WIDTH,
    col.CRITICAL_LENGTH,
    Column("smallest_width", "m", "smallest width with a growing mode, by theory", "W_c"),
    Column("width_ratio", "1", "width over the smallest one with a growing mode", "W/W_c"),
    Column(
        "period_ratio",
        "1",
        "width over the smallest one with a growing mode in the period",
        "W/W_c,P",
    ),
    Column("fastest", "1", "largest slip rate over V"),
    Column("dynamic_rate", "1", "least slip rate of an event over V", "2 a sigma0 c_s/(mu V)"),
    col.N_X,
    Column("elements", "1", "elements in half of L_b"),
    Column("period", "1", "period of the fault over the width of the patch"),
    col.TOLERANCE,
    col.LONGEST_STEP,
)

BOUNDS = columns(
    VARIES,
    col.ZETA_OVER_A,
    STRENGTHENING,
    Column("slow_slip_up_to", "1", "W/W_c below which no patch had an event"),
    Column("events_from", "1", "W/W_c above which all patches had an event"),
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
    if dropped or fastest >= NEAR * dynamic_rate:
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
        "period_ratio": width / (smallest * _raised(run, patch, smallest)),
        "dynamic_rate": 2.0 * strength * run.upper.material.shear_wave_speed / fault.velocity,
        "n_x": block.n_x,
        "elements": zone * block.n_x / block.length,
        "period": block.length / width,
        "tolerance": run.stepping.tolerance,
        "longest_step": run.longest_step / run.memory_time,
    }


def _raised(run: Run, patch: WeakeningPatch, smallest: float) -> float:
    """W_c of the study's period and heights over that of half-spaces (m)."""
    fault, inside = run.fault, patch.inside
    a = float(inside.a[0])
    # in units of mu* D/(a sigma0), with mu* = mu or mu/(1 - nu)
    modulus = fault.shear_modulus / (1.0 - run.upper.material.in_plane_ratio)
    unit = modulus * run.law.slip_distance / (a * fault.normal_stress)
    zeta, outside_zeta = float(inside.zeta[0]) / a, float(patch.outside.zeta[0]) / a
    outside_a = float(patch.outside.a[0]) / a
    numbers = smallest / unit, run.block.length / unit, zeta, outside_a, outside_zeta
    return _raised_by_period(*(float(f"{number:.9g}") for number in numbers))


@functools.cache
def _raised_by_period(
    width: float, period: float, zeta: float, outside_a: float, outside_zeta: float
) -> float:
    """W_c of a period over `width`, that of half-spaces; as :func:`period_growth`."""

    def grows(factor: float) -> bool:
        return period_growth(factor * width, period, zeta, outside_a, outside_zeta) > 0.0

    low, high = 1.0 / LARGEST, LARGEST
    while high > low + PRECISION:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if grows(middle) else (middle, high)
    return 0.5 * (low + high)


def period_growth(
    width: float, period: float, zeta: float, outside_a: float, outside_zeta: float
) -> float:
    """Largest growth rate over V/D of a patch in a period, between layers half a period high.

    Lengths are in units of ``mu* D/(a sigma0)``, and a, zeta in units of the patch's a. By the even
    Fourier modes of slip: the first mode to grow is even. Uniform slip, which is neutral, is not
    counted. With K of elasticity and ``s = Lambda D/V`` the equation of
    :mod:`nucleation.theory.weakening_patch`, times 1 + s, is ``s^2 A u + s (K - Z) u + K u = 0``.
    """
    n = np.arange(math.ceil(NARROW * period / width) + 1)
    norms = np.where(n == 0, 1.0, 0.5)
    k = 2.0 * np.pi * n / period
    share = width / period
    apart, sum_ = np.subtract.outer(n, n), np.add.outer(n, n)
    within = 0.5 * share * (np.sinc(apart * share) + np.sinc(sum_ * share))
    scale = 1.0 / np.sqrt(np.outer(norms, norms))
    within = within * scale  # the patch's part of the products of orthonormal modes
    around = np.eye(n.size) - within
    inverse = np.linalg.inv(within + outside_a * around)
    stiffness = np.diag(0.5 * k * np.tanh(0.5 * k * period))
    damping = inverse @ (stiffness - zeta * within - outside_zeta * around)
    nothing = np.zeros_like(stiffness)
    companion = np.block([[nothing, np.eye(n.size)], [-inverse @ stiffness, -damping]])
    rates = np.linalg.eigvals(companion)
    return float(rates[np.abs(rates) > 1e-9].real.max())


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

    The first one is a run's at the largest V, over the W_c of the period; the second one a run's at
    the least V over that of half-spaces, which is smaller, infinite if there is none.
    """
    width, velocity = runs["width_ratio"], runs["velocity"]
    no_event = runs["outcome"] != EVENT
    first = width[runs["outcome"].isin([EVENT, UNDECIDED])].min()
    slow = runs["period_ratio"][(velocity == velocity.max()) & ~(width >= first)]
    last = width[no_event].max()
    events = width[(velocity == velocity.min()) & ~(width <= last)]
    return max([1.0, *slow]), min(events, default=np.inf)
