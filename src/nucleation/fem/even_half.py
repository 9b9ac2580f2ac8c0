"""Half a block for displacements that are even along x about its left end: no side is driven."""

import numpy as np
from scipy import fft

from ..model.material import Material
from ..types import Array
from .block import Block, edge_forces
from .grid import Components, Field, Grid


class EvenHalf(Block):
    """The right half of a block in which u_x is even about the middle and u_y odd.

    The modes are ``u_x = cos(theta_m i)``, ``u_y = -sin(theta_m i)`` with ``theta_m = m pi/n_x``,
    m = 0..n_x. The norm of the first and the last one is twice that of the others: they are divided
    by the square root of two. The interface's nodes 0..n_x are free, and count as a block's nodes
    1..n_x + 1; its node 0 is here the mirror image of node 1.

    Parameters
    ----------
    grid : Grid
        The mesh of the half.
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
        super().__init__(grid, material, far_side)
        n = grid.n_x
        mode = np.arange(n + 1)
        self._ends = np.ones(n + 1)
        self._ends[[0, -1]] = 0.5**0.5
        theta = mode * np.pi / n
        signs = (-1.0) ** mode
        x_integral = np.zeros(n + 1)
        x_integral[0] = grid.length * self._ends[0]
        self._set_modes(theta, x_integral, signs * self._ends * edge_forces(theta))

    def sine_amplitudes(self, nodal: Array) -> Array:
        """Return the amplitudes of nodal values of u_x at i = 0..n_x (last axis)."""
        scale = (2.0 / self.grid.n_x) ** 0.5
        scaled = scale * self._ends * nodal
        return fft.dct(scaled, type=1, norm="ortho")

    def sine_values(self, amplitudes: Array) -> Array:
        """Return the nodal values of u_x at i = 0..n_x (last axis)."""
        values = fft.dct(amplitudes, type=1, norm="ortho")
        scale = (self.grid.n_x / 2.0) ** 0.5
        return values * scale / self._ends

    def cosine_values(self, amplitudes: Array) -> Array:
        """Return the nodal values of u_y at i = -1..n_x - 1 (last axis)."""
        waves = amplitudes[..., 1:-1]
        inner = -0.5 * fft.dst(waves, type=1)
        first = inner[..., :1]
        middle = np.zeros_like(first)
        return np.concatenate((-first, middle, inner), axis=-1)

    def interface_forces(self, modal: Array) -> Components:
        """Return the nodal forces along x at i = 0..n_x and along y at i = -1..n_x - 1."""
        along_x = self.sine_values(modal[0])
        tangential = self._ends**2 * along_x
        normal = self.cosine_values(modal[1])
        return tangential, normal

    def forces(
        self,
        stiffness: Array,
        amplitudes: Array,
        reduced: Array,
    ) -> Components:
        """Return the nodal forces along x at i = 0..n_x and along y at i = -1..n_x.

        Parameters
        ----------
        stiffness, amplitudes, reduced
            As in :meth:`.separable.SeparableBody.forces`.
        """
        tangential, normal = self.interface_forces(stiffness * amplitudes - reduced)
        return tangential, np.append(normal, 0.0)

    def top_load(self, normal_stress: float) -> Field:
        """Return zeros: an even stress on the top acts on the other half."""
        return self.zero_field()

    def nodal_values(self, field: Field) -> Components:
        """Return nodal w_x and u_y at i = 0..n_x, each of shape (n_y + 1, n_x + 1)."""
        x = self.sine_values(field.modes[:, 0])
        y = self.cosine_values(field.modes[:, 1])
        right = field.edge[:, None]
        y = np.hstack((y[:, 1:], right))
        return x, y
