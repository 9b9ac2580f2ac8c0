"""One elastic block: its finite-element equations separate exactly along x.

The displacement is ``u_x = V t + w_x`` and ``u_y``, with ``w_x = 0`` on the left edge. On a grid
that is uniform along x the matrices of bilinear elements are sums of Kronecker products of
one-dimensional matrices, and with ``theta_m = (m + 1/2) pi / n_x``

    w_x(x_i) = sum_m W_m sin(theta_m i),  i = 1..n_x       (free of sigma_xx at the right edge)
    u_y(x_i) = sum_m U_m cos(theta_m i),  i = 0..n_x - 1   (zero at the right edge)

the modes decouple; each is a block-tridiagonal system along y. The paper's right edge is free of
sigma_xy as well: the values ``e_j = u_y(L, y_j)`` are further unknowns that couple to all modes. A
Schur complement (:mod:`.right_edge`) eliminates them, and the result is that of the assembled
matrix to round-off (tests/fem/test_block.py). On the interface ``u_y = 0`` (rigid substrate, no
opening). :mod:`.condensed_nodes` has the equations that are left between the interface's nodes.
"""

from __future__ import annotations

import numpy as np
from scipy import fft

from ..model.material import Material
from ..types import Array
from . import transforms
from .condensed_nodes import CondensedOnNodes
from .elimination import SeparableOperator
from .grid import Components, Field, Grid
from .right_edge import RightEdge
from .separable import SeparableBody


class Block(SeparableBody):
    """One deformable rectangular block on the interface y = 0.

    Parameters
    ----------
    grid : Grid
        The mesh.
    material : Material
        Elastic moduli and density.
    far_side : str
        Boundary condition of the far side, a key of :data:`.separable.HELD`.
    """

    def __init__(
        self,
        grid: Grid,
        material: Material,
        far_side: str = "free",
    ) -> None:
        mode = np.arange(grid.n_x)
        theta = (mode + 0.5) * np.pi / grid.n_x
        self._alternating = (-1.0) ** mode
        edge_weights = self._alternating * edge_forces(theta)
        x_integral = 0.5 * grid.dx / np.tan(theta / 2.0)
        super().__init__(
            grid,
            material,
            theta,
            x_integral,
            edge_weights,
            far_side,
        )

    def operator(self, s: float) -> BlockOperator:
        """Factorise the dynamic stiffness ``K + s M`` (`s` in 1/s^2)."""
        return BlockOperator(self, s)

    @property
    def no_memory(self) -> Array:
        """The memory before the first step: the right edge has not been predicted yet."""
        return np.array(np.inf)

    def sine_amplitudes(self, nodal: Array) -> Array:
        """Return the amplitudes of nodal values at i = 1..n_x (last axis) in the sine basis."""
        return transforms.sine_amplitudes(nodal)

    def sine_values(self, amplitudes: Array) -> Array:
        """Return the nodal values at i = 1..n_x (last axis) of sine amplitudes."""
        return 0.5 * fft.dst(amplitudes, type=2)

    def cosine_values(self, amplitudes: Array) -> Array:
        """Return the nodal values at i = 0..n_x - 1 (last axis) of cosine amplitudes."""
        return 0.5 * fft.dct(amplitudes, type=2)

    def cosine_amplitudes(self, nodal: Array) -> Array:
        """Return the amplitudes of nodal values at i = 0..n_x - 1 (last axis), cosine basis."""
        return fft.dct(nodal, type=3) / self.grid.n_x

    def forces(
        self,
        stiffness: Array,
        amplitudes: Array,
        reduced: Array,
    ) -> Components:
        """Return the nodal forces along x at i = 1..n_x and along y at i = 0..n_x.

        Parameters
        ----------
        stiffness, amplitudes, reduced
            As in :meth:`.separable.SeparableBody.forces`.
        """
        return transforms.nodal_forces(stiffness, amplitudes, reduced, self._alternating)

    def interface_forces(self, modal: Array) -> Components:
        """Return the nodal forces; the forces per mode are ``modal * n_x/2``, (2, ..., n_x).

        Along x at i = 1..n_x and along y at i = 0..n_x - 1. With alternating signs, the cosines in
        reversed order are the sines: one call transforms both.
        """
        modal = np.array(modal)
        modal[0] *= self._alternating
        forces = fft.dct(modal, type=2, overwrite_x=True)
        forces *= 0.5
        tangential = forces[0, ..., ::-1]
        normal = forces[1]
        tangential[..., -1] *= 0.5  # half of an element belongs to the last node
        normal[..., 0] *= 0.5  # and to the first one
        return tangential, normal

    def top_load(self, normal_stress: float) -> Field:
        """Return the nodal forces of a compressive stress (Pa), per mode times 2/n_x (N/m)."""
        load = self.zero_field()
        forces = -normal_stress * self.grid.nodal_lengths
        inner = np.array(forces[:-1])
        # sum_i F_i cos(theta_m i): scipy's type 3 counts the first entry once, others twice
        inner[0] *= 2.0
        load.modes[-1, 1] = fft.dct(inner, type=3) / self.grid.n_x
        load.edge[-1] = forces[-1]
        return load

    def nodal_values(self, field: Field) -> Components:
        """Return nodal w_x and u_y, each of shape (n_y + 1, n_x + 1)."""
        left = np.zeros((self.grid.n_y + 1, 1))
        x = self.sine_values(field.modes[:, 0])
        y = self.cosine_values(field.modes[:, 1])
        right = field.edge[:, None]
        return np.hstack((left, x)), np.hstack((y, right))


class BlockOperator(SeparableOperator, CondensedOnNodes):
    """``K + s M`` of a :class:`Block` for one ``s`` (1/s^2), with ``s = 0`` for statics."""

    body: Block
    edge: RightEdge

    def __init__(self, body: Block, s: float) -> None:
        super().__init__(body, s)
        self.edge = RightEdge(body, s, self._inverse, self._lower)

    def _profiles(self, edge: Array) -> Array:
        """Profiles along y of the forces that edge values exert on the modes."""
        return self.edge.profiles(edge)

    def corner_reaction(
        self,
        load: Field,
        swept: Array,
        edge: Array,
        amplitudes: Array,
        start: Array | None,
    ) -> float:
        """Return the normal force (N/m) on the corner.

        Parameters
        ----------
        load, swept, edge, amplitudes, start
            As in :meth:`.condensed_nodes.CondensedOnNodes.corner_reaction`.
        """
        lowest = swept[:2].copy()
        self.substitute_up(lowest, amplitudes, start)
        return self.edge.corner_reaction(load, lowest, edge)


def edge_forces(theta: Array) -> Array:
    """Return the forces of modes on the right edge, but for their signs, shape (3, modes).

    ``int chi w'`` and ``int chi' w``, chi being the edge's hat function, and the nodal value beside
    the edge, for modes with the angle theta per element.
    """
    return np.array(
        [
            np.sin(theta / 2.0) ** 2,
            np.cos(theta / 2.0) ** 2,
            np.sin(theta),
        ]
    )
