"""Recording a run: interface fields at adaptive times, and the drive at every step."""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from ..datasets.variables import annotate
from ..fem.factors import elastic_energy
from ..model.settings import STUCK_BELOW
from ..run.run import Run
from ..types import Array, Arrays
from . import passes
from .event import FEW, RESOLVED, WINDOW, front_width, has_dropped, long_after, patch_runs_away
from .recorded import RECORDED
from .step import Dynamics, State, StepReport

LONGEST_PAUSE = 0.4  # longest time between frames, in units of D/V
FRAME_CHANGE = 0.5  # a frame whenever asinh(v / V) has changed by this much at some node
FRAME_STEPS = 40  # largest number of steps between frames

FOR_LENGTHS = ("slip_rate", "state", "sigma_yy")
"""Fields from which patch, edge and the frozen patch's stability are computed."""

INTERFACE = (*FOR_LENGTHS, "slip", "shear_stress")
ONLY_IN_FULL = ("step_size", "newton_iterations")  # no length is computed from these
PER_STEP = ("step_time", "driving_force", "maximal_slip_rate", "fastest_position", *ONLY_IN_FULL)

ENERGIES = ("elastic_energy", "kinetic_energy", "work", "friction_work")
"""The work of the driven edge and of the far loads is what is stored as elastic and kinetic energy,
what friction dissipates, and the little that the time scheme does."""


class Recorder:
    """Collects the states of one run and makes the dataset."""

    def __init__(self, run: Run, dynamics: Dynamics) -> None:
        self.run = run
        self.grid = dynamics.grid
        self._body = dynamics.body
        self._drive = dynamics.drive
        self._velocity = run.fault.velocity
        self._longest_pause = LONGEST_PAUSE * run.memory_time
        self._fields = INTERFACE if run.stepping.record == "interface" else FOR_LENGTHS
        self._rows: list[tuple[float, ...]] = []  # of PER_STEP
        self._frame_times: list[float] = []
        self._frames: list[Array] = []  # of the fields
        self._last_scaled = np.empty(0)  # asinh(v / V) of the last frame
        self._last_frame_step = 0
        self._energy = _Energy(dynamics) if self._fields == INTERFACE else None
        self._maxima: list[tuple[float, float]] = []  # of the force
        self._runs_away = False
        self._event_time = np.inf
        self._onset_time = np.inf
        self._short_drop_time = np.inf  # of the first drop with too short a patch

    @property
    def steps(self) -> int:
        """Number of accepted steps recorded."""
        return len(self._rows) - 1

    @property
    def covers_event(self) -> bool:
        """Whether the event has begun, and ``stepping.time_after_event`` has passed since then."""
        return self._rows[-1][0] >= self._event_time + self.run.stepping.time_after_event

    def record(self, state: State, report: StepReport) -> None:
        """Take in the initial state or one accepted step."""
        interface = report.interface
        node = int(np.abs(interface.slip_rate).argmax())
        fastest = float(abs(interface.slip_rate[node]))
        position = float(self.grid.x[node])
        row = (
            state.time,
            report.driving_force,
            fastest,
            position,
            state.last_step,
            interface.iterations,
        )
        self._rows.append(row)
        runs_away = patch_runs_away(self.run, self._runs_away, state.time, fastest, position)
        self._runs_away = runs_away
        dropped = has_dropped(
            self._maxima,
            WINDOW * self.run.memory_time,
            self.run.stepping.event_drop,
            state.time,
            abs(report.driving_force),
            runs_away,
        )
        if dropped and np.isinf(self._event_time):
            # it is the event if the patch was long enough when the drop began
            onset = self._maxima[0][0]
            times = np.array(self._frame_times)
            rates = np.array([fields[0] for fields in self._frames])
            if onset > long_after(self.run, self.grid.x, times, rates):
                self._event_time = state.time
                self._onset_time = onset
            else:
                self._short_drop_time = min(self._short_drop_time, onset)
        self._take_frame(state, report)
        if self._energy is not None:
            self._energy.take(state, report)

    def remarks(self) -> list[str]:
        """Reasons to doubt the event, or that there is none."""
        found = []
        if np.isfinite(self._onset_time):
            distances = np.abs(np.array(self._frame_times) - self._onset_time)
            state = self._frames[int(distances.argmin())][1]
            width = front_width(self.run, self.grid.x, state)
            if width < RESOLVED:
                found.append(f"not resolved: at the onset the front is {width:.1f} elements wide")
        if np.isfinite(self._short_drop_time):
            found.append(
                f"no event: the drop at t = {self._short_drop_time:.4g} s began with a patch of "
                f"{FEW} elements or fewer"
            )
        return found

    def _take_frame(self, state: State, report: StepReport) -> None:
        """Take in the fields, if they have changed or the last frame is long ago."""
        interface = report.interface
        rate, velocity = interface.slip_rate, self._velocity
        due = (
            not self._frames
            or state.time - self._frame_times[-1] >= self._longest_pause
            or len(self._rows) - self._last_frame_step >= FRAME_STEPS
            or passes.largest_change(rate, self._last_scaled, velocity) >= FRAME_CHANGE
        )
        if not due:
            return
        lengths = self.grid.nodal_lengths
        displacement = self._drive.at(state.time).displacement
        values = {
            "slip_rate": rate,
            "state": np.exp(interface.log_state),
            "sigma_yy": -interface.normal / lengths,
            "slip": displacement + self._body.modes.on_all_nodes(interface.w, 0.0),
            "shear_stress": -interface.tangential / lengths,
        }
        self._last_scaled = np.arcsinh(rate / velocity)
        self._last_frame_step = len(self._rows)
        self._frame_times.append(state.time)
        self._frames.append(np.array([values[name] for name in self._fields]))

    def to_arrays(self) -> Arrays:
        """The exact record as plain arrays by name, to be stored."""
        return {
            "rows": np.array(self._rows),
            "frame_times": np.array(self._frame_times),
            "frames": np.array(self._frames),
            "last_frame_step": np.array(self._last_frame_step),
            "watched": np.array(self._maxima),
            "event_times": np.array([self._event_time, self._onset_time, self._short_drop_time]),
            "own_burst": np.array(self._runs_away),
            **({} if self._energy is None else self._energy.to_arrays()),
        }

    def restore(self, arrays: Mapping[str, Array]) -> None:
        """The inverse of :meth:`to_arrays`, on a recorder of the same parameters."""
        self._rows = []
        for *values, iterations in arrays["rows"].tolist():
            self._rows.append((*values, int(iterations)))
        self._frame_times = arrays["frame_times"].tolist()
        self._frames = list(arrays["frames"])
        self._last_scaled = np.arcsinh(self._frames[-1][0] / self._velocity)
        self._last_frame_step = int(arrays["last_frame_step"])
        self._maxima = [tuple(one) for one in arrays["watched"].tolist()]
        self._event_time, self._onset_time, self._short_drop_time = arrays["event_times"].tolist()
        self._runs_away = bool(arrays["own_burst"])
        if self._energy is not None:
            self._energy.restore(arrays)

    def dataset(self) -> xr.Dataset:
        """The record of the run so far, with the variables of :data:`RECORDED`."""
        data: dict[str, tuple[Sequence[str], Array]] = {}
        for name, values in zip(PER_STEP, zip(*self._rows, strict=True), strict=True):
            data[name] = ("step",), np.array(values)
        frames = np.array(self._frames)
        for i, name in enumerate(self._fields):
            data[name] = ("time", "x"), frames[:, i]
        dataset = xr.Dataset(data, {"time": self._frame_times, "x": self.grid.x})
        dataset.attrs["parameters"] = self.run.to_json()
        if self._energy is None:
            # only what lengths need, zero where the fault is stuck
            fast = np.abs(dataset["slip_rate"].values) >= STUCK_BELOW * self._velocity
            slips = fast.copy()
            slips[:, 1:] |= fast[:, :-1]  # and nodes beside it, between which edges are
            slips[:, :-1] |= fast[:, 1:]
            reduced = dataset[list(FOR_LENGTHS)].where(slips, 0.0).astype(np.float32)
            dataset = dataset.drop_vars(ONLY_IN_FULL).assign(reduced)
        else:
            dataset = dataset.assign(self._energy.since_start())
        return annotate(dataset, RECORDED)


class _Energy:
    """Adds up the works of one run's steps (J/m) by the trapezoidal rule, and compares energies."""

    def __init__(self, dynamics: Dynamics) -> None:
        self._dynamics = dynamics
        self._works = np.zeros(2)  # of edge and loads, and of friction on the body
        self._start = np.empty(0)  # elastic and kinetic energy
        self._last: tuple[Array, ...] = ()  # forces (N/m), those of friction last, and ways (m)

    def take(self, state: State, report: StepReport) -> None:
        """Take in the initial state or a step."""
        self._state = state
        dynamics, interface = self._dynamics, report.interface
        own, modes = dynamics.grid.own, dynamics.body.modes
        imposed = dynamics.drive.at(state.time)
        moved = imposed.displacement
        forces = (np.array([-report.driving_force, *imposed.factors]), interface.tangential[own])
        ways = (
            np.array([moved, *dynamics.works(state.motions[0])]),
            moved + modes.on_all_nodes(interface.w, 0.0)[own],
        )
        before, self._last = self._last, (*forces, *ways)
        if not before:
            self._start = self._stored(state)
            return
        for i, (force, way) in enumerate(zip(forces, ways, strict=True)):
            self._works[i] += 0.5 * np.vdot(before[i] + force, way - before[len(ways) + i])

    def _stored(self, state: State) -> Array:
        """Elastic and kinetic energy (J/m)."""
        dynamics = self._dynamics
        body, imposed = dynamics.body, dynamics.drive.at(state.time)
        motion = dynamics.in_form(state, condensed=False).motions[0]
        parts = zip(body.layers, body.parts(motion.displacement), strict=True)
        elastic = sum(elastic_energy(layer, part) for layer, part in parts)
        return np.array([elastic, body.kinetic_energy(motion.velocity, imposed.velocity)])

    def since_start(self) -> dict[str, float]:
        """:data:`ENERGIES` (J/m) at the present step."""
        elastic, kinetic = self._stored(self._state) - self._start
        work, by_friction = self._works
        values = (elastic, kinetic, work, -by_friction)
        return dict(zip(ENERGIES, map(float, values), strict=True))

    def to_arrays(self) -> Arrays:
        """What is not in the state, as plain arrays by name, to be stored; exact."""
        last = {f"energy_{i}": values for i, values in enumerate(self._last)}
        return last | {"energy_works": self._works.copy(), "energy_start": self._start}

    def restore(self, arrays: Mapping[str, Array]) -> None:
        """The inverse of :meth:`to_arrays`, with the arrays of the state."""
        self._works = arrays["energy_works"].copy()
        self._start = arrays["energy_start"]
        self._last = tuple(arrays[f"energy_{i}"] for i in range(4))  # two forces, two ways
        self._state = State.from_arrays(arrays)
