"""A body condensed on its interface, for steps within which waves cross it many times.

Such waves have died away: the field follows the slip and the loads at once. It is the static one
but for inertia, which acts as if all moved with it (Guyan, AIAA J. 3, 380, 1965). Of the body's
past, slip and loads are enough; no field is stored. With ``D(s)`` of ``K + s M`` the forces are

    D(s) w - (D(s) - D(0)) w*,    w* = sum_i c_i (w_i + beta dw_i/dt),

and alike for the loads; without acceleration w would be w*. Terms of fourth order are missing, in
the time that a wave needs to cross the body over that within which w changes.
"""

from collections.abc import Callable, Sequence

import numpy as np

from ..types import Array
from .body import Body
from .grid import Components, Field, Motion
from .operator import Forces, Operator

SMALL = 1e-5  # s times a crossing squared, to which forces are linear in s


class CondensedBody:
    """A body that is held, under some loads (N/m) times factors."""

    def __init__(
        self, body: Body, loads: Sequence[Field], operator: Callable[[float], Operator]
    ) -> None:
        """`operator` is ``K + s M`` by s (1/s^2)."""
        self._body = body
        self._loads = loads
        self._nothing = np.zeros(body.modes.n_x)
        self._statics = operator(0.0)
        self._held = self._forces(self._statics)
        s = SMALL / (body.crossing_time or 1.0) ** 2  # without density any will do
        moving = self._forces(operator(s))
        # of accelerated factors (N/m per 1/s^2)
        self._inertia = [(one - other) / s for one, other in zip(moving, self._held, strict=True)]
        fields = [self._field(self._nothing, one) for one in np.eye(len(loads))]
        works = [[body.work(load, field) for field in fields] for load in loads]
        self._compliance = np.array(works)

    def _forces(self, operator: Operator) -> Components:
        """Forces (N/m) that hold the interface at w = 0 under each load."""
        found = [operator.respond(load, self._nothing) for load in self._loads]
        tangential = np.array([one.tangential for one in found])
        return tangential, np.array([one.normal for one in found])

    def works(self, w: Array, factors: Array) -> Array:
        """Work (J/m) of each load times one on the field, by reciprocity."""
        return self._compliance @ factors - self._held[0] @ w

    def respond(
        self, operator: Operator, w: Array, factors: Array, straight: Array, steady: Array
    ) -> Forces:
        """The forces that hold the interface at w (m) under the loads at the end of a step.

        Without acceleration w would be `straight` (m) and the factors `steady`.
        """
        acceleration = operator.s * (factors - steady)
        found = []
        for moved, static, held, inertia in zip(
            operator.apply(w - straight),
            self._statics.apply(straight),
            self._held,
            self._inertia,
            strict=True,
        ):
            of_loads = factors @ held + acceleration @ inertia
            found.append(moved + static + of_loads)
        return Forces(w, *found)

    def condensed(self, motion: Motion) -> Motion:
        """The motion of the interface alone."""
        reduced = []
        for field in (motion.displacement, motion.velocity):
            above, *below = (part.modes[0, 0] for part in self._body.parts(field))
            slip = above - sum(below)
            reduced.append(Field(self._body.modes.sine_values(slip), np.empty(0)))
        displacement, velocity = reduced
        return motion._replace(displacement=displacement, velocity=velocity)

    def expanded(self, motion: Motion) -> Motion:
        """The motion of the field that follows that of the interface."""
        displacement = self._field(motion.displacement.modes, motion.factors)
        velocity = self._field(motion.velocity.modes, motion.factor_rates)
        return motion._replace(displacement=displacement, velocity=velocity)

    def _field(self, w: Array, factors: Array) -> Field:
        load = self._body.combined(self._loads, factors)
        return self._statics.balance(self._statics.respond(load, w), w)[0]
