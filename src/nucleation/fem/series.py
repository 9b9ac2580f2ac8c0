"""Two elastic bodies in series on their common interface y = 0, mode by mode.

The lower body, ``-H2 <= y <= 0``, is stored mirrored, as if it were above the interface:
``y -> -y`` and ``u_y -> -u_y``. A field of both holds the levels of the upper body, then those of
the lower one. Seen from the driven edge of the upper body, ``w1 = u_x - U(t)`` above and
``w2 = u_x`` below. ``w = w1 - w2`` is the slip less that of the driven edge; both bodies have the
same ``u_y`` (no opening). Per mode, each body has a stiffness ``S = [[a, b], [b, c]]`` and a
reduced load r; the mirror changes the signs of b2 and of the y component of r2. Then

    (w1, u_y) = T^-1 [S2 (w, 0) + r1 + r2],    T = S1 + S2,
    (p, R) = S1 (w1, u_y) - r1 .

So ``D = (det S2 a1 + det S1 a2) / det T`` and ``N = (det S2 b1 + det S1 b2) / det T`` per mode; N
of identical bodies vanishes exactly.
"""

from typing import Any, Generic, TypeVar

import numpy as np

from ..types import Array
from . import kernels
from .condensed import ElasticBody
from .elimination import Elimination, SeparableOperator
from .grid import Components, Field, Motion, Terms
from .separable import SeparableBody

Layer = TypeVar("Layer", bound=SeparableBody)


class TwoBodies(ElasticBody, Generic[Layer]):
    """Two bodies with the same nodes and modes along x: a driven one above a mirrored one.

    Parameters
    ----------
    upper, lower : Layer
        The bodies.

    Raises
    ------
    ValueError
        If their elements along x differ.
    """

    def __init__(self, upper: Layer, lower: Layer) -> None:
        one = upper.grid
        other = lower.grid
        if (one.n_x, one.length) != (other.n_x, other.length):
            raise ValueError(
                f"a pair needs the same elements along x: the upper body has n_x = {one.n_x} "
                f"on {one.length:g} m, the lower one n_x = {other.n_x} on {other.length:g} m"
            )
        self.upper = upper
        self.lower = lower
        self.grid = one
        self.grid_below = other
        self.far_side = upper.far_side
        self.free_nodes = upper.free_nodes
        self.crossing_time = max(upper.crossing_time, lower.crossing_time)
        self.total_mass = upper.total_mass  # the lower body does not move with the edge

    @property
    def no_memory(self) -> Array:
        """The memory before the first step, that of the upper body."""
        return self.upper.no_memory

    def on_all_nodes(self, values: Array, driven: float) -> Array:
        """Add the value of the driven edge's node.

        Parameters
        ----------
        values, driven
            As in :meth:`.condensed.ElasticBody.on_all_nodes`.
        """
        return self.upper.on_all_nodes(values, driven)

    def parts(self, field: Field) -> tuple[Field, Field]:
        """Return views of a field of the pair: the upper body's, the lower body's mirrored."""
        levels = self.grid.n_y + 1
        upper = Field(field.modes[:levels], field.edge[:levels])
        lower = Field(field.modes[levels:], field.edge[levels:])
        return upper, lower

    def joined(self, upper: Field, lower: Field) -> Field:
        """Join the fields of the two bodies, the lower one's mirrored.

        Parameters
        ----------
        upper, lower : Field
            Fields of the bodies.

        Returns
        -------
        Field
            The field of the pair.
        """
        modes = np.concatenate((upper.modes, lower.modes))
        edge = np.concatenate((upper.edge, lower.edge))
        return Field(modes, edge)

    def zero_field(self) -> Field:
        """Return a field of zeros."""
        return self.joined(self.upper.zero_field(), self.lower.zero_field())

    def translation_load(self, acceleration: float) -> Field:
        """Return the inertia (N/m) against an acceleration (m/s^2) of the upper body."""
        upper = self.upper.translation_load(acceleration)
        return self.joined(upper, self.lower.zero_field())

    def inertia_load(
        self,
        s: float,
        terms: Terms,
        load: Field | None = None,
    ) -> Field:
        """Add the inertia of fields to a load.

        Parameters
        ----------
        s, terms, load
            As in :meth:`.condensed.ElasticBody.inertia_load`.
        """
        above = []
        below = []
        for coefficient, field in terms:
            upper, lower = self.parts(field)
            above.append((coefficient, upper))
            below.append((coefficient, lower))
        load_above, load_below = (None, None) if load is None else self.parts(load)
        return self.joined(
            self.upper.inertia_load(s, above, load_above),
            self.lower.inertia_load(s, below, load_below),
        )

    def at_rest(self, displacement: Field, velocity: float) -> Motion:
        """Return the motion of the pair at rest.

        Parameters
        ----------
        displacement, velocity
            As in :meth:`.condensed.ElasticBody.at_rest`.
        """
        above, _ = self.parts(displacement)
        own = self.upper.at_rest(above, velocity)
        rates = self.joined(own.velocity, self.lower.zero_field())
        return Motion(displacement, rates, own.momentum)

    def momentum_x(self, velocity: Field) -> float:
        """Return the upper body's momentum along x (kg/s per unit depth) at a velocity (m/s)."""
        above, _ = self.parts(velocity)
        return self.upper.momentum_x(above)

    def nodal_values(self, field: Field) -> Components:
        """Return nodal w_x and u_y of the upper body, each of shape (n_y + 1, n_x + 1)."""
        above, _ = self.parts(field)
        return self.upper.nodal_values(above)

    def nodal_values_below(self, field: Field) -> Components:
        """Return nodal u_x and u_y of the lower body, its levels from the interface down."""
        _, below = self.parts(field)
        x, y = self.lower.nodal_values(below)
        return x, -y


class SeriesOperator(Elimination):
    """``K + s M`` of two bodies for one ``s`` (1/s^2), with ``s = 0`` for statics.

    Parameters
    ----------
    body : TwoBodies
        The bodies.
    s : float
        Factor of the mass matrix (1/s^2).
    upper, lower : SeparableOperator
        Their operators.

    Attributes
    ----------
    levels_above : int
        Levels of the upper body; in a field, those of the lower one follow them.
    compliance : ndarray
        ``T^-1``: xx, xy, yy, (3, n_x).
    forces : ndarray
        ``S1 T^-1``, then ``S2 T^-1``: xx, xy, yx, yy of each, (8, n_x).
    by_slip : ndarray
        (w1, u_y) per unit of w, (2, n_x).
    """

    body: TwoBodies[Any]

    def __init__(
        self,
        body: TwoBodies[Any],
        s: float,
        upper: SeparableOperator,
        lower: SeparableOperator,
    ) -> None:
        self.body = body
        self.s = s
        self.upper = upper
        self.lower = lower
        self.along_x = body.upper
        self.levels_above = body.grid.n_y + 1
        a1, b1, c1 = upper.pivot
        a2, b2, c2 = lower.pivot
        b2 = -b2  # by the mirror
        # not compiled: with fused products, identical bodies would not decouple exactly
        det1 = a1 * c1 - b1 * b1
        det2 = a2 * c2 - b2 * b2
        det = det1 + det2 + a1 * c2 + a2 * c1 - 2.0 * (b1 * b2)
        stiffness = det2 * a1 + det1 * a2
        coupling = det2 * b1 + det1 * b2
        self.modal = np.array([stiffness, coupling]) / det
        adjugate = np.array(
            [
                c1 + c2,
                -(b1 + b2),
                a1 + a2,
            ]
        )
        self.compliance = adjugate / det
        xx, xy, yy = self.compliance
        self.forces = np.array(
            [
                a1 * xx + b1 * xy,
                a1 * xy + b1 * yy,
                b1 * xx + c1 * xy,
                b1 * xy + c1 * yy,
                a2 * xx + b2 * xy,
                a2 * xy + b2 * yy,
                b2 * xx + c2 * xy,
                b2 * xy + c2 * yy,
            ]
        )
        self.by_slip = np.array(
            [
                xx * a2 + xy * b2,
                xy * a2 + yy * b2,
            ]
        )

    @property
    def megabytes(self) -> float:
        """Memory that the operator holds once all of its parts are in use (MB)."""
        return self.upper.megabytes + self.lower.megabytes

    def swept_down(self, load: Field, edge: Array) -> Array:
        """Sweep a load (N/m) down to the interface in both bodies, with given edge values (m).

        Parameters
        ----------
        load, edge
            As in :meth:`.elimination.Elimination.swept_down`.
        """
        modes = np.empty_like(load.modes)
        above, below = self.body.parts(load)
        into_above, into_below = self.body.parts(Field(modes, edge))
        self.upper.swept_down(above, into_above.edge, into_above.modes)
        self.lower.swept_down(below, into_below.edge, into_below.modes)
        return modes

    def reduced(self, swept: Array) -> tuple[Array, Array]:
        """Return the load that is held, and the displacement of the interface, at w = 0."""
        held = np.empty_like(self.modal)
        start = np.empty_like(self.modal)
        kernels.load_couple(
            self.compliance,
            self.forces,
            swept[0],
            swept[self.levels_above],
            held,
            start,
        )
        return held, start

    def substitute_up(
        self,
        swept: Array,
        amplitudes: Array,
        start: Array | None,
    ) -> None:
        """Sweep back from the interface in place.

        Parameters
        ----------
        swept, amplitudes, start
            As in :meth:`.elimination.Elimination.substitute_up`.
        """
        assert start is not None
        above = swept[: self.levels_above]
        below = swept[self.levels_above :]
        above[0] = start + self.by_slip * amplitudes
        below[0, 0] = above[0, 0] - amplitudes
        below[0, 1] = -above[0, 1]
        self.upper.substitute(above)
        self.lower.substitute(below)
