"""The state of a run: all past values from which the next step is computed.

These are the last motions of the body and the last values of the interface's fields, as many as
the scheme uses.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np

from ..fem.grid import Field, Motion
from ..types import Array, Arrays


@dataclasses.dataclass(frozen=True)
class State:
    """A body and its interface at one instant, with their past values.

    The past includes the present, and begins with it.
    """

    motions: tuple[Motion, ...]
    past_times: Array  # s
    past_slip_rates: Array  # m/s, (past, nodes 0..n_x)
    past_log_states: Array  # (past, nodes 0..n_x)
    past_w: Array  # m, slip less that of the driven edge, (past, nodes 1..n_x)
    edge_error: float = np.inf  # relative, of the right edge's values as foreseen

    @classmethod
    def beginning(
        cls,
        motion: Motion,
        slip_rate: Array,
        log_state: Array,
        w: Array,
    ) -> State:
        """The state at time zero, without a past.

        Parameters
        ----------
        motion : Motion
            Motion of the body.
        slip_rate, log_state : ndarray, shape (n_x + 1,)
            Slip rates (m/s) and log(phi) at the nodes 0..n_x.
        w : ndarray, shape (n_x,)
            Slip less that of the driven edge (m), at the nodes 1..n_x.

        Returns
        -------
        State
        """
        return cls((motion,), np.zeros(1), slip_rate[None], log_state[None], w[None])

    def to_arrays(self) -> Arrays:
        """The exact state as plain arrays by name, to be stored."""
        arrays = {name: np.asarray(getattr(self, name)) for name in (*_PLAIN, "edge_error")}
        for i, motion in enumerate(self.motions):
            arrays |= motion.to_arrays(f"motion_{i}")
        return arrays

    @classmethod
    def from_arrays(cls, arrays: Mapping[str, Array]) -> State:
        """The inverse of :meth:`to_arrays`."""
        motions: list[Motion] = []
        while f"motion_{len(motions)}_momentum" in arrays:
            motions.append(Motion.from_arrays(f"motion_{len(motions)}", arrays))
        plain = {name: arrays[name] for name in _PLAIN}
        return cls(tuple(motions), **plain, edge_error=float(arrays["edge_error"]))

    @property
    def time(self) -> float:
        """Present time (s)."""
        return float(self.past_times[0])

    @property
    def last_step(self) -> float:
        """Length of the last step (s), zero at the start."""
        before = min(1, self.past_times.size - 1)
        return float(self.past_times[0] - self.past_times[before])

    @property
    def displacement(self) -> Field:
        """(w_x, u_y) of the body (m), with u_x = U(t) + w_x."""
        return self.motions[0].displacement

    @property
    def velocity(self) -> Field:
        """Rate (m/s) of the displacement."""
        return self.motions[0].velocity

    @property
    def momentum(self) -> float:
        """Momentum along x of the velocity w_t (kg/s)."""
        return self.motions[0].momentum


_PLAIN = ("past_times", "past_slip_rates", "past_log_states", "past_w")


def pushed(
    newest: Array | float,
    past: Array,
    most: int,
) -> Array:
    """Put the newest value before the past ones and drop the oldest.

    Parameters
    ----------
    newest : ndarray or float
    past : ndarray, shape (past, ...)
        Past values, newest first.
    most : int
        Largest number of values that are kept.

    Returns
    -------
    ndarray, shape (at most `most`, ...)
    """
    kept = past[: most - 1]
    result = np.empty((kept.shape[0] + 1, *past.shape[1:]))
    result[0] = newest
    result[1:] = kept
    return result
