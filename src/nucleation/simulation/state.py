"""The state of a run: everything that the next step takes from the past.

The body's last motions, as many as the scheme asks for, and the last values of the interface's
fields, from which the next ones are extrapolated.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np

from ..fem.grid import Field, Motion
from ..types import Array


@dataclasses.dataclass(frozen=True)
class State:
    """A body and its interface at one instant; past values are newest first, the present included.

    ``past_times`` (s), ``past_slip_rates`` (m/s) and ``past_log_states`` over the nodes 0..n_x, and
    ``past_w`` (m, the slip less that of the driven edge) over the nodes 1..n_x.
    """

    motions: tuple[Motion, ...]
    past_times: Array
    past_slip_rates: Array
    past_log_states: Array
    past_w: Array
    body_memory: Array  # the body's own, see nucleation.fem.condensed

    @classmethod
    def beginning(
        cls, motion: Motion, slip_rate: Array, log_state: Array, w: Array, body_memory: Array
    ) -> State:
        """The state at time zero, without a past."""
        return cls((motion,), np.zeros(1), slip_rate[None], log_state[None], w[None], body_memory)

    def to_arrays(self) -> dict[str, Array]:
        """The state as plain arrays by name, to be stored; exact."""
        arrays = {name: np.asarray(getattr(self, name)) for name in PLAIN}
        for i, motion in enumerate(self.motions):
            arrays |= motion.to_arrays(f"motion_{i}")
        return arrays

    @classmethod
    def from_arrays(cls, arrays: Mapping[str, Array]) -> State:
        """The inverse of :meth:`to_arrays`."""
        number = sum(name.startswith("motion_") and name.endswith("_momentum") for name in arrays)
        motions = tuple(Motion.from_arrays(f"motion_{i}", arrays) for i in range(number))
        return cls(motions, **{name: arrays[name] for name in PLAIN})

    @property
    def time(self) -> float:
        """Present time (s)."""
        return float(self.past_times[0])

    @property
    def last_step(self) -> float:
        """Length of the step that led here (s), zero at the start."""
        return float(self.past_times[0] - self.past_times[min(1, self.past_times.size - 1)])

    @property
    def displacement(self) -> Field:
        """(w_x, u_y) of the body (m), with u_x = U(t) + w_x."""
        return self.motions[0].displacement

    @property
    def velocity(self) -> Field:
        """Its rate (m/s)."""
        return self.motions[0].velocity

    @property
    def momentum(self) -> float:
        """Momentum along x of the velocity w_t (kg/s)."""
        return self.motions[0].momentum


PLAIN = tuple(field.name for field in dataclasses.fields(State) if field.name != "motions")


def pushed(newest: Array | float, past: Array, most: int) -> Array:
    """The newest value before the past ones, `most` in all."""
    kept = past[: most - 1]
    result = np.empty((kept.shape[0] + 1, *past.shape[1:]))
    result[0], result[1:] = newest, kept
    return result
