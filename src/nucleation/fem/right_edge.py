"""The free right edge: its n_y values of u_y couple to all modes, and are eliminated last.

The edge values ``e`` and the bulk u obey ``K_e e + G u = load``. Eliminating the bulk at a given
displacement of the interface leaves a small dense system, their Schur complement. Its influence on
the interface decays exponentially over some heights of the block.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from ..types import Array
from . import edge_kernels, kernels
from .grid import Components, Field, Motion
from .layer import Layer, Layers, dense, product, transposed
from .modes import BlockModes

ROUND_OFF = 4.0  # relative, of the edge values: times epsilon and the condition (H / dy)^2
NEGLIGIBLE = 1e-13  # of the edge's largest force on a node; below is round-off


def foreseen_edge(motions: Sequence[Motion], step: float, last_step: float) -> Array:
    """Edge values (m) after a step (s) with the acceleration of the last step."""
    now = motions[0]
    before = motions[-1]
    edge = now.displacement.edge + step * now.velocity.edge
    if last_step == 0.0:
        return edge
    change = now.velocity.edge - before.velocity.edge
    return edge + (0.5 * step**2 / last_step) * change


def elastic_energy(layer: Layer, displacement: Field) -> float:
    """Elastic energy (J/m) of a displacement (m) of one layer."""
    material, modes = layer.material, layer.modes
    x, y = displacement.modes[:, 0], displacement.modes[:, 1]
    coupling = material.lame_modulus * layer.derivative
    coupling = coupling - material.coupling_modulus * transposed(layer.derivative)
    shear, stretch = material.shear_modulus, material.p_wave_modulus
    by_x = stretch * modes.x_stiffness * product(layer.mass, x)
    by_x = by_x + shear * modes.x_mass * product(layer.stiffness, x)
    by_x = by_x + 2.0 * modes.sine * product(coupling, y)
    by_y = stretch * modes.x_mass * product(layer.stiffness, y)
    by_y = by_y + shear * modes.x_stiffness * product(layer.mass, y)
    twice = float((x * by_x + y * by_y).sum(axis=0) @ modes.norms)
    if modes.has_edge:
        none = np.zeros_like(displacement.edge)
        rows = RightEdge(layer, 0.0, none, none)
        for edge in (none, displacement.edge):
            forces = rows.residual(Field(displacement.modes, none), displacement.modes, edge)
            twice -= float(displacement.edge @ forces)
    return 0.5 * twice


class RightEdge:
    """The rows of the edge values of one layer in ``K + s M``."""

    def __init__(
        self,
        layer: Layer,
        s: float,
        inverse: Array,
        lower: Array,
    ) -> None:
        self._layer = layer
        self._inverse = inverse  # the factors of the bulk
        self._lower = lower
        dx = layer.grid.dx
        material = layer.material
        density = s * material.density
        shear = material.shear_modulus
        stretch = material.p_wave_modulus
        against_x = material.lame_modulus * transposed(layer.derivative)
        against_slope = material.coupling_modulus * layer.derivative
        against_y = (stretch * dx / 6.0) * layer.stiffness
        against_y = against_y + (density * dx / 6.0 - shear / dx) * layer.mass
        own = (stretch * dx / 3.0) * layer.stiffness
        own = own + (density * dx / 3.0 + shear / dx) * layer.mass
        self._rows = np.array([against_x, against_slope, against_y, own])
        self._transposed = np.array([transposed(matrix) for matrix in self._rows[:3]])

    def profiles(self, edge: Array) -> Array:
        """Profiles along y of ``G^T e``, one per edge weight, (3, n_y + 1)."""
        return kernels.products(self._transposed, edge)

    def residual(
        self,
        load: Field,
        modes: Array,
        edge: Array,
        levels: int | None = None,
    ) -> Array:
        """Unbalanced force on the (lowest) edge values (N/m), given those and amplitudes (m)."""
        weights = self._layer.modes.edge_weights
        levels = levels or edge.size
        return edge_kernels.edge_residual(self._rows, weights, modes, edge, load.edge, levels)

    @cached_property
    def round_off(self) -> float:
        """Relative error of the edge values in any solve."""
        grid = self._layer.grid
        condition = (grid.height / np.diff(grid.y).min()) ** 2
        return ROUND_OFF * np.finfo(float).eps * condition

    @cached_property
    def schur(self) -> Array:
        """Stiffness of the edge values (N/m per m), bulk eliminated, interface held fixed."""
        sums = self._sums_of_unit_values()
        rows = np.zeros_like(sums[0])
        for matrix, by_value in zip(
            self._rows[:3],
            sums,
            strict=True,
        ):
            rows += product(matrix, by_value.T).T
        # the sums begin at the level of each edge value: the other half follows by symmetry
        lower = np.tril(dense(self._rows[3]) - rows.T)
        return lower + np.tril(lower, -1).T

    def _sums_of_unit_values(self) -> Array:
        """Sums of the bulk's response over the modes, (edge weight, edge value, level)."""
        modes = self._layer.modes
        levels = self._layer.levels
        diagonal = np.empty_like(self._inverse)
        edge_kernels.diagonal_inverse(self._inverse, self._lower, diagonal)
        solution = np.zeros((levels, 2, modes.n_x))
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
                modes.edge_weights,
                modes.scale,
                first,
                solution,
            )
            edge_kernels.edge_sums(modes.edge_weights, solution, first - 1, sums[i])
        return np.moveaxis(sums, 1, 0)

    def to_modes(self) -> Array:
        """Forces on the interface's modes along x and y per edge value, bulk eliminated.

        In N/m per m, (2, n_y + 1, n_x); also the forces on the edge values per unit of amplitude.
        """
        weights = self._layer.modes.edge_weights
        against_x, against_slope, against_y, _ = self._rows
        forces = np.empty((2, self._layer.levels, weights.shape[1]))
        for component in (0, 1):
            modes = self._layer.zero_field().modes
            modes[0, component] = 1.0
            kernels.substitute(self._inverse, self._lower, modes)
            x = modes[:, 0]
            y = modes[:, 1]
            forces[component] = weights[0] * product(against_x, x)
            forces[component] += weights[1] * product(against_slope, x)
            forces[component] += weights[2] * product(against_y, y)
        return forces


class EdgeValues:
    """The edge values of a block or a pair, stacked, with all other unknowns in balance at given w.

    A pair has its corner twice: the lower body is mirrored.
    """

    def __init__(
        self,
        layers: Layers,
        rows: list[RightEdge],
        moves: bool,
        series: tuple[Array, Array] | None,
    ) -> None:
        """`series` are compliance and forces of a pair; `moves`: there is inertia."""
        assert isinstance(layers.modes, BlockModes)
        self._layers = layers
        self._modes = layers.modes
        self.rows = rows
        self._moves = moves
        self._series = series
        self.round_off = max(rows.round_off for rows in self.rows)

    def residual(
        self,
        load: Field,
        modes: Array,
        edge: Array,
    ) -> Array:
        """Unbalanced force on the edge values (N/m), given those and amplitudes (m)."""
        body = self._layers
        parts = zip(
            self.rows,
            body.parts(load),
            body.parts(Field(modes, edge)),
            strict=True,
        )
        found = [
            rows.residual(
                own,
                part.modes,
                part.edge,
            )
            for rows, own, part in parts
        ]
        return found[0] if len(found) == 1 else np.concatenate(found)

    def change(self, w: Array) -> Array:
        """Change of the edge values (m) for a change of w at the nodes 1..n_x (m)."""
        near = self.response_near
        return near @ w[-near.shape[1] :]

    @cached_property
    def _to_modes(self) -> tuple[Array, Array]:
        """Forces of a pair on the modes of w1 and u_y, and on those of w2, per edge value."""
        above, below = (rows.to_modes() for rows in self.rows)
        mirror = np.array([1.0, -1.0])[:, None, None]
        joint = np.concatenate((above, below * mirror), axis=1)
        return joint, np.concatenate((np.zeros_like(above[0]), below[0]))

    @cached_property
    def schur(self) -> Array:
        """Stiffness of the edge values (N/m per m), all other unknowns eliminated at fixed w.

        Its first row and column belong to the upper body's corner: they give its normal force.
        """
        if self._series is None:
            return self.rows[0].schur
        (x, y), _ = self._to_modes
        n = len(self.rows[0].schur)
        stiffness = np.zeros((len(x), len(x)))
        stiffness[:n, :n] = self.rows[0].schur
        stiffness[n:, n:] = self.rows[1].schur
        xx, xy, yy = self._series[0]
        moved_x = xx * x + xy * y
        moved_y = xy * x + yy * y
        return stiffness - self._modes.scale * (x @ moved_x.T + y @ moved_y.T)

    @cached_property
    def compliance(self) -> Array:
        """Inverse of :attr:`schur` on the free values (m per N/m), zero on those held fixed."""
        if self._series is None:
            return _inverse_within(self.schur, slice(1, None))
        layers = self._layers
        above = layers.layers[0].levels
        independent = np.delete(
            np.eye(len(self.schur)),
            above,
            axis=1,
        )
        independent[above, 0] = -1.0  # the corner, mirrored
        first = None if layers.is_held_along_y or self._moves else 1
        last = -1 if layers.is_held_along_y else None
        stiffness = independent.T @ self.schur @ independent
        inverse = _inverse_within(stiffness, slice(first, last))
        return independent @ inverse @ independent.T

    @cached_property
    def to_interface(self) -> Components:
        """Nodal forces (N/m per m) on the interface, bulk eliminated, a row for each edge value.

        Tangential at the nodes 1..n_x and normal at 0..n_x - 1. The tangential ones are also the
        forces on the edge values per unit of w.
        """
        if self._series is None:
            modal = self.rows[0].to_modes()
        else:
            (x, y), lower = self._to_modes
            above = y.copy()
            above[self._layers.layers[0].levels :] = 0.0  # the upper block's own
            _, _, yx1, yy1, xx2, xy2, _, _ = self._series[1]
            from_below = xx2 * x + xy2 * y
            from_above = yx1 * x + yy1 * y
            modal = np.array([from_below - lower, above - from_above])
        return self._modes.interface_forces(self._modes.scale * modal)

    @cached_property
    def response(self) -> Array:
        """Edge values per unit of w at each node, bulk and edge in balance, (levels, n_x)."""
        tangential, _ = self.to_interface
        return -self.compliance @ tangential

    @cached_property
    def response_near(self) -> Array:
        """:attr:`response` to the nodes of :attr:`felt`, (levels, nodes)."""
        return np.ascontiguousarray(self.response[:, -self.felt.shape[2] :])

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


def _inverse_within(stiffness: Array, free: slice) -> Array:
    """Inverse of a symmetric positive definite matrix on its free values, zero on the others."""
    compliance = np.zeros_like(stiffness)
    own = stiffness[free, free]
    compliance[free, free] = cho_solve(cho_factor(own), np.eye(own.shape[0]))
    return compliance
