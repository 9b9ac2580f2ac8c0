"""A recorded run, and the critical nucleation length that the drop of its driving force gives.

All analysis reads a simulation's dataset through a :class:`Record`, so that parameters, thresholds,
onset and length of the patch are the same everywhere. The critical length is the patch's length at
the onset (both in :mod:`.definitions`). The error bar spans other reasonable definitions: edges
from 0.5 V to 1e-3 V, and instants up to the one where the drop is complete.
"""

import warnings
from functools import cached_property

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..datasets import DatasetError
from ..run.run import Run
from ..simulation.event import (
    WINDOW,
    Outcome,
    long_after,
    patch_lengths,
    patch_runs_away,
    runaway_rate,
)
from ..types import Array
from .definitions import MEASURED, ExtractionSettings, Onset, find_onset


def parameters_of(dataset: xr.Dataset) -> Run:
    """The parameters of the run that made a dataset, or from which it was derived."""
    return Run.from_json(dataset.attrs["parameters"])


class Record:
    """The dataset of one simulation, or of another solver, as the analysis sees it.

    Times (s) are those of the frames and of the steps, `fastest` is the largest slip rate (m/s) at
    each step, and `threshold` that at the edge of the patch.
    """

    def __init__(
        self, simulation: xr.Dataset, settings: ExtractionSettings = ExtractionSettings()
    ) -> None:
        self.simulation = simulation
        self.settings = settings
        self.run = parameters_of(simulation)
        self.velocity = self.run.fault.velocity  # the imposed one, V (m/s)
        self.threshold = settings.edge_threshold * self.velocity
        self.x = simulation["x"].values
        self.time = simulation["time"].values
        self.step_time = simulation["step_time"].values
        self.fastest = simulation["maximal_slip_rate"].values
        self._require_finite()

    def _require_finite(self) -> None:
        """Raise a DatasetError if a number that is read is none; a run that failed may end so."""
        if str(self.simulation.attrs.get("status")).startswith("failed"):
            return
        for name in self.simulation.variables:
            values = self.simulation[name].values
            if values.dtype.kind != "f" or np.isfinite(values).all():
                continue
            along = values.reshape(len(values), -1) if values.ndim else values.reshape(1, 1)
            first = int(np.argmin(np.isfinite(along).all(axis=1)))
            raise DatasetError(
                f"{name} is not finite from entry {first} on: the record can't be read"
            )

    def require(self, *names: str) -> None:
        """Make sure of variables that not every level of recording has.

        The message of the DatasetError names the level.
        """
        missing = [name for name in names if name not in self.simulation]
        if missing:
            raise DatasetError(
                f"{', '.join(missing)}: not recorded, as the run's record is "
                f"{self.run.stepping.record}; simulate with interface"
            )

    @cached_property
    def onset(self) -> Onset | None:
        """The first event, as indices into the steps; None if there is none."""
        long = long_after(self.run, self.x, self.time, self.simulation["slip_rate"].values)
        ruptures = self.fastest > runaway_rate(self.run)
        return find_onset(
            self.step_time,
            np.abs(self.simulation["driving_force"].values),
            WINDOW * self.run.memory_time,
            self.settings.drop,
            self._runs_away,
            self.step_time > long,
            ruptures & (self.run.fault.loading == "edge"),
        )

    @property
    def _runs_away(self) -> NDArray[np.bool_]:
        """Whether the patch runs away at each step; another solver records no position."""
        places = np.zeros(self.step_time.size)
        if "fastest_position" in self.simulation:
            places = self.simulation["fastest_position"].values
        found = [False]
        # lists, as numbers of arrays take four times as long
        for step in np.transpose([self.step_time, self.fastest, places]).tolist():
            found.append(patch_runs_away(self.run, found[-1], *step))
        return np.array(found[1:])

    @property
    def drop_times(self) -> Array:
        """Times (s) at which the force's drop starts, is steep and is complete, (3,)."""
        if self.onset is None:
            raise ValueError("the run has no event")
        return self.step_time[[self.onset.start, self.onset.steep, self.onset.end]]

    def frames_at(self, times: Array) -> NDArray[np.intp]:
        """The frames nearest to some times (s)."""
        return np.abs(self.time[:, None] - times).argmin(axis=0)

    @cached_property
    def creep(self) -> NDArray[np.intp]:
        """The frames up to the onset, all of them if there is none."""
        last = np.inf if self.onset is None else self.drop_times[0]
        return np.flatnonzero(self.time <= last)

    @cached_property
    def lengths(self) -> Array:
        """Length of the patch (m) at every frame: the largest one so far."""
        return self._lengths(self.settings.edge_threshold)

    @cached_property
    def lengths_at_drop(self) -> Array:
        """Those (m) by usual, high and low edge, and by start, steepest part and end, (3, 3)."""
        high = self._lengths(self.settings.edge_threshold_high)
        low = self._lengths(self.settings.edge_threshold_low)
        return np.array([self.lengths, high, low])[:, self.frames_at(self.drop_times)]

    def _lengths(self, share: float) -> Array:
        """Largest length (m) so far, for an edge at this share of V."""
        lengths = patch_lengths(
            self.run.fault.loading,
            self.x,
            self.simulation["slip_rate"].values,
            share * self.velocity,
        )
        return np.maximum.accumulate(lengths)


def extract(
    simulation: xr.Dataset, settings: ExtractionSettings = ExtractionSettings()
) -> dict[str, float]:
    """Read onset and critical length from one simulation.

    A warning is given if the run had an event, and ended before the force fell by the settings'
    drop.

    Parameters
    ----------
    simulation : Dataset
        Record of a run.
    settings : ExtractionSettings
        Definitions of the patch's edge and of the drop.

    Returns
    -------
    dict
        :data:`.definitions.MEASURED` by name (s, m); all NaN if the run has no event.

    Examples
    --------
    >>> from nucleation.api import PAPER, Run, simulate
    >>> run = Run.sized(PAPER, block_length=0.9, n_x=16, n_y=2, end_time=0.02)
    >>> extract(simulate(run))["length"]  # the run ends before its event
    nan
    """
    return extracted(Record(simulation, settings))


def extracted(record: Record) -> dict[str, float]:
    """What :func:`extract` returns, from a record whose onset is then known."""
    if record.onset is None:
        recorded, drop = record.run.stepping.event_drop, record.settings.drop
        status = str(record.simulation.attrs.get("status"))
        if drop > recorded and status.startswith(Outcome.AFTER_EVENT):
            warnings.warn(
                f"the run ended after its event, a drop of the force by {recorded:g}, and before "
                f"it fell by drop = {drop:g}: simulate with a larger stepping.event_drop "
                "or time_after_event",
                UserWarning,
                stacklevel=3,
            )
        return dict.fromkeys(MEASURED, float("nan"))
    instants = record.drop_times
    edges = record.lengths_at_drop
    return {
        "onset_time": float(instants[0]),
        "onset_time_low": float(instants.min()),
        "onset_time_high": float(instants.max()),
        "length": float(edges[0, 0]),
        "length_low": float(edges.min()),
        "length_high": float(edges.max()),
    }
