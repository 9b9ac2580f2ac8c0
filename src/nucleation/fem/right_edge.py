"""The free right edge: its n_y values of u_y couple to all modes, and are eliminated last.

The edge values ``e`` and the bulk fulfil ``K_e e + G u = load``; with the bulk eliminated and the
interface held, that leaves a small dense system, their Schur complement. Its influence on the
interface falls exponentially over some heights of the block.
"""

from abc import ABC, abstractmethod
from functools import cached_property

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from ..types import Array
from . import kernels
from .block_modes import BlockModes
from .condensed import Expectation
from .grid import Field

ROUND_OFF = 4.0  # relative, of the edge values: times epsilon and the condition (H / dy)^2

NEGLIGIBLE = 1e-13  # of the edge's largest force on a node; below is round-off


class EdgeValues(ABC):
    """What the interface feels of the edge values of ``u_y``, all else in balance."""

    @property
    @abstractmethod
    def schur(self) -> Array:
        """Stiffness of the edge values (N/m per m), all else eliminated at fixed w.

        Its first row and column belong to the upper body's corner, whose normal force on the
        interface they give.
        """

    @property
    @abstractmethod
    def compliance(self) -> Array:
        """Its inverse on the free values (m per N/m), zero on those that are held."""

    @property
    @abstractmethod
    def to_interface(self) -> tuple[Array, Array]:
        """Nodal forces on the interface, bulk eliminated, per unit of each edge value.

        Tangential, with a row per edge value, at nodes 1..n_x, which is also the force on each edge
        value per unit of w, and normal at nodes 0..n_x - 1 (N/m per m).
        """

    @property
    @abstractmethod
    def round_off(self) -> float:
        """Relative error of the edge values in any solve."""

    @abstractmethod
    def residual(self, load: Field, modes: Array, edge: Array) -> Array:
        """Unbalanced force on the edge values (N/m)."""

    def change(self, w: Array) -> Array:
        """Change of the edge values (m) in balance, for a change of w at the nodes 1..n_x (m)."""
        near = self.response_near
        return near @ w[-near.shape[1] :]

    def correction(self, residual: Array) -> Array:
        """Change of the edge values that balances a residual, interface held, (n_y + 1,)."""
        return self.compliance @ residual

    @cached_property
    def response(self) -> Array:
        """Edge values per unit of w at each node, bulk and edge in balance, (n_y + 1, n_x)."""
        return -self.compliance @ self.to_interface[0]

    @cached_property
    def response_near(self) -> Array:
        """:attr:`response` to the nodes of :attr:`felt`, (n_y + 1, nodes)."""
        return np.ascontiguousarray(self.response[:, -self.felt.shape[2] :])

    @cached_property
    def diagonal(self) -> Array:
        """The edge's share of the diagonal of D at the nodes 1..n_x (N/m per m)."""
        return np.einsum("ji,ji->i", self.to_interface[0], self.response)

    @cached_property
    def felt(self) -> Array:
        """:attr:`to_interface` from where it rises above round-off, (2, n_y + 1, nodes)."""
        forces = np.array(self.to_interface)
        largest = np.abs(forces).max(axis=(0, 1))
        near = int(np.argmax(largest > NEGLIGIBLE * largest.max()))
        return np.ascontiguousarray(forces[..., near:])


class RightEdge(EdgeValues):
    """The rows of the edge values in ``K + s M``, given the factors of the bulk's elimination."""

    def __init__(self, body: BlockModes, s: float, inverse: Array, lower: Array) -> None:
        self.body, self._inverse, self._lower = body, inverse, lower
        dx, material = body.grid.dx, body.material
        lame, shear = material.lame_modulus, material.shear_modulus
        p_modulus, rho_s = material.p_wave_modulus, s * material.density
        # rows of the edge values: against w_x (two weights), against u_y, and among themselves
        self._rows = (
            body.derivative.transposed.scaled(lame),
            body.derivative.scaled(material.coupling_modulus),
            body.stiffness.scaled(p_modulus * dx / 6.0)
            + body.mass.scaled(rho_s * dx / 6.0 - shear / dx),
            body.stiffness.scaled(p_modulus * dx / 3.0)
            + body.mass.scaled(rho_s * dx / 3.0 + shear / dx),
        )
        self._stacked = np.array([matrix.stacked for matrix in self._rows])
        self._transposed = np.array([matrix.transposed.stacked for matrix in self._rows[:3]])

    def profiles(self, edge: Array) -> Array:
        """Profiles along y of ``G^T e``, one per edge weight, shape (3, n_y + 1)."""
        return kernels.products(self._transposed, edge)

    def residual(self, load: Field, modes: Array, edge: Array) -> Array:
        """Unbalanced force on the edge values (N/m), shape (n_y + 1,)."""
        return kernels.edge_residual(
            self._stacked, self.body.edge_weights, modes, edge, load.edge, edge.size
        )

    def corner_reaction(self, load: Field, lowest: Array, edge: Array) -> float:
        """Normal force (N/m) on the corner's node, from the modes' two lowest levels."""
        weights = self.body.edge_weights
        return -kernels.edge_residual(self._stacked, weights, lowest, edge, load.edge, 1)[0]

    @cached_property
    def round_off(self) -> float:
        """Relative error of the edge values in any solve."""
        condition = (self.body.grid.height / np.diff(self.body.grid.y).min()) ** 2
        return ROUND_OFF * np.finfo(float).eps * condition

    @cached_property
    def schur(self) -> Array:
        """Stiffness of the edge values, bulk eliminated and interface held (n_y + 1, n_y + 1).

        Its first row and column belong to the corner, where ``u_y = 0``: they give its reaction.
        """
        body = self.body
        n_levels, n_x = body.grid.n_y + 1, body.grid.n_x
        diagonal = np.empty_like(self._inverse)
        kernels.diagonal_inverse(self._inverse, self._lower, diagonal)
        solution = np.zeros((n_levels, 2, body.modes))
        sums, rows = np.zeros((n_levels, 3, n_levels)), np.zeros((n_levels, n_levels))
        for i in range(n_levels):
            first = max(i, 1)
            unit = np.zeros(n_levels)
            unit[i] = 1.0
            profiles = self.profiles(unit)[:, first - 1 : first + 2]
            if first == 1:
                profiles[:, 0] = 0.0  # the interface is held
            kernels.respond(
                self._inverse, self._lower, diagonal, profiles, body.edge_weights, 2.0 / n_x,
                first, solution,
            )  # fmt: skip
            kernels.edge_sums(body.edge_weights, solution, first - 1, sums[i])
        for matrix, of_edge in zip(self._rows, np.moveaxis(sums, 1, 0), strict=False):
            rows += (matrix @ of_edge.T).T
        # an edge value's rows see only the levels from it on, which were summed over
        lower = np.tril(self._rows[3].dense() - rows.T)
        return lower + np.tril(lower, -1).T

    @cached_property
    def compliance(self) -> Array:
        """Inverse of :attr:`schur` on its free values, zero at the corner."""
        return inverse_within(self.schur, slice(1, None))

    @cached_property
    def to_interface(self) -> tuple[Array, Array]:
        """Nodal forces on the interface, bulk eliminated, per unit of each edge value."""
        return self.body.interface_forces((2.0 / self.body.grid.n_x) * self.to_modes())

    def to_modes(self) -> Array:
        """Generalised forces on the interface's modes, bulk eliminated, per unit of an edge value.

        Along x and y, with a row per edge value and a column per mode (N/m per m). They are also
        the forces on the edge values per unit of amplitude.
        """
        body, weights = self.body, self.body.edge_weights
        along_x, across_x, along_y, _ = self._rows
        rows = np.empty((2, body.grid.n_y + 1, body.modes))
        for component in (0, 1):
            modes = np.zeros((body.grid.n_y + 1, 2, body.modes))
            modes[0, component] = 1.0
            kernels.substitute(self._inverse, self._lower, modes)
            rows[component] = weights[0] * (along_x @ modes[:, 0])
            rows[component] += weights[1] * (across_x @ modes[:, 0])
            rows[component] += weights[2] * (along_y @ modes[:, 1])
        return rows


def inverse_within(stiffness: Array, free: slice) -> Array:
    """The inverse of a stiffness on its free values, zero on the others."""
    compliance, own = np.zeros_like(stiffness), stiffness[free, free]
    compliance[free, free] = cho_solve(cho_factor(own), np.eye(own.shape[0]))
    return compliance


def predicted(expected: Expectation) -> Array:
    """The edge values (m) after a step, if they go on with the acceleration of the last one."""
    (now, before), step = (expected.motions[0], expected.motions[-1]), expected.step
    edge = now.displacement.edge + step * now.velocity.edge
    if expected.last_step == 0.0:
        return edge
    change = now.velocity.edge - before.velocity.edge
    return edge + (0.5 * step**2 / expected.last_step) * change
