"""The structured mesh of bilinear quadrilaterals."""

from __future__ import annotations

import dataclasses
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
