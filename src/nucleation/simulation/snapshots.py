"""Snapshots of the bodies of a run, taken when the slip rate first exceeds some values."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from ..types import Array, Arrays
from .state import State
from .step import Dynamics

RATES = (3.0, 30.0, 300.0, 3000.0)  # a snapshot when max v / V first exceeds these
FIELDS = ("displacement_x", "displacement_y", "velocity_x", "velocity_y")


class Snapshots:
    """Collects displacement and velocity in the bodies of one run.

    Parameters
    ----------
    dynamics : Dynamics
        Body and drive of the run.
    """

    def __init__(self, dynamics: Dynamics) -> None:
        self._grid = dynamics.grid
        self._body = dynamics.body
        self._drive = dynamics.drive
        self._times: list[float] = []
        self._above: list[Array] = []  # of FIELDS
        self._below: list[Array] = []  # at the same times, in a second body
        self._next_rate = 0

    def take(self, state: State, fastest: float) -> None:
        """Take a snapshot of the initial state, or if it is time to.

        Parameters
        ----------
        state : State
        fastest : float
            Largest slip rate (m/s).
        """
        velocity = self._drive.velocity
        exceeded = sum(fastest > rate * velocity for rate in RATES[self._next_rate :])
        if self._times and not exceeded:
            return
        self._next_rate += exceeded
        self._times.append(state.time)
        self._above.append(self._fields_above(state))
        if self._body.grid_below is not None:
            self._below.append(self._fields_below(state))

    def _fields_above(self, state: State) -> Array:
        """Displacement and velocity at the nodes, shape (4, n_y + 1, n_x + 1)."""
        edge = self._drive.at(state.time)
        x, y = self._body.nodal_values(state.displacement)
        rate_x, rate_y = self._body.nodal_values(state.velocity)
        fields = [
            x + edge.displacement,
            y,
            rate_x + edge.velocity,
            rate_y,
        ]
        return np.array(fields)

    def _fields_below(self, state: State) -> Array:
        """The same in a second body, its levels from the interface down."""
        x, y = self._body.nodal_values_below(state.displacement)
        rate_x, rate_y = self._body.nodal_values_below(state.velocity)
        return np.array([x, y, rate_x, rate_y])

    def to_arrays(self) -> Arrays:
        """The snapshots as plain arrays by name, to be stored; exact."""
        return {
            "snapshot_times": np.array(self._times),
            "snapshots": np.array(self._above),
            "snapshots_below": np.array(self._below),
            "next_snapshot_rate": np.array(self._next_rate),
        }

    def restore(self, arrays: Mapping[str, Array]) -> None:
        """The inverse of :meth:`to_arrays`."""
        self._times = arrays["snapshot_times"].tolist()
        self._above = list(arrays["snapshots"])
        self._below = list(arrays["snapshots_below"])
        self._next_rate = int(arrays["next_snapshot_rate"])

    def dataset(self) -> xr.Dataset:
        """The fields on (snapshot, y, x), and those of a second body on (snapshot, second_y, x)."""
        bodies = xr.Dataset(coords={"y": self._grid.y, "x": self._grid.x})
        bodies["snapshot_time"] = "snapshot", self._times
        above = np.array(self._above)
        for i, name in enumerate(FIELDS):
            bodies[name] = ("snapshot", "y", "x"), above[:, i]
        grid = self._body.grid_below
        if grid is None:
            return bodies
        bodies = bodies.assign_coords(second_y=-grid.y)
        below = np.array(self._below)
        for i, name in enumerate(FIELDS):
            bodies[f"second_{name}"] = ("snapshot", "second_y", "x"), below[:, i]
        return bodies
