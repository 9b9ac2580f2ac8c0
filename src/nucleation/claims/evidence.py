"""What the claims stand on: the workflow's datasets, each asked for by what it is about."""

import dataclasses
import math
from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..analysis.definitions import ExtractionSettings
from ..analysis.lengths import over_realisations, realisations
from ..analysis.record import Record
from ..configuration.roles import JUDGED, PAPERS
from ..model.friction.law import Friction
from ..model.identity import fault
from ..model.linearised import InterfaceState
from ..model.material import Material
from ..model.parameters import Geometry, Loading, Parameters
from ..types import Array
from .claim import Cause, Result
from .said import Found, Missing

SHAKEN = 0.1  # part of dphi/dt by which it may be off and still be well approximated
FAST = 1e-3  # m/s: a slip rate that only a rupture reaches
SETTLED = 0.5  # from this part of the onset time on the patch counts as developed
NONE = float("nan")


@dataclasses.dataclass(frozen=True)
class Measures:
    """Numbers read from one simulation, or the mean of several; SI units, NaN without an event."""

    rupture_time: float  # during which some point slips faster than FAST, zero if none does
    largest_rate: float  # of slip, ever
    usual_step: float  # median of the time steps
    largest_normal_stress_ever: float  # sigma_yy over the record, event and rupture among it
    lengths: Sequence[float] = (NONE,) * 9  # L_c: edges at three slip rates, at three instants
    acceleration_time: float = NONE  # in which the fastest slip rate rises from 10 to 100 V
    growth_time: float = NONE  # in which the patch would grow by its own length, before the onset
    front_speed: float = NONE  # mean speed of the patch's edge before the onset
    drop_time: float = NONE  # from the steep part of the force's drop to its end
    onset_rate: float = NONE  # largest slip rate at the onset
    patch_rates: Sequence[float] = (NONE,) * 3  # median in the developed patch: median, ends
    regular_share: float = NONE  # of the patch at the onset that slips at more than ten times v0
    middle_stress: float = NONE  # shear stress half-way along the block at the onset
    largest_normal_stress: float = NONE  # sigma_yy up to the onset, negative in compression
    shortest_step: float = NONE  # after the onset
    state_rate_share: float = NONE  # of interface and time to the onset: v for w gives dphi/dt well
    state_rate_share_patch: float = NONE  # the same within the creep patch


def mean(measures: Iterable[Measures]) -> Measures:
    """The mean of several simulations, number by number."""
    columns = zip(*map(dataclasses.astuple, measures), strict=True)
    return Measures(*(np.mean(column, axis=0) for column in columns))


def measure(simulation: xr.Dataset, settings: ExtractionSettings) -> Measures:
    """Read a simulation (the record of :func:`nucleation.simulation.run.simulate`)."""
    record = Record(simulation, settings)
    fastest = simulation["maximal_slip_rate"].values
    sizes = simulation["step_size"].values[1:]
    always: dict[str, Any] = {
        "rupture_time": float(sizes[fastest[1:] > FAST].sum()),
        "largest_rate": float(fastest.max()),
        "usual_step": float(np.median(sizes)),
        "largest_normal_stress_ever": float(simulation["normal_stress"].values.max()),
    }
    if record.onset is None:
        return Measures(**always)
    start = record.onset.start
    return Measures(**always, **_drop(record, start, fastest, sizes), **_patch(record))


def _drop(record: Record, start: int, fastest: Array, sizes: Array) -> dict[str, Any]:
    """How fast the event is that starts with a step."""
    velocity, steps = record.velocity, record.step_time
    _, steep, end = record.drop_times
    rates = fastest[start:]
    hundred = int(np.argmax(rates > 100.0 * velocity))  # zero also if it is never so fast
    slower = np.flatnonzero(rates[:hundred] < 10.0 * velocity)
    acceleration = steps[start + hundred] - steps[start + slower[-1]] if slower.size else NONE
    return {
        "acceleration_time": float(acceleration),
        "drop_time": float(end - steep),
        "onset_rate": float(fastest[start]),
        "shortest_step": float(sizes[start:].min()),
    }


def _patch(record: Record) -> dict[str, Any]:
    """The creeping patch up to the onset, and its length by every definition."""
    instants, times, x = record.drop_times, record.time, record.x
    frames, friction = record.frames_at(instants), record.parameters.friction
    at, length = int(frames[0]), record.lengths
    rate, state, stress, normal = (
        record.simulation[name].values[: at + 1]
        for name in ("slip_rate", "state", "shear_stress", "normal_stress")
    )
    inside = x <= length[: at + 1, None]
    developed = np.flatnonzero(times[: at + 1] >= SETTLED * instants[0])
    medians = np.array([np.median(np.abs(rate[i][inside[i]])) for i in developed])
    speed = (length[at] - length[developed[0]]) / (times[at] - times[developed[0]])
    good = _state_rate_well_approximated(rate, state, friction)
    weight = np.gradient(times[: at + 1])[:, None] * np.ones_like(rate)
    regular = np.abs(rate[at]) > 10.0 * friction.regularisation_slip_rate
    return {
        "lengths": tuple(float(edges[i]) for edges in record.all_lengths for i in frames),
        "growth_time": float(length[at] / speed) if speed > 0.0 else math.inf,
        "front_speed": float(speed),
        "patch_rates": (float(np.median(medians)), float(medians.min()), float(medians.max())),
        "regular_share": float(regular[inside[at]].mean()),
        "middle_stress": float(np.abs(stress[at, x.size // 2])),
        "largest_normal_stress": float(normal.max()),
        "state_rate_share": float((weight * good).sum() / weight.sum()),
        "state_rate_share_patch": float((weight * good * inside).sum() / (weight * inside).sum()),
    }


def _state_rate_well_approximated(
    rate: Array, state: Array, friction: Friction
) -> NDArray[np.bool_]:
    """Where ``dphi/dt`` with v in the place of ``w = sqrt(v^2 + v0^2)`` is nearly the same."""
    speed = np.maximum(np.abs(rate), 1e-300)
    omega = state * speed / friction.characteristic_slip_distance
    full = friction.state_rate(rate, state)
    approximate = friction.evolution_law.growth(omega)
    return np.abs(approximate - full) <= SHAKEN * np.abs(full)


MESH = "A coarse mesh lets the force drop early"
"""Section of docs/findings.md on the difference of the two."""


@dataclasses.dataclass(frozen=True)
class Evidence:
    """Datasets and settings of one configuration.

    Attributes
    ----------
    material, friction, loading : of the configuration.
    interface : the main text's rounded friction.
    theory : dataset of the theory's curves.
    dispersion : dataset of single modes integrated in time.
    lengths : tables of lengths, one for each study judged, and of the role
        :data:`~nucleation.configuration.roles.LONGER`.
    measures : what is read from each of their simulations, by id.
    patches : stability of the patches with the role :data:`JUDGED`, by id of each fault's first
        realisation.
    """

    material: Material
    friction: Friction
    loading: Loading
    interface: InterfaceState
    theory: xr.Dataset
    dispersion: xr.Dataset
    lengths: tuple[xr.Dataset, ...]
    measures: dict[str, Measures]
    patches: dict[str, xr.Dataset]

    @property
    def nu(self) -> float:
        """Poisson's ratio in the plane."""
        return self.material.in_plane_ratio

    def rows(self, role: str, **labels: Any) -> list[dict[str, Any]]:
        """Rows of the table of lengths, sorted by height (m); raises Missing if there is none.

        One for each fault of the configuration's material, friction and loads: the mean of its
        realisations, of which ``members`` are the names.
        """
        wanted = {"role": role, **labels}
        found = [row for row in self._own if all(_same(row[k], v) for k, v in wanted.items())]
        if not found:
            which = "".join(f", {name} {value}" for name, value in labels.items())
            raise Missing(f"The configuration has no such run: role {role}{which}")
        return sorted(found, key=lambda row: row["height"])

    @cached_property
    def _own(self) -> list[dict[str, Any]]:
        """The rows of all roles, which every claim asks for."""
        return [row for table in self.lengths for row in _faults(table) if self._is_own(row)]

    def row(self, role: str, law: str, height: float, phi0: float = 1.0) -> dict[str, Any]:
        """The one row with these labels; raises Missing if there is none."""
        return self.rows(role, evolution=law, height=height, phi0=phi0)[0]

    def series(self, role: str) -> list[dict[str, Any]]:
        """The aging law's rows with a role over all heights, age 1 s."""
        return self.rows(role, evolution="aging", phi0=1.0)

    def _is_own(self, row: dict[str, Any]) -> bool:
        """Whether a row is of the configuration's material, friction and loads, on a rigid base."""
        own = Parameters(
            self.material,
            self.friction.changed({"evolution": row["evolution"]}),
            dataclasses.replace(self.loading, initial_state=float(row["phi0"])),
            Geometry(height=float(row["height"])),
        )
        return bool(row["fault"] == fault(own))

    def measured(self, row: dict[str, Any]) -> Measures:
        """What was read from the simulations of a row, their mean; raises Missing without one."""
        return mean(self._measures(row))

    def each_measured(self, role: str, **labels: Any) -> list[Measures]:
        """What was read from every simulation of some rows; raises Missing without one."""
        return [one for row in self.rows(role, **labels) for one in self._measures(row)]

    def _measures(self, row: dict[str, Any]) -> list[Measures]:
        for id in row["members"]:
            if id not in self.measures:
                raise Missing(f"The simulation {id} is not among the results")
        return [self.measures[id] for id in row["members"]]

    def patch(self, row: dict[str, Any]) -> xr.Dataset:
        """The stability of the patch of a row's first realisation; raises Missing without it."""
        if row["id"] not in self.patches:
            raise Missing(f"The stability of the patch of {row['id']} was not computed")
        return self.patches[row["id"]]


def on_both(numbers: Callable[[Evidence, str], Found]) -> Callable[[Evidence], Result]:
    """For numbers of the runs with a role: the verdict stands on the converged, perturbed ones.

    If the statement holds on the paper's own mesh only, the mesh is the cause.
    """

    def of_either(evidence: Evidence) -> Result:
        judged = numbers(evidence, JUDGED)
        try:
            papers = numbers(evidence, PAPERS)
        except Missing:
            return Result(judged)
        cause = Cause(MESH, "On the paper's own mesh ours is", papers)
        return Result(judged, on_papers_mesh=papers, cause=cause)

    return of_either


def of_runs(
    measure: str, over: Callable[[Evidence], float] = lambda evidence: 1.0
) -> Callable[[Evidence], Result]:
    """The same for one of :class:`.Measures` of every run, over a unit."""
    return on_both(
        lambda evidence, role: [
            getattr(run, measure) / over(evidence) for run in evidence.each_measured(role)
        ]
    )


def _faults(table: xr.Dataset) -> list[dict[str, Any]]:
    """The rows of a table of lengths, one for each fault, with the names of its realisations."""
    ids = table["id"].values
    rows = over_realisations(table).to_dataframe().to_dict("records")
    return [
        row | {"members": ids[members].tolist()}
        for row, members in zip(rows, realisations(table), strict=True)
    ]


def _same(one: Any, other: Any) -> bool:
    return bool(one == other if isinstance(other, str) else np.isclose(one, other, rtol=1e-9))
