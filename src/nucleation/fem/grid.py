"""The structured mesh of bilinear quadrilaterals, fields on it, and the motion at one instant."""

from __future__ import annotations

import dataclasses
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..types import Array

Components = tuple[Array, Array]
"""Values along x and along y, or the tangential and the normal component."""


@dataclasses.dataclass(frozen=True)
class Grid:
    """A rectangle ``[0, length] x [0, height]`` (m) of ``n_x`` by ``n_y`` elements.

    The spacing is uniform along x. Along y the element heights grow geometrically from the
    interface y = 0; `grading` is the height of the top row over that of the bottom row.
    """

    length: float
    height: float
    n_x: int
    n_y: int
    grading: float = 1.0
    periodic: bool = False  # whether node 0 is node n_x

    @property
    def dx(self) -> float:
        """Node spacing along x (m)."""
        return self.length / self.n_x

    @property
    def own(self) -> slice:
        """The nodes 0..n_x, without node 0 if that repeats node n_x."""
        return slice(1 if self.periodic else 0, None)

    @cached_property
    def x(self) -> Array:
        """Node positions along x (m), shape (n_x + 1,)."""
        return np.linspace(0.0, self.length, self.n_x + 1)

    @cached_property
    def y(self) -> Array:
        """Node positions along y (m), shape (n_y + 1,)."""
        row = np.arange(self.n_y) / max(self.n_y - 1, 1)
        nodes = np.concatenate(([0.0], np.cumsum(self.grading**row)))
        return self.height * nodes / nodes[-1]

    @cached_property
    def nodal_lengths(self) -> Array:
        """Length of the interface that belongs to each node (m), shape (n_x + 1,)."""
        lengths = np.full(self.n_x + 1, self.dx)
        if not self.periodic:
            lengths[[0, -1]] *= 0.5
        return lengths


class Field(NamedTuple):
    """A displacement, a velocity or a load of a body, its layers one after the other.

    `modes` are amplitudes, (levels, 2, n_x): level from the interface up, component, mode. `edge`
    are the values of u_y on the right edge, (levels,); the first one is zero in one layer.
    """

    modes: Array
    edge: Array

    def plus(self, other: Field) -> Field:
        """The sum of two fields."""
        return Field(self.modes + other.modes, self.edge + other.edge)

    def times(self, factor: float) -> Field:
        """The field times a number."""
        return Field(factor * self.modes, factor * self.edge)


class Motion(NamedTuple):
    """Displacement (m) and velocity (m/s) of a body at one instant, ``u_x = U(t) + w_x``.

    Of a condensed body `modes` of both are w (m) and its rate (m/s) at the nodes 1..n_x.
    """

    displacement: Field
    velocity: Field
    momentum: float  # along x, of that velocity (kg/s per unit depth)
    factors: Array  # of the loads on the body,
    factor_rates: Array  # 1/s, and their rates by the formula of the step

    @property
    def is_condensed(self) -> bool:
        """Whether the body is condensed on its interface."""
        return self.displacement.modes.ndim == 1
