"""A recorded run: its parameters, its onset and its patch, each computed once.

All analysis reads a simulation's dataset through a :class:`Record`, so that parameters, thresholds,
onset and length of the patch are the same everywhere.
"""

from functools import cached_property

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..datasets import DatasetError
from ..run.run import Run
from ..simulation.event import WINDOW, PatchBursts, long_after, patch_lengths
from ..types import Array
from .definitions import RUPTURE, ExtractionSettings, Onset, find_onset


def parameters_of(dataset: xr.Dataset) -> Run:
    """The parameters of the run that made a dataset, or from which it was derived."""
    return Run.from_json(dataset.attrs["parameters"])


class Record:
    """The dataset of one simulation, as the analysis sees it.

    Parameters
    ----------
    simulation : Dataset
        Record of :func:`nucleation.simulation.run.simulate`, or of another solver.
    settings : ExtractionSettings
        Definitions of the patch's edge and of the drop.
    """

    def __init__(
        self,
        simulation: xr.Dataset,
        settings: ExtractionSettings = ExtractionSettings(),
    ) -> None:
        self.simulation = simulation
        self.settings = settings
        self.run = parameters_of(simulation)

    def require(self, *names: str) -> None:
        """Make sure of variables that not every level of recording has.

        Raises
        ------
        DatasetError
            If one was not recorded; the message names the level.
        """
        missing = [name for name in names if name not in self.simulation]
        if missing:
            raise DatasetError(
                f"{', '.join(missing)}: not recorded, as the run's recording.record is "
                f"{self.run.recording.record}; simulate with interface"
            )

    @property
    def velocity(self) -> float:
        """The imposed velocity V (m/s)."""
        return self.run.fault.velocity

    @cached_property
    def x(self) -> Array:
        """Positions (m) along the interface."""
        return self.simulation["x"].values

    @cached_property
    def time(self) -> Array:
        """Times (s) of the frames."""
        return self.simulation["time"].values

    @cached_property
    def step_time(self) -> Array:
        """Times (s) of the steps."""
        return self.simulation["step_time"].values

    @cached_property
    def onset(self) -> Onset | None:
        """The first event, as indices into the steps; None if there is none."""
        return find_onset(
            self.step_time,
            np.abs(self.simulation["driving_force"].values),
            WINDOW * self.run.memory_time,
            self.settings.drop,
            self._fast,
            self._long_enough,
            self._ruptures,
        )

    @cached_property
    def fastest(self) -> Array:
        """Largest slip rate (m/s) at each step."""
        return self.simulation["maximal_slip_rate"].values

    @property
    def _fast(self) -> NDArray[np.bool_]:
        """Whether the patch slips fast at each step; another solver records no position."""
        bursts = PatchBursts(self.run)
        places = np.zeros(self.step_time.size)
        if "fastest_position" in self.simulation:
            places = self.simulation["fastest_position"].values
        steps = zip(self.step_time, self.fastest, places, strict=True)
        return np.array([bursts.at(*step) for step in steps])

    @property
    def _ruptures(self) -> NDArray[np.bool_] | None:
        """Whether the interface ruptures at each step, where an edge is pushed."""
        if self.run.fault.loading != "edge":
            return None
        return self.fastest > RUPTURE * self.velocity

    @property
    def _long_enough(self) -> NDArray[np.bool_]:
        """Whether the patch has been longer than a few elements by each step."""
        rates = self.simulation["slip_rate"].values
        return self.step_time > long_after(self.run, self.x, self.time, rates)

    @property
    def drop_times(self) -> Array:
        """Times (s) at which the force's drop starts, is steep and is complete, (3,).

        Raises
        ------
        ValueError
            If the run has no event.
        """
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

    @property
    def threshold(self) -> float:
        """Slip rate (m/s) at the edge of the patch."""
        return self.settings.edge_threshold * self.velocity

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
