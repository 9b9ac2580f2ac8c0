"""Two elastic bodies in series on their common interface y = 0, mode by mode.

The lower body, ``-H2 <= y <= 0``, is stored mirrored, as one that stands on the interface:
``y -> -y`` and ``u_y -> -u_y``. A field of both holds the levels of the upper body, then those of
the lower one. Seen from the driven edge of the upper body, ``w1 = u_x - U(t)`` above and
``w2 = u_x`` below. With ``w = w1 - w2``, the slip less that of the driven edge, with one ``u_y``
for both (no opening) and the stiffness ``S = [[a, b], [b, c]]`` and the reduced load r of each body
per mode, b2 and the y of r2 with the sign that the mirror gives them,

    (w1, u_y) = T^-1 [S2 (w, 0) + r1 + r2],    T = S1 + S2,
    (p, R) = S1 (w1, u_y) - r1 .

So ``D = (det S2 a1 + det S1 a2) / det T`` and ``N = (det S2 b1 + det S1 b2) / det T`` per mode; N
of identical bodies vanishes exactly.
"""

from collections.abc import Sequence
from typing import Generic, NamedTuple, TypeVar

import numpy as np

from ..types import Array
from . import kernels
from .grid import Field, Grid, Motion, Motions, Terms
from .separable import SeparableBody, SeparableOperator, rate_of_change

Layer = TypeVar("Layer", bound=SeparableBody)


class Parts(NamedTuple):
    """Views of a pair's field: that of the upper body, that of the lower one, mirrored."""

    upper: Field
    lower: Field


class TwoBodies(Generic[Layer]):
    """Two bodies with the same nodes and modes along x: one driven, above, the other mirrored."""

    def __init__(self, upper: Layer, lower: Layer) -> None:
        one, other = upper.grid, lower.grid
        if (one.n_x, one.length) != (other.n_x, other.length):
            raise ValueError(
                f"a pair needs the same elements along x: the upper body has n_x = {one.n_x} "
                f"on {one.length:g} m, the lower one n_x = {other.n_x} on {other.length:g} m"
            )
        self.upper, self.lower, self.grid = upper, lower, one

    @property
    def grid_below(self) -> Grid:
        """The lower body's mesh, its levels from the interface down."""
        return self.lower.grid

    @property
    def crossing_time(self) -> float:
        """Time (s) in which shear waves cross the slower body."""
        return max(self.upper.crossing_time, self.lower.crossing_time)

    @property
    def no_memory(self) -> Array:
        """What it remembers before its first step: no error of the right edge's prediction."""
        return self.upper.no_memory

    @property
    def total_mass(self) -> float:
        """Mass (kg/m) that moves with the driven edge: the upper body's."""
        return self.upper.total_mass

    @property
    def free_nodes(self) -> int:
        """Number of the interface's nodes that friction moves."""
        return self.upper.free_nodes

    def on_all_nodes(self, values: Array, driven: float) -> Array:
        """Values at the free nodes and that of the driven edge's own node, at the nodes 0..n_x."""
        return self.upper.on_all_nodes(values, driven)

    def parts(self, field: Field) -> Parts:
        """The two bodies' fields in one of the pair, not copied."""
        n = self.grid.n_y + 1
        return Parts(Field(field.modes[:n], field.edge[:n]), Field(field.modes[n:], field.edge[n:]))

    def joined(self, upper: Field, lower: Field) -> Field:
        """The pair's field of two bodies' fields."""
        return Field(
            np.concatenate((upper.modes, lower.modes)), np.concatenate((upper.edge, lower.edge))
        )

    def zero_field(self) -> Field:
        """A field of zeros."""
        return self.joined(self.upper.zero_field(), self.lower.zero_field())

    def translation_load(self, acceleration: float) -> Field:
        """Inertia (N/m) against an acceleration (m/s^2) of the driven edge and the upper body."""
        return self.joined(self.upper.translation_load(acceleration), self.lower.zero_field())

    def inertia_load(self, s: float, terms: Terms, load: Field | None = None) -> Field:
        """``load + s M sum_i c_i f_i`` for terms ``(c_i, f_i)``, as of either body."""
        coefficients = [c for c, _ in terms]
        split = [self.parts(field) for _, field in terms]
        loads = self.parts(load) if load is not None else (None, None)
        return self.joined(
            *(
                block.inertia_load(s, list(zip(coefficients, fields, strict=True)), own)
                for block, fields, own in zip(
                    (self.upper, self.lower), zip(*split, strict=True), loads, strict=True
                )
            )
        )

    def motion(
        self, past: Sequence[float], beta: float, displacement: Field, motions: Sequence[Motion]
    ) -> Motion:
        """The motion at a new displacement; its momentum is the driven body's alone."""
        velocity = rate_of_change(past, beta, displacement, motions)
        return Motion(displacement, velocity, self.momentum_x(velocity))

    def settled(self, motions: Motions, step: float, slid: float) -> Motions:
        """The motions themselves: unless one kind of pair says otherwise."""
        return motions

    def at_rest(self, displacement: Field, velocity: float) -> Motion:
        """The motion of the pair at rest, seen from the driven edge (velocity in m/s)."""
        own = self.upper.at_rest(self.parts(displacement).upper, velocity)
        rates = self.joined(own.velocity, self.lower.zero_field())
        return Motion(displacement, rates, own.momentum)

    def momentum_x(self, velocity: Field) -> float:
        """Momentum along x of the upper body's velocity field w_t (kg/s per unit depth)."""
        return self.upper.momentum_x(self.parts(velocity).upper)

    def sine_amplitudes(self, nodal: Array) -> Array:
        """Amplitudes of nodal values at i = 1..n_x (last axis) in the sine basis."""
        return self.upper.sine_amplitudes(nodal)

    def nodal_values(self, field: Field) -> tuple[Array, Array]:
        """Nodal w_x and u_y of the upper body, each of shape (n_y + 1, n_x + 1)."""
        return self.upper.nodal_values(self.parts(field).upper)

    def nodal_values_below(self, field: Field) -> tuple[Array, Array]:
        """Nodal u_x and u_y of the lower body, its levels from the interface down."""
        x, y = self.lower.nodal_values(self.parts(field).lower)
        return x, -y


class Series:
    """The stiffness of two bodies in series, per mode times 2/n_x (N/m per m).

    Attributes
    ----------
    modal : ndarray
        D and N, (2, n_x).
    compliance : ndarray
        ``T^-1``: xx, xy, yy, (3, n_x).
    forces : ndarray
        ``S1 T^-1``, then ``S2 T^-1``: xx, xy, yx, yy of each, (8, n_x).
    by_slip : ndarray
        (w1, u_y) per unit of w, (2, n_x).
    """

    def __init__(self, upper: SeparableOperator, lower: SeparableOperator) -> None:
        (a1, b1, c1), (a2, b2, c2) = upper.pivot, lower.pivot
        b2 = -b2  # by the mirror
        # not in a compiled loop: fused products would leave identical bodies a coupling
        det1, det2 = a1 * c1 - b1 * b1, a2 * c2 - b2 * b2
        det = det1 + det2 + a1 * c2 + a2 * c1 - 2.0 * (b1 * b2)
        self.modal = np.array([det2 * a1 + det1 * a2, det2 * b1 + det1 * b2]) / det
        self.compliance = np.array([c1 + c2, -(b1 + b2), a1 + a2]) / det
        xx, xy, yy = self.compliance
        self.forces = np.array(
            [
                row
                for a, b, c in ((a1, b1, c1), (a2, b2, c2))
                for row in (a * xx + b * xy, a * xy + b * yy, b * xx + c * xy, b * xy + c * yy)
            ]
        )
        self.by_slip = np.array([xx * a2 + xy * b2, xy * a2 + yy * b2])

    def loaded(self, upper: Array, lower: Array) -> tuple[Array, Array]:
        """What reduced loads of both bodies (2, n_x) do at zero slip.

        They take the first result from the forces on the upper body, and move the interface by the
        second.
        """
        held, start = np.empty_like(self.modal), np.empty_like(self.modal)
        kernels.load_couple(self.compliance, self.forces, upper, lower, held, start)
        return held, start

    def set_interface(self, upper: Array, lower: Array, amplitudes: Array, start: Array) -> None:
        """Write both bodies' displacement at amplitudes of w, beyond `start`, into their level 0.

        Arguments are modes (levels, 2, n_x) of the bodies, and :meth:`loaded`'s second result.
        """
        upper[0] = start + self.by_slip * amplitudes
        lower[0, 0], lower[0, 1] = upper[0, 0] - amplitudes, -upper[0, 1]
