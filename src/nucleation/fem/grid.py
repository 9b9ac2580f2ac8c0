"""The structured mesh of bilinear quadrilaterals, fields on it, and the motion at one instant."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np

from ..model.parameters import Geometry, Mesh
from ..types import Array


@dataclasses.dataclass(frozen=True)
class Grid:
    """A rectangle ``[0, length] x [0, height]`` of ``n_x`` by ``n_y`` elements.

    The spacing is uniform along x. Along y the element heights grow geometrically from the
    interface y = 0 to the top; the top one is ``grading`` times as high as the bottom one. If it is
    periodic, node 0 is node n_x.
    """

    length: float
    height: float
    n_x: int
    n_y: int
    grading: float = 1.0
    periodic: bool = False

    @classmethod
    def of(cls, geometry: Geometry, mesh: Mesh) -> Grid:
        """The grid of a simulation's block."""
        return cls(geometry.length, geometry.height, mesh.n_x, mesh.n_y, mesh.grading)

    @property
    def dx(self) -> float:
        """Node spacing along x (m)."""
        return self.length / self.n_x

    @property
    def own(self) -> slice:
        """The nodes 0..n_x without the one that only repeats another."""
        return slice(1 if self.periodic else 0, None)

    @cached_property
    def x(self) -> Array:
        """Node positions along x (m), shape (n_x + 1,)."""
        return np.linspace(0.0, self.length, self.n_x + 1)

    @cached_property
    def y(self) -> Array:
        """Node positions along y (m), shape (n_y + 1,)."""
        heights = self.grading ** (np.arange(self.n_y) / max(self.n_y - 1, 1))
        nodes = np.concatenate(([0.0], np.cumsum(heights)))
        return self.height * nodes / nodes[-1]

    @cached_property
    def nodal_lengths(self) -> Array:
        """Length of interface that each interface node stands for (m), shape (n_x + 1,)."""
        lengths = np.full(self.n_x + 1, self.dx)
        if not self.periodic:
            lengths[[0, -1]] *= 0.5
        return lengths


@dataclasses.dataclass(frozen=True)
class Field:
    """A displacement-like field: mode amplitudes and the values of u_y on the right edge.

    `modes` has shape (n_y + 1, 2, n_x): level from the interface up, component (x, y), mode.
    `edge` has shape (n_y + 1,); ``edge[0]`` is always zero.
    """

    modes: Array
    edge: Array

    def plus(self, other: Field) -> Field:
        """The sum of two fields."""
        return Field(self.modes + other.modes, self.edge + other.edge)

    def times(self, factor: float) -> Field:
        """The field times a number."""
        return Field(factor * self.modes, factor * self.edge)

    def to_arrays(self, name: str) -> dict[str, Array]:
        """The field as plain arrays, their names beginning with `name`."""
        return {f"{name}_modes": self.modes, f"{name}_edge": self.edge}

    @classmethod
    def from_arrays(cls, name: str, arrays: Mapping[str, Array]) -> Field:
        """The inverse of :meth:`to_arrays`."""
        return cls(arrays[f"{name}_modes"], arrays[f"{name}_edge"])


Terms = Sequence[tuple[float, Field]]


@dataclasses.dataclass(frozen=True)
class Motion:
    """Where a body is at one instant, and how fast: (w_x, u_y) with u_x = U(t) + w_x."""

    displacement: Field  # m
    velocity: Field  # m/s
    momentum: float  # kg/s, along x, of the velocity w_t

    def to_arrays(self, name: str) -> dict[str, Array]:
        """The motion as plain arrays, their names beginning with `name`; exact."""
        return {
            **self.displacement.to_arrays(f"{name}_displacement"),
            **self.velocity.to_arrays(f"{name}_velocity"),
            f"{name}_momentum": np.asarray(self.momentum),
        }

    @classmethod
    def from_arrays(cls, name: str, arrays: Mapping[str, Array]) -> Motion:
        """The inverse of :meth:`to_arrays`."""
        return cls(
            Field.from_arrays(f"{name}_displacement", arrays),
            Field.from_arrays(f"{name}_velocity", arrays),
            float(arrays[f"{name}_momentum"]),
        )


Motions = tuple[Motion, ...]
"""Of a body at some instants, the newest first."""
