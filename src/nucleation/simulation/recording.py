"""Recording a run: interface fields at adaptive times, the drive at every step, bulk snapshots."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..datasets.variables import annotate
from ..model.parameters import Parameters
from ..model.recording import STUCK_BELOW
from ..types import Array
from . import passes, remarks
from .event import WINDOW, DropWatch, PatchBursts, long_after
from .recorded import RECORDED
from .state import State
from .step import Dynamics, StepReport

LONGEST_PAUSE = 0.4  # longest time between frames, in units of D/V
FRAME_CHANGE = 0.5  # a frame whenever asinh(v / V) has changed by this much at some node
INTERFACE = ("slip_rate", "state", "normal_stress", "slip", "shear_stress")
FOR_LENGTHS = INTERFACE[:3]  # of which patch, edge and the frozen patch's stability are made
PER_STEP = (
    "step_time", "driving_force", "maximal_slip_rate", "fastest_position", "step_size",
    "newton_iterations",
)  # fmt: skip
ONLY_IN_FULL = PER_STEP[4:]  # of which no length is made
BULK = ("displacement_x", "displacement_y", "velocity_x", "velocity_y")
FRAME_STEPS = 40  # and at least every so many steps
SNAPSHOT_RATES = (3.0, 30.0, 300.0, 3000.0)  # a bulk snapshot when max v / V first exceeds these


class Recorder:
    """Collects the states of one run and makes the dataset."""

    def __init__(self, parameters: Parameters, dynamics: Dynamics) -> None:
        self.parameters, self._level = parameters, parameters.recording
        self.grid, self._body, self._drive = dynamics.grid, dynamics.body, dynamics.drive
        self._velocity = parameters.loading.velocity
        self._fields = INTERFACE if self._level.covers("interface") else FOR_LENGTHS
        self._longest_pause = LONGEST_PAUSE * parameters.memory_time
        self._rows: list[tuple[float, float, float, float, float, int]] = []
        self._frames: list[tuple[float, Array]] = []
        self._snapshots: list[tuple[float, Array]] = []
        self._snapshots_below: list[Array] = []  # at the same times, on a second body
        self._last_scaled = np.empty(0)
        self._last_frame_step = 0
        self._next_snapshot_rate = 0
        self._watch = DropWatch(WINDOW * parameters.memory_time, parameters.stepping.event_drop)
        self._bursts = PatchBursts(parameters)
        self._event_time = np.inf
        self._onset_time = np.inf
        self._short_drop_time = np.inf  # of the first drop whose patch was too short
        self._time = 0.0

    @property
    def steps(self) -> int:
        """Number of accepted steps recorded."""
        return len(self._rows) - 1

    @property
    def covers_event(self) -> bool:
        """Whether the event has begun and the time asked for after it has passed."""
        return self._time >= self._event_time + self.parameters.stepping.time_after_event

    def record(self, state: State, report: StepReport) -> None:
        """Take in the initial state or one accepted step."""
        interface = report.interface
        node = passes.largest_at(interface.slip_rate)
        fastest, position = float(abs(interface.slip_rate[node])), float(self.grid.x[node])
        self._time = state.time
        force, step, iterations = report.driving_force, state.last_step, interface.iterations
        self._rows.append((state.time, force, fastest, position, step, iterations))
        fast = self._bursts.at(state.time, fastest, position)
        dropped = self._watch.dropped(state.time, abs(report.driving_force), fast)
        if dropped and np.isinf(self._event_time):
            self._take_in_drop()
        self._maybe_frame(state, report)
        self._maybe_snapshot(state, fastest)

    def _take_in_drop(self) -> None:
        """A drop of the force is the event if the patch was long enough when it began."""
        onset = self._watch.since
        times = np.array([time for time, _ in self._frames])
        rates = np.array([fields[0] for _, fields in self._frames])
        if onset > long_after(self.parameters, self.grid.x, times, rates):
            self._event_time, self._onset_time = self._time, onset
        else:
            self._short_drop_time = min(self._short_drop_time, onset)

    def remarks(self) -> list[str]:
        """What makes the event, or that there is none, doubtful."""
        times, _, rates, positions = np.array([row[:4] for row in self._rows]).T
        elsewhere = remarks.fastest_elsewhere(
            self.parameters, times, rates, positions, self._onset_time
        )
        return [
            *remarks.of_front(self._front_width()),
            *remarks.of_slip_elsewhere(elsewhere),
            *remarks.of_short_patch(self._short_drop_time),
        ]

    def _front_width(self) -> float:
        """Width of the front (elements) at the onset; infinite without an event."""
        if np.isinf(self._onset_time):
            return np.inf
        times = np.array([time for time, _ in self._frames])
        _, fields = self._frames[int(np.abs(times - self._onset_time).argmin())]
        return remarks.front_width(self.parameters, self.grid.x, fields[1])

    def _maybe_frame(self, state: State, report: StepReport) -> None:
        rate = report.interface.slip_rate
        due = (
            not self._frames
            or state.time - self._frames[-1][0] >= self._longest_pause
            or len(self._rows) - self._last_frame_step >= FRAME_STEPS
            or passes.changed(rate, self._last_scaled, self._velocity) >= FRAME_CHANGE
        )
        if not due:
            return
        self._last_scaled = np.arcsinh(rate / self._velocity)
        self._last_frame_step = len(self._rows)
        interface, lengths = report.interface, self.grid.nodal_lengths
        slip = self._drive.at(state.time).displacement + self._body.on_all_nodes(interface.w, 0.0)
        fields = (
            interface.slip_rate, np.exp(interface.log_state), -interface.normal / lengths,
            slip, -interface.tangential / lengths,
        )  # fmt: skip
        self._frames.append((state.time, np.array(fields[: len(self._fields)])))

    def _maybe_snapshot(self, state: State, fastest: float) -> None:
        if not self._level.covers("everything"):
            return
        rates = SNAPSHOT_RATES[self._next_snapshot_rate :]
        exceeded = sum(fastest > rate * self._velocity for rate in rates)
        if not self._snapshots or exceeded:
            self._next_snapshot_rate += exceeded
            self._snapshots.append((state.time, self._bulk(state)))
            if self._body.grid_below is not None:
                self._snapshots_below.append(self._bulk_below(state))

    def _bulk(self, state: State) -> Array:
        """Displacement and velocity at the nodes, shape (4, n_y + 1, n_x + 1)."""
        edge = self._drive.at(state.time)
        x, y = self._body.nodal_values(state.displacement)
        rate_x, rate_y = self._body.nodal_values(state.velocity)
        return np.array([x + edge.displacement, y, rate_x + edge.velocity, rate_y])

    def _bulk_below(self, state: State) -> Array:
        """The same of a second body, its levels from the interface down."""
        fields = state.displacement, state.velocity
        return np.array([v for field in fields for v in self._body.nodal_values_below(field)])

    def to_arrays(self) -> dict[str, NDArray]:
        """Everything recorded, as plain arrays by name, to be stored; exact."""
        return {
            "rows": np.array(self._rows),
            "frame_times": np.array([t for t, _ in self._frames]),
            "frames": np.array([fields for _, fields in self._frames]),
            "last_frame_step": np.array(self._last_frame_step),
            "snapshot_times": np.array([t for t, _ in self._snapshots]),
            "snapshots": np.array([fields for _, fields in self._snapshots]),
            "snapshots_below": np.array(self._snapshots_below),
            "next_snapshot_rate": np.array(self._next_snapshot_rate),
            "watched": self._watch.maxima,
            "event_times": np.array([self._event_time, self._onset_time, self._short_drop_time]),
            "own_burst": np.array(self._bursts.own),
        }

    def restore(self, arrays: Mapping[str, NDArray]) -> None:
        """The inverse of :meth:`to_arrays`, on a recorder of the same parameters."""
        self._rows = [(*row[:5], int(row[5])) for row in arrays["rows"].tolist()]
        self._frames = list(zip(arrays["frame_times"].tolist(), arrays["frames"], strict=True))
        self._last_scaled = np.arcsinh(self._frames[-1][1][0] / self._velocity)
        self._last_frame_step = int(arrays["last_frame_step"])
        times = arrays["snapshot_times"].tolist()
        self._snapshots = list(zip(times, arrays["snapshots"], strict=True))
        self._snapshots_below = list(arrays["snapshots_below"])
        self._next_snapshot_rate = int(arrays["next_snapshot_rate"])
        self._watch.maxima = arrays["watched"]
        self._event_time, self._onset_time, self._short_drop_time = arrays["event_times"].tolist()
        self._bursts.own = bool(arrays["own_burst"])
        self._time = self._rows[-1][0]

    def dataset(self) -> xr.Dataset:
        """What was recorded, of :data:`RECORDED`."""
        return annotate(self._dataset(), RECORDED)

    def _dataset(self) -> xr.Dataset:
        times = np.array([t for t, _ in self._frames])
        frames = np.array([fields for _, fields in self._frames])
        rows = dict(zip(PER_STEP, map(np.array, zip(*self._rows, strict=True)), strict=True))
        data: dict[str, Any] = {name: (("step",), values) for name, values in rows.items()}
        data |= {name: (("time", "x"), frames[:, i]) for i, name in enumerate(self._fields)}
        dataset = xr.Dataset(data, {"time": times, "x": self.grid.x})
        dataset.attrs["parameters"] = self.parameters.to_json()
        if not self._level.covers("interface"):
            return self._for_lengths(dataset)
        realised = self._drive.realised({"step": rows["step_time"], "time": times})
        if realised is not None:
            dataset["perturbation"] = realised
        return dataset.assign(self._bodies()) if self._level.covers("everything") else dataset

    def _for_lengths(self, dataset: xr.Dataset) -> xr.Dataset:
        """Less: without what no length needs, and zero where the fault is stuck."""
        fast = np.abs(dataset["slip_rate"].values) >= STUCK_BELOW * self._velocity
        slips = fast.copy()
        slips[:, 1:] |= fast[:, :-1]  # and nodes beside it, between which edges are
        slips[:, :-1] |= fast[:, 1:]
        kept = {name: dataset[name].where(slips, 0.0).astype(np.float32) for name in FOR_LENGTHS}
        return dataset.drop_vars(ONLY_IN_FULL).assign(kept)

    def _bodies(self) -> xr.Dataset:
        """The snapshots of the bodies."""
        bulk = np.array([fields for _, fields in self._snapshots])
        times = np.array([t for t, _ in self._snapshots])
        data: dict[str, Any] = {"snapshot_time": (("snapshot",), times)}
        data |= {name: (("snapshot", "y", "x"), bulk[:, i]) for i, name in enumerate(BULK)}
        coords = {"y": self.grid.y, "x": self.grid.x}
        below = self._body.grid_below
        if below is not None:
            coords["second_y"] = -below.y
            for i, values in enumerate(np.moveaxis(np.array(self._snapshots_below), 1, 0)):
                data[f"second_{BULK[i]}"] = ("snapshot", "second_y", "x"), values
        return xr.Dataset(data, coords=coords)
