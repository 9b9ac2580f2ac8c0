"""The free right edge: its n_y values of u_y couple to all modes, and are eliminated last.

The edge values ``e`` and the bulk u obey ``K_e e + G u = load``. Eliminating the bulk at a given
displacement of the interface leaves a small dense system, their Schur complement. Its influence on
the interface decays exponentially over some heights of the block.
"""

from abc import ABC, abstractmethod
from functools import cached_property

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from ..types import Array
from . import edge_kernels, field_kernels, kernels
from .condensed import Expectation
from .grid import Components, Field
from .matrices import dense, product, transposed
from .separable import SeparableBody

ROUND_OFF = 4.0  # relative, of the edge values: times epsilon and the condition (H / dy)^2

NEGLIGIBLE = 1e-13  # of the edge's largest force on a node; below is round-off


class EdgeValues(ABC):
    """The edge values of ``u_y`` of one block or a pair, all other unknowns in balance."""

    @property
    @abstractmethod
    def schur(self) -> Array:
        """Stiffness of the edge values (N/m per m), all other unknowns eliminated at fixed w.

        Its first row and column belong to the upper body's corner: they give its normal force on
        the interface.
        """

    @property
    @abstractmethod
    def compliance(self) -> Array:
        """Inverse of :attr:`schur` on the free values (m per N/m), zero on those held fixed."""

    @property
    @abstractmethod
    def to_interface(self) -> Components:
        """Nodal forces on the interface, bulk eliminated, per unit of each edge value.

        Tangential at the nodes 1..n_x and normal at 0..n_x - 1 (N/m per m), a row for each edge
        value. The tangential ones are also the forces on the edge values per unit of w.
        """

    @property
    @abstractmethod
    def round_off(self) -> float:
        """Relative error of the edge values in any solve."""

    @abstractmethod
    def residual(
        self,
        load: Field,
        modes: Array,
        edge: Array,
    ) -> Array:
        """Return the unbalanced force on the edge values.

        Parameters
        ----------
        load : Field
            The load (N/m).
        modes : ndarray
            Amplitudes of the displacement (m), shape (levels, 2, modes).
        edge : ndarray
            Edge values (m), shape (levels,).

        Returns
        -------
        ndarray
            The force (N/m), shape (levels,).
        """

    def change(self, w: Array) -> Array:
        """Return the change of the edge values (m) for a change of w at the nodes 1..n_x (m)."""
        near = self.response_near
        return near @ w[-near.shape[1] :]

    def correction(self, residual: Array) -> Array:
        """Return the change of the edge values (m) that balances a residual (N/m) at fixed w."""
        return self.compliance @ residual

    @cached_property
    def response(self) -> Array:
        """Edge values per unit of w at each node, bulk and edge in balance, (levels, n_x)."""
        tangential, _ = self.to_interface
        return -self.compliance @ tangential

    @cached_property
    def response_near(self) -> Array:
        """:attr:`response` to the nodes of :attr:`felt`, (levels, nodes)."""
        nodes = self.felt.shape[2]
        return np.ascontiguousarray(self.response[:, -nodes:])

    @cached_property
    def diagonal(self) -> Array:
        """Contribution of the edge to the diagonal of D at the nodes 1..n_x (N/m per m)."""
        tangential, _ = self.to_interface
        return np.einsum("ji,ji->i", tangential, self.response)

    @cached_property
    def felt(self) -> Array:
        """:attr:`to_interface` at the last nodes, above round-off, (2, levels, nodes)."""
        forces = np.array(self.to_interface)
        largest = np.abs(forces).max(axis=(0, 1))
        first = int(np.argmax(largest > NEGLIGIBLE * largest.max()))
        return np.ascontiguousarray(forces[..., first:])


class RightEdge(EdgeValues):
    """The rows of the edge values in ``K + s M`` of one block.

    Parameters
    ----------
    body : SeparableBody
        The block.
    s : float
        Factor of the mass matrix (1/s^2).
    inverse, lower : ndarray
        Factors of the bulk's elimination (:func:`.kernels.factorise`).
    """

    def __init__(
        self,
        body: SeparableBody,
        s: float,
        inverse: Array,
        lower: Array,
    ) -> None:
        self.body = body
        self._inverse = inverse
        self._lower = lower
        dx = body.grid.dx
        material = body.material
        density = s * material.density
        shear = material.shear_modulus
        stretch = material.p_wave_modulus
        against_x = material.lame_modulus * transposed(body.derivative)
        against_slope = material.coupling_modulus * body.derivative
        against_y = (stretch * dx / 6.0) * body.stiffness
        against_y = against_y + (density * dx / 6.0 - shear / dx) * body.mass
        among_themselves = (stretch * dx / 3.0) * body.stiffness
        among_themselves = among_themselves + (density * dx / 3.0 + shear / dx) * body.mass
        self._to_modes = np.array([against_x, against_slope, against_y])
        self._own = among_themselves
        self._rows = np.array([*self._to_modes, self._own])
        self._transposed = np.array([transposed(matrix) for matrix in self._to_modes])

    def profiles(self, edge: Array) -> Array:
        """Return the profiles along y of ``G^T e``, one per edge weight, (3, n_y + 1)."""
        return field_kernels.products(self._transposed, edge)

    def residual(
        self,
        load: Field,
        modes: Array,
        edge: Array,
    ) -> Array:
        """Return the unbalanced force on the edge values (N/m), (n_y + 1,).

        Parameters
        ----------
        load, modes, edge
            As in :meth:`.right_edge.EdgeValues.residual`.
        """
        return self._residual(load, modes, edge, edge.size)

    def corner_reaction(
        self,
        load: Field,
        lowest: Array,
        edge: Array,
    ) -> float:
        """Return the normal force on the corner's node.

        Parameters
        ----------
        load : Field
            The load (N/m).
        lowest : ndarray
            Amplitudes of the displacement (m) at the two lowest levels, (2, 2, modes).
        edge : ndarray
            Edge values (m), shape (n_y + 1,).

        Returns
        -------
        float
            The force (N/m).
        """
        corner = self._residual(load, lowest, edge, 1)
        return -corner[0]

    def _residual(
        self,
        load: Field,
        modes: Array,
        edge: Array,
        levels: int,
    ) -> Array:
        return field_kernels.edge_residual(
            self._rows,
            self.body.edge_weights,
            modes,
            edge,
            load.edge,
            levels,
        )

    @cached_property
    def round_off(self) -> float:
        """Relative error of the edge values in any solve."""
        grid = self.body.grid
        condition = (grid.height / np.diff(grid.y).min()) ** 2
        return ROUND_OFF * np.finfo(float).eps * condition

    @cached_property
    def schur(self) -> Array:
        """Stiffness of the edge values (N/m per m), bulk eliminated, interface held fixed."""
        sums = self._sums_of_unit_values()
        rows = np.zeros_like(sums[0])
        for matrix, by_value in zip(self._to_modes, sums, strict=True):
            rows += product(matrix, by_value.T).T
        # the sums begin at the level of each edge value: the other half follows by symmetry
        lower = np.tril(dense(self._own) - rows.T)
        return lower + np.tril(lower, -1).T

    def _sums_of_unit_values(self) -> Array:
        """Sums of the bulk's response over the modes, (edge weight, edge value, level)."""
        body = self.body
        levels = body.grid.n_y + 1
        diagonal = np.empty_like(self._inverse)
        edge_kernels.diagonal_inverse(self._inverse, self._lower, diagonal)
        solution = np.zeros((levels, 2, body.modes))
        sums = np.zeros((levels, 3, levels))
        for i, unit in enumerate(np.eye(levels)):
            first = max(i, 1)
            profiles = self.profiles(unit)[:, first - 1 : first + 2]
            if first == 1:
                profiles[:, 0] = 0.0  # the interface is held fixed
            edge_kernels.respond(
                self._inverse,
                self._lower,
                diagonal,
                profiles,
                body.edge_weights,
                body.mode_scale,
                first,
                solution,
            )
            field_kernels.edge_sums(
                body.edge_weights,
                solution,
                first - 1,
                sums[i],
            )
        return np.moveaxis(sums, 1, 0)

    @cached_property
    def compliance(self) -> Array:
        """Inverse of :attr:`schur` on its free values, zero at the corner."""
        return inverse_within(self.schur, slice(1, None))

    @cached_property
    def to_interface(self) -> Components:
        """Nodal forces on the interface, bulk eliminated, per unit of each edge value."""
        return self.body.interface_forces(self.body.mode_scale * self.to_modes())

    def to_modes(self) -> Array:
        """Return the forces on the interface's modes along x and y, per unit of an edge value.

        The bulk is eliminated. These are also the forces on the edge values per unit of amplitude.

        Returns
        -------
        ndarray
            Forces (N/m per m), shape (2, n_y + 1, modes).
        """
        body = self.body
        weights = body.edge_weights
        against_x, against_slope, against_y = self._to_modes
        forces = np.empty((2, body.grid.n_y + 1, body.modes))
        for component in (0, 1):
            modes = body.zero_field().modes
            modes[0, component] = 1.0
            kernels.substitute(self._inverse, self._lower, modes)
            x = modes[:, 0]
            y = modes[:, 1]
            forces[component] = weights[0] * product(against_x, x)
            forces[component] += weights[1] * product(against_slope, x)
            forces[component] += weights[2] * product(against_y, y)
        return forces


def inverse_within(stiffness: Array, free: slice) -> Array:
    """Invert a stiffness on its free values.

    Parameters
    ----------
    stiffness : ndarray
        A symmetric positive definite matrix, shape (n, n).
    free : slice
        The free values.

    Returns
    -------
    ndarray
        The inverse, zero on the other values, shape (n, n).
    """
    compliance = np.zeros_like(stiffness)
    own = stiffness[free, free]
    compliance[free, free] = cho_solve(cho_factor(own), np.eye(own.shape[0]))
    return compliance


def predicted(expected: Expectation) -> Array:
    """Return the edge values (m) after a step with the acceleration of the last step."""
    now = expected.motions[0]
    before = expected.motions[-1]
    step = expected.step
    edge = now.displacement.edge + step * now.velocity.edge
    if expected.last_step == 0.0:
        return edge
    change = now.velocity.edge - before.velocity.edge
    return edge + (0.5 * step**2 / expected.last_step) * change
