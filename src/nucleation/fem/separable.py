"""Bodies whose finite-element equations separate along x: their common parts.

On a grid that is uniform along x the matrices of bilinear elements are sums of Kronecker products
of one-dimensional matrices. In modes of one angle theta per element each, the equations decouple:
one block-tridiagonal system along y for each mode. A subclass defines the modes and adds the terms
of the ends along x.
"""

from __future__ import annotations

from abc import abstractmethod

import numpy as np

from ..model.material import Material
from ..types import Array
from . import field_kernels, matrices
from .condensed import ElasticBody
from .grid import Components, Field, Grid, Motion, Terms

HELD = {
    "free": (False, False),
    "clamped": (True, True),
    "roller": (False, True),
    "velocity": (True, False),
}
"""Which of u_x and u_y are zero on the far side, by its boundary condition; the others are free."""


class SeparableBody(ElasticBody):
    """A layer of a material on a grid.

    Parameters
    ----------
    grid : Grid
        The mesh.
    material : Material
        Elastic moduli and density.
    theta : ndarray
        Angle of each mode per element, shape (modes,).
    x_integral : ndarray
        Integral along x of each mode of u_x (m), for the momentum, shape (modes,).
    edge_weights : ndarray
        Weight of each mode in the forces on an edge that has unknowns of its own, (3, modes).
    far_side : str
        Boundary condition of the far side, a key of :data:`HELD`.

    Attributes
    ----------
    mass, stiffness, derivative : ndarray
        The matrices along y (:mod:`.matrices`), shape (3, n_y + 1).
    modes : int
        Number of modes.
    mode_scale : float
        Factor 2/n_x of all loads and stiffnesses per mode.
    """

    def __init__(
        self,
        grid: Grid,
        material: Material,
        theta: Array,
        x_integral: Array,
        edge_weights: Array,
        far_side: str = "free",
    ) -> None:
        self.grid = grid
        self.material = material
        self.far_side = far_side
        self.crossing_time = grid.height / material.shear_wave_speed
        self.total_mass = material.density * grid.length * grid.height
        self.mode_scale = 2.0 / grid.n_x
        self.mass, self.stiffness, self.derivative = matrices.element_matrices(grid.y)
        self.row_sums = self.mass.sum(axis=0)
        dx = grid.dx
        self.x_stiffness = 4.0 * np.sin(theta / 2.0) ** 2 / dx
        self.x_mass = dx * (4.0 + 2.0 * np.cos(theta)) / 6.0
        self.sine = np.sin(theta)
        self.x_integral = x_integral
        self.edge_weights = edge_weights
        self.modes = theta.size
        self.free_nodes = theta.size

    @abstractmethod
    def sine_amplitudes(self, nodal: Array) -> Array:
        """Return the amplitudes of nodal values of u_x (last axis) at the free nodes."""

    @abstractmethod
    def sine_values(self, amplitudes: Array) -> Array:
        """Return the nodal values of amplitudes of u_x (last axis)."""

    @abstractmethod
    def cosine_values(self, amplitudes: Array) -> Array:
        """Return the nodal values of amplitudes of u_y (last axis)."""

    @abstractmethod
    def forces(
        self,
        stiffness: Array,
        amplitudes: Array,
        reduced: Array,
    ) -> Components:
        """Return the nodal forces of ``stiffness * amplitudes - reduced`` per mode.

        Parameters
        ----------
        stiffness : ndarray
            Tangential and normal stiffness per mode, times 2/n_x (N/m per m), (2, modes).
        amplitudes : ndarray
            Amplitudes of w (m), shape (modes,).
        reduced : ndarray
            The load reduced to the interface (N/m), shape (2, modes).

        Returns
        -------
        tangential, normal : ndarray
            Forces (N/m) at the free nodes, and at the nodes 0..n_x. At a free right edge the last
            normal force is the edge's; here it is zero.
        """

    @abstractmethod
    def interface_forces(self, modal: Array) -> Components:
        """Return nodal forces along x and y; the forces per mode are ``modal * n_x/2``."""

    def on_all_nodes(self, values: Array, driven: float) -> Array:
        """Add the value of the driven edge's node.

        Parameters
        ----------
        values, driven
            As in :meth:`.condensed.ElasticBody.on_all_nodes`.
        """
        nodal = np.empty(values.size + 1)
        nodal[0] = driven
        nodal[1:] = values
        return nodal

    def zero_field(self) -> Field:
        """Return a field of zeros."""
        levels = self.grid.n_y + 1
        return Field(np.zeros((levels, 2, self.modes)), np.zeros(levels))

    def translation_load(self, acceleration: float) -> Field:
        """Return the inertia (N/m) against an acceleration (m/s^2) of the body along x."""
        load = self.zero_field()
        per_level = -self.material.density * acceleration * self.row_sums
        per_mode = self.sine_amplitudes(np.full(self.modes, self.grid.dx))
        load.modes[:, 0] = per_level[:, None] * per_mode
        return load

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
        if load is None:
            load = self.zero_field()
        nothing = (0.0, terms[0][1])
        missing = 4 - len(terms)  # the kernel takes four terms
        coefficients, fields = zip(
            *terms,
            *[nothing] * missing,
            strict=True,
        )
        density = s * self.material.density
        modes, edge = field_kernels.add_inertia(
            self.mass,
            density * self.x_mass,
            density * self.grid.dx / 6.0,
            self.edge_weights[2],
            self.mode_scale,
            coefficients,
            tuple(field.modes for field in fields),
            tuple(field.edge for field in fields),
            load.modes,
            load.edge,
        )
        return Field(modes, edge)

    def at_rest(self, displacement: Field, velocity: float) -> Motion:
        """Return the motion of a body at rest.

        Parameters
        ----------
        displacement, velocity
            As in :meth:`.condensed.ElasticBody.at_rest`.
        """
        rates = self.zero_field()
        rates.modes[:, 0] = -velocity * self.sine_amplitudes(np.ones(self.modes))
        return Motion(displacement, rates, self.momentum_x(rates))

    def momentum_x(self, velocity: Field) -> float:
        """Return the momentum along x (kg/s per unit depth) of a velocity field w_t (m/s)."""
        along_x = velocity.modes[:, 0] @ self.x_integral
        return self.material.density * float(self.row_sums @ along_x)
