"""The modes of the elastic block: its finite-element equations separate exactly along x.

The displacement is ``u_x = V t + w_x`` and ``u_y``, with ``w_x = 0`` on the left edge. On a grid
that is uniform along x the matrices of bilinear elements are sums of Kronecker products of
one-dimensional matrices, and with ``theta_m = (m + 1/2) pi / n_x``

    w_x(x_i) = sum_m W_m sin(theta_m i),  i = 1..n_x       (free of sigma_xx at the right edge)
    u_y(x_i) = sum_m U_m cos(theta_m i),  i = 0..n_x - 1   (zero at the right edge)

the modes decouple; each is a block-tridiagonal system along y. The paper's right edge is free of
sigma_xy as well: the values ``e_j = u_y(L, y_j)`` are further unknowns that couple to all modes. A
Schur complement eliminates them, and the result is that of the assembled matrix to round-off
(tests/fem/test_block.py).
"""

import numpy as np
from scipy import fft

from ..model.material import Material
from ..types import Array
from . import transforms
from .grid import Components, Field, Grid
from .separable import SeparableBody


class BlockModes(SeparableBody):
    """One deformable rectangular block on the interface y = 0: its mesh, material and modes.

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
            Forces (N/m) at the nodes 1..n_x and 0..n_x. The last normal force is the edge's;
            here it is zero.
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
