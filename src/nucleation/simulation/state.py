"""The block at one instant: all that the next step takes from the past.

The present and the previous displacement and velocity (two levels for BDF2), and the last interface
values, from which the next ones are extrapolated.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..fem.block import Field

Array = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class State:
    """The block at one instant; interface arrays are over the nodes 0..n_x, newest first.

    ``past_times`` (s), ``past_slip_rates`` (m/s), ``past_log_states`` and ``past_w`` (m, w_x at
    the nodes 1..n_x) hold up to three instants, the first of them the present one.
    ``displacement`` is (w_x, u_y) of the body, with u_x = V t + w_x.
    """

    displacement: Field
    velocity: Field
    previous_displacement: Field
    previous_velocity: Field
    past_times: Array
    past_slip_rates: Array
    past_log_states: Array
    past_w: Array
    momentum: float  # kg/s, along x, of the velocity w_t
    previous_momentum: float
    edge_error: float  # of the edge's prediction in the step that led here, relative

    @classmethod
    def beginning(
        cls, displacement: Field, velocity: Field, slip_rate: Array, log_state: Array, w: Array,
        momentum: float,
    ) -> State:  # fmt: skip
        """The state at time zero, without a past."""
        return cls(
            displacement, velocity, displacement, velocity, np.zeros(1), slip_rate[None],
            log_state[None], w[None], momentum, momentum, np.inf,
        )  # fmt: skip

    def to_arrays(self) -> dict[str, Array]:
        """The state as plain arrays by name, to be stored; exact."""
        arrays = {}  # type: ignore[var-annotated]
        for entry in dataclasses.fields(self):
            value = getattr(self, entry.name)
            if isinstance(value, Field):
                arrays |= {f"{entry.name}_modes": value.modes, f"{entry.name}_edge": value.edge}
            else:
                arrays[entry.name] = np.asarray(value)
        return arrays

    @classmethod
    def from_arrays(cls, arrays: Mapping[str, Array]) -> State:
        """The inverse of :meth:`to_arrays`."""
        values: dict[str, Any] = {}
        for entry in dataclasses.fields(cls):
            name = entry.name
            if entry.type == "Field":
                values[name] = Field(arrays[f"{name}_modes"], arrays[f"{name}_edge"])
            else:
                values[name] = float(arrays[name]) if entry.type == "float" else arrays[name]
        return cls(**values)

    @property
    def time(self) -> float:
        """Present time (s)."""
        return float(self.past_times[0])

    @property
    def last_step(self) -> float:
        """Length of the step that led here (s), zero at the start."""
        return float(self.past_times[0] - self.past_times[min(1, self.past_times.size - 1)])


def pushed(newest: Array | float, past: Array) -> Array:
    """The newest value before the past ones, of which two are kept."""
    result = np.empty((min(past.shape[0], 2) + 1, *past.shape[1:]))
    result[0], result[1:] = newest, past[:2]
    return result
