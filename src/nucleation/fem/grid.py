"""The structured mesh of bilinear quadrilaterals, fields on it, and the motion at one instant."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np

from ..model.parameters import Geometry, Mesh
from ..types import Array

Components = tuple[Array, Array]
"""Values along x and along y, or the tangential and the normal component."""


@dataclasses.dataclass(frozen=True)
class Grid:
    """A rectangle ``[0, length] x [0, height]`` of ``n_x`` by ``n_y`` elements.

    The spacing is uniform along x. Along y the element heights grow geometrically from the
    interface y = 0 to the top.

    Parameters
    ----------
    length, height : float
        Size of the rectangle (m).
    n_x, n_y : int
        Number of elements along x and y.
    grading : float
        Height of the top row of elements over that of the bottom row.
    periodic : bool
        Whether node 0 is node n_x.
    """

    length: float
    height: float
    n_x: int
    n_y: int
    grading: float = 1.0
    periodic: bool = False

    @classmethod
    def of(cls, geometry: Geometry, mesh: Mesh) -> Grid:
        """Make the grid of a simulation's block.

        Parameters
        ----------
        geometry : Geometry
            Height and length of the block.
        mesh : Mesh
            Number of elements and their grading.

        Returns
        -------
        Grid
        """
        return cls(
            geometry.length,
            geometry.height,
            mesh.n_x,
            mesh.n_y,
            mesh.grading,
        )

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
        heights = self.grading**row
        nodes = np.concatenate(([0.0], np.cumsum(heights)))
        return self.height * nodes / nodes[-1]

    @cached_property
    def nodal_lengths(self) -> Array:
        """Length of the interface that belongs to each node (m), shape (n_x + 1,)."""
        lengths = np.full(self.n_x + 1, self.dx)
        if not self.periodic:
            lengths[[0, -1]] *= 0.5
        return lengths


@dataclasses.dataclass(frozen=True)
class Field:
    """A displacement, a velocity or a load: mode amplitudes, and values on the right edge.

    Parameters
    ----------
    modes : ndarray
        Amplitudes, shape (n_y + 1, 2, n_x): level from the interface up, component (x, y), mode.
    edge : ndarray
        Values of u_y on the right edge, shape (n_y + 1,). The first one is zero in one body.
    """

    modes: Array
    edge: Array

    def plus(self, other: Field) -> Field:
        """Return the sum of two fields."""
        return Field(self.modes + other.modes, self.edge + other.edge)

    def times(self, factor: float) -> Field:
        """Return the field times a number."""
        return Field(factor * self.modes, factor * self.edge)

    def to_arrays(self, name: str) -> dict[str, Array]:
        """Return the field as plain arrays; their names begin with `name`."""
        return {
            f"{name}_modes": self.modes,
            f"{name}_edge": self.edge,
        }

    @classmethod
    def from_arrays(
        cls,
        name: str,
        arrays: Mapping[str, Array],
    ) -> Field:
        """Read a field from the arrays of :meth:`to_arrays`.

        Parameters
        ----------
        name : str
            Beginning of the names of its arrays.
        arrays : mapping
            Arrays by name; further ones are ignored.

        Returns
        -------
        Field
        """
        return cls(arrays[f"{name}_modes"], arrays[f"{name}_edge"])


Terms = Sequence[tuple[float, Field]]
"""Coefficients and fields of a linear combination."""


@dataclasses.dataclass(frozen=True)
class Motion:
    """Displacement and velocity of a body at one instant, ``u_x = U(t) + w_x``.

    Parameters
    ----------
    displacement : Field
        (w_x, u_y) in m.
    velocity : Field
        Rate of the displacement (m/s).
    momentum : float
        Momentum along x of that velocity (kg/s per unit depth).
    """

    displacement: Field
    velocity: Field
    momentum: float

    def to_arrays(self, name: str) -> dict[str, Array]:
        """Return the motion as plain arrays, without loss; their names begin with `name`."""
        displacement = self.displacement.to_arrays(f"{name}_displacement")
        velocity = self.velocity.to_arrays(f"{name}_velocity")
        momentum = {f"{name}_momentum": np.asarray(self.momentum)}
        return displacement | velocity | momentum

    @classmethod
    def from_arrays(
        cls,
        name: str,
        arrays: Mapping[str, Array],
    ) -> Motion:
        """Read a motion from the arrays of :meth:`to_arrays`.

        Parameters
        ----------
        name : str
            Beginning of the names of its arrays.
        arrays : mapping
            Arrays by name; further ones are ignored.

        Returns
        -------
        Motion
        """
        return cls(
            Field.from_arrays(f"{name}_displacement", arrays),
            Field.from_arrays(f"{name}_velocity", arrays),
            float(arrays[f"{name}_momentum"]),
        )


Motions = tuple[Motion, ...]
"""Motions of a body at some instants, the newest first."""
