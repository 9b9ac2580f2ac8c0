"""Manufactured solutions of two bodies: the same loads on either, friction between them.

The contact's forces on the upper body are those of one body: friction and the normal force that
belong to its own stress, less the applied traction. The lower body is given what its own stress
asks for beyond the opposite of those. Its displacement is stated upside down, as the solver holds
it: y goes up from the interface and u_y with it.
"""

from __future__ import annotations

import numpy as np

from ...fem.bodies import body_of
from ...fem.field import Field, Motion
from ...fem.pair import Pair
from ...model.parameters import Parameters
from ...simulation.state import State
from ...simulation.step import Dynamics
from ...stepping.scheme import BDF
from ...types import Array
from .dynamics import ManufacturedFriction, block_field
from .fields import Displacement, Term
from .loads import Loads


class ManufacturedPair(ManufacturedFriction):
    """Two blocks with rate-and-state friction between them, and a chosen state variable.

    Parameters
    ----------
    parameters : with a second block.
    exact, below : displacements of both, the lower one's upside down, with ``u_y`` of either the
        other's opposite on the interface.
    log_state, lumped : of :class:`ManufacturedFriction`.
    """

    def __init__(
        self, parameters: Parameters, exact: Displacement, below: Displacement,
        log_state: tuple[Term, ...], lumped: bool,
    ) -> None:  # fmt: skip
        super().__init__(parameters, exact, log_state, lumped)
        pair = body_of(parameters)
        if not isinstance(pair, Pair):
            raise ValueError("a second block is needed")
        self.body, self.below = pair, below
        self.loads_below = Loads(pair.lower.grid, below)
        scheme = BDF(pair.crossing_time)
        self.dynamics = Dynamics(pair, self.interface(), self, scheme)

    def load(self, time: float) -> Field:
        """The load (N/m) of both displacements and of the applied traction at a time (s)."""
        above, below = self.loads.nodal(time), self.loads_below.nodal(time)
        applied = self.applied_force(time)
        above[0, 0] += applied
        shear, normal = (-self.loads.along_x @ s for s in self.loads.interface_stress(time))
        own = [-self.loads.along_x @ s for s in self.loads_below.interface_stress(time)]
        below[0, 0] += own[0] + (shear - applied)
        below[1, 0] += own[1] - normal
        return self.body.joined(self.loads.field(above), self.loads_below.field(below))

    # -- exact values ---------------------------------------------------------------------------

    def nodal_exact_below(self, time: float, **orders: int) -> Array:
        """Exact u_x and u_y (m) of the lower block upside down, or a derivative."""
        grid = self.body.lower.grid
        x, y = grid.x[None], grid.y[:, None]
        return np.array([self.below.value(c, x, y, time, **orders) for c in (0, 1)])

    def exact_w(self, time: float) -> Array:
        """Exact w = w1 - w2 (m) at the interface's nodes 1..n_x."""
        x = self.grid.x[1:]
        return super().exact_w(time) - self.below.value(0, x, np.zeros_like(x), time)

    def exact_slip_rate(self, x: Array, time: float, by_t: int = 0) -> Array:
        """Exact slip rate (m/s) at x (m), or its derivative in time."""
        own = self.below.value(0, x, np.zeros_like(x), time, by_t=1 + by_t)
        return super().exact_slip_rate(x, time, by_t) - own

    def exact_motion(self, time: float) -> Motion:
        """The motion of both blocks at a time (s)."""
        u, rate = (
            self.body.joined(
                block_field(self.body.upper, self.nodal_exact(time, by_t=order)),
                block_field(self.body.lower, self.nodal_exact_below(time, by_t=order)),
            )
            for order in (0, 1)
        )
        return Motion(u, rate, self.body.momentum_x(rate))

    def displacement_error_below(self, state: State) -> float:
        """Root mean square over the lower block's area of the nodal error (m)."""
        x, y = self.body.nodal_values_below(state.displacement)
        error = np.array([x, -y]) - self.nodal_exact_below(state.time)
        return self.loads_below.mean_over_area(error)
