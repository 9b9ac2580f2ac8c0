"""Twin runs: does a small kick of the creeping patch grow as the frozen patch says?

A run is stopped when its patch has some length, and goes on twice from the same state: as it is,
and with the log of the state variable kicked in the shape of the patch's oscillating mode. Both
twins take the same steps, so the difference of the two obeys the full equations, linearised about
the run as it goes on: inertia, the moving front and its hops from node to node included. All of
that is left out where the patch is frozen (:mod:`nucleation.patch.frozen`).

The mode's complex amplitude in the difference follows by the left eigenvector of the frozen patch,
which other modes do not enter; its logarithm's slope is growth rate and frequency. As the patch
grows by some per cent meanwhile, it is compared with the frozen patch's mean over the same time.
"""

import dataclasses
from collections import deque
from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..analysis.definitions import Extent, ExtractionSettings
from ..datasets.variables import Variable
from ..datasets.variables import table as table_of
from ..model.parameters import Parameters
from ..simulation.control import Instant
from ..simulation.run import composed, run
from ..simulation.state import State
from ..simulation.step import Dynamics, StepReport
from ..theory.creep.linearised import FrozenPatch
from ..types import ComplexArray
from .frozen import Freezer

SHARES = (0.45, 0.5, 0.53, 0.56, 0.6, 0.65)  # patch lengths over the theory's critical length
KICK = 1e-4  # of log(phi), largest over the patch
PERIODS = 3.0  # of the frozen patch's oscillation over which the twins are followed,
SKIPPED = 0.5  # of them at first: what the kick's other parts leave dies out
FROZEN = 8  # instants of that time at which the patch is frozen again
EVENT = 10.0  # slip rate over V beyond which the run has left its creep

MEASURED = {
    "twin_time": Variable("s", "time of the kick", "t"),
    "twin_length": Variable("m", "mean patch length while the kick is followed", "L(t)"),
    "twin_length_first": Variable("m", "patch length at the kick", "L(t)"),
    "twin_length_last": Variable("m", "patch length at the end", "L(t)"),
    "twin_growth": Variable("1/s", "growth rate of the kick", "Re Lambda"),
    "twin_frequency": Variable("1/s", "angular frequency of the kick", "Im Lambda"),
    "frozen_growth": Variable("1/s", "mean growth rate of the frozen patch", "Re Lambda"),
    "frozen_frequency": Variable("1/s", "mean frequency of the frozen patch", "Im Lambda"),
}
"""What is measured of a kick."""


class Patches(Freezer):
    """The frozen patches of one run, from its step reports."""

    def __init__(self, parameters: Parameters, settings: ExtractionSettings) -> None:
        super().__init__(parameters, settings.edge_threshold * parameters.loading.velocity)
        self._extent = Extent(self.grid.x, self.threshold)

    def length(self, report: StepReport) -> float:
        """The patch's length (m) at an instant, all of which are asked for in their order."""
        return self._extent.reach(report.interface.slip_rate)

    def at(self, report: StepReport) -> tuple[FrozenPatch, complex]:
        """The frozen patch at an instant, and Lambda (1/s) of its oscillating mode."""
        at = report.interface
        patch = self.frozen(at.slip_rate, np.exp(at.log_state), at.normal)
        return patch, self.oscillating(patch, at.slip_rate)


class Twin:
    """A kicked run beside the run it started from, and what is seen of the two."""

    def __init__(self, patches: Patches, dynamics: Dynamics, instant: Instant) -> None:
        self._patches, self._dynamics = patches, dynamics
        patch, self._rate = patches.at(instant.report)
        self._nodes = patch.nodes
        self._weights = patch.amplitude(self._rate)
        shape = np.zeros(patches.grid.n_x + 1)
        shape[patch.nodes] = patch.mode(self._rate)[1].real
        self.state = kicked(instant.state, shape, KICK)
        self._start = instant.state.time
        self._duration = 2.0 * np.pi * PERIODS / self._rate.imag
        self._time: list[float] = []
        self._amplitude: list[complex] = []
        self._frozen: list[complex] = []
        self._lengths: list[float] = []

    def advance(self, instant: Instant, length: float) -> bool:
        """Take the step that the run has taken; whether the twins have been followed enough.

        `length` (m) is that of the run's patch at this instant.
        """
        scheme = self._dynamics.scheme
        rung = scheme.rung(instant.state.last_step, self.state.last_step)
        self.state, _ = self._dynamics.advance(self.state, rung)
        since = instant.state.time - self._start
        self._time.append(since)
        change = difference(instant.state, self.state, self._nodes)
        self._amplitude.append(complex(change @ self._weights))
        if since >= len(self._lengths) * self._duration / FROZEN:
            self._lengths.append(length)
            self._frozen.append(self._patches.at(instant.report)[1])
        return since >= self._duration

    @property
    def measured(self) -> dict[str, float]:
        """:data:`MEASURED`."""
        used = np.array(self._time) >= 2.0 * np.pi * SKIPPED / self._rate.imag
        rate = fitted_rate(np.array(self._time)[used], np.array(self._amplitude)[used])
        frozen = complex(np.mean(self._frozen))
        values = (
            self._start, float(np.mean(self._lengths)), self._lengths[0], self._lengths[-1],
            rate.real, rate.imag, frozen.real, frozen.imag,
        )  # fmt: skip
        return dict(zip(MEASURED, values, strict=True))


def kicked(state: State, shape: NDArray[np.float64], size: float) -> State:
    """A state whose log state variable is changed by a shape over the nodes 0..n_x, at all times.

    Past values change alike: the kick is one of the field, not of its rate.
    """
    change = size * shape / np.abs(shape).max()
    return dataclasses.replace(state, past_log_states=state.past_log_states + change)


def difference(one: State, other: State, nodes: NDArray[np.intp]) -> NDArray[np.float64]:
    """Displacement (m) and log state of one state less those of another at some nodes, (2 n,)."""
    return np.append(
        (other.past_w[0] - one.past_w[0])[nodes - 1],
        (other.past_log_states[0] - one.past_log_states[0])[nodes],
    )


def fitted_rate(time: NDArray[np.float64], amplitude: ComplexArray) -> complex:
    """Growth rate and frequency (1/s) of a complex amplitude over time (s), by least squares."""
    logarithm = np.log(np.abs(amplitude)) + 1j * np.unwrap(np.angle(amplitude))
    return complex(np.polyfit(time, logarithm, 1)[0])


def follow_twins(
    parameters: Parameters, theory_length: float, settings: ExtractionSettings,
    shares: Iterable[float] = SHARES,
) -> xr.Dataset:  # fmt: skip
    """Twins of one run, started at several lengths of its patch: :data:`MEASURED` on ``twin``.

    The `shares` are of the theory's length (m). Twins not followed enough when the run or its creep
    ends are left out.
    """
    parameters.require_edge("role = twins")
    patches, dynamics = Patches(parameters, settings), composed(parameters)
    lengths = deque(share * theory_length for share in sorted(shares))
    active: list[Twin] = []
    rows = []
    for instant in run(parameters):
        state = instant.state
        fastest = float(np.abs(state.past_slip_rates[0]).max())
        creeps = fastest < EVENT * parameters.loading.velocity
        if not (creeps and state.time < parameters.stepping.end_time and (active or lengths)):
            break
        length = patches.length(instant.report)
        finished = [twin for twin in active if twin.advance(instant, length)]
        active = [twin for twin in active if twin not in finished]
        rows += [twin.measured for twin in finished]
        if lengths and length >= lengths[0]:
            lengths.popleft()
            active.append(Twin(patches, dynamics, instant))
    rows.sort(key=lambda row: row["twin_time"])
    found = table_of(rows, MEASURED, "twin")
    return found.assign_attrs(parameters=parameters.to_json())


def of_run(run: dict[str, Any], settings: ExtractionSettings) -> xr.Dataset:
    """The step ``twin``: the twins of a run of a study."""
    return follow_twins(Parameters.from_dict(run["parameters"]), run["theory_length"], settings)
