"""Elastic layers on a grid: matrices along y, inertia and loads; one layer, or two.

A tridiagonal matrix A of size n along y is an array (3, n) of its diagonals: ``A[i, i-1]``,
``A[i, i]`` and ``A[i, i+1]`` in row i. The first entry of the first diagonal and the last entry of
the last one are zero.
"""

from __future__ import annotations

import numpy as np

from ..model.material import Material
from ..types import Array
from . import kernels
from .grid import Components, Field, Grid, Terms
from .modes import BlockModes, Modes, PeriodModes

HELD = {
    "free": (False, False),
    "clamped": (True, True),
    "roller": (False, True),
    "velocity": (True, False),
}
"""Which of u_x and u_y are zero on the far side, by its boundary condition; the others are free."""


def element_matrices(nodes: Array) -> tuple[Array, Array, Array]:
    """Integrals of products of the hat functions psi_i of a line of nodes (m).

    ``int psi_i psi_j`` (m), ``int psi_i' psi_j'`` (1/m) and ``int psi_i psi_j'``.
    """
    h = np.diff(nodes)
    left, right = _beside_nodes(h)
    mass = np.array([left / 6.0, (left + right) / 3.0, right / 6.0])
    left, right = _beside_nodes(1.0 / h)
    stiffness = np.array([-left, left + right, -right])
    left, right = _beside_nodes(np.full(h.size, 0.5))
    diagonal = np.zeros(nodes.size)
    diagonal[0] = -0.5
    diagonal[-1] = 0.5
    return mass, stiffness, np.array([-left, diagonal, right])


def _beside_nodes(values: Array) -> tuple[Array, Array]:
    """Values of the elements on the left and on the right of each node, zero without one."""
    return np.append(0.0, values), np.append(values, 0.0)


def product(matrix: Array, values: Array) -> Array:
    """Product of a tridiagonal matrix with an array along its first axis, (n, ...)."""
    further_axes = [1] * (values.ndim - 1)
    lower, diagonal, upper = matrix.reshape(3, -1, *further_axes)
    out = diagonal * values
    out[1:] += lower[1:] * values[:-1]
    out[:-1] += upper[:-1] * values[1:]
    return out


def transposed(matrix: Array) -> Array:
    """The diagonals of the transposed matrix."""
    lower, diagonal, upper = matrix
    return np.array([np.roll(upper, 1), diagonal, np.roll(lower, -1)])


def dense(matrix: Array) -> Array:
    """The matrix as a dense array, (n, n)."""
    return product(matrix, np.eye(matrix.shape[1]))


class Layer:
    """A layer of a material, with modes along x; its lowest nodes are those of the interface."""

    def __init__(
        self, grid: Grid, material: Material, modes: Modes, far_side: str = "free"
    ) -> None:
        self.grid = grid
        self.material = material
        self.modes = modes
        self.held = HELD[far_side]
        self.levels = grid.n_y + 1
        self.crossing_time = grid.height / material.shear_wave_speed  # s, of shear waves
        self.total_mass = material.density * grid.length * grid.height  # kg/m
        self.mass, self.stiffness, self.derivative = element_matrices(grid.y)
        self.row_sums = self.mass.sum(axis=0)

    def zero_field(self) -> Field:
        """A field of zeros."""
        return Field(np.zeros((self.levels, 2, self.modes.n_x)), np.zeros(self.levels))

    def far_load(self, normal: float, shear: float) -> Field:
        """Nodal forces (N/m) of a compressive and a shear stress (Pa) on the far side, if free."""
        load = self.zero_field()
        held_x, held_y = self.held
        normal, shear = (0.0 if held_y else normal), (0.0 if held_x else shear)
        load.modes[-1], load.edge[-1] = self.modes.uniform_load(
            self.grid,
            normal,
            shear,
        )
        return load

    def translation_load(self, acceleration: float) -> Field:
        """Inertia (N/m) against an acceleration (m/s^2) of the layer along x."""
        load = self.zero_field()
        per_level = -self.material.density * acceleration * self.row_sums
        per_mode = self.modes.sine_amplitudes(np.full(self.modes.n_x, self.grid.dx))
        load.modes[:, 0] = per_level[:, None] * per_mode
        return load

    def add_inertia(
        self,
        s: float,
        terms: Terms,
        load: Field,
        out: Field,
    ) -> None:
        """Fill `out` with ``load + s M sum_i c_i f_i`` (N/m), of at most four fields (m)."""
        nothing = (0.0, terms[0][1])
        missing = 4 - len(terms)  # the kernel takes four terms
        coefficients, fields = zip(*terms, *[nothing] * missing, strict=True)
        density = s * self.material.density
        kernels.add_inertia(
            self.mass,
            density * self.modes.x_mass,
            density * self.grid.dx / 6.0,
            self.modes.edge_weights[2],
            self.modes.scale,
            coefficients,
            tuple(field.modes for field in fields),
            tuple(field.edge for field in fields),
            load.modes,
            load.edge,
            out.modes,
            out.edge,
        )

    def momentum_x(self, velocity: Field) -> float:
        """Momentum along x (kg/s per unit depth) of a velocity field w_t (m/s)."""
        along_x = velocity.modes[:, 0] @ self.modes.x_integral
        return self.material.density * float(self.row_sums @ along_x)

    def nodal_values(self, field: Field) -> Components:
        """Nodal w_x and u_y, levels from the interface up, each of shape (n_y + 1, n_x + 1)."""
        x = self.modes.sine_values(field.modes[:, 0])
        y = self.modes.cosine_values(field.modes[:, 1])
        if self.grid.periodic:
            return self.modes.on_all_nodes(x, 0.0), self.modes.on_all_nodes(y, 0.0)
        left = np.zeros((self.levels, 1))
        return np.hstack((left, x)), np.hstack((y, field.edge[:, None]))


class Layers:
    """One layer on a rigid base, or two on one another, each a grid and a material.

    The far side of the first one is free; `far_side` is that of the second one. If both are free,
    both bear the same normal stress.

    Raises
    ------
    ValueError
        If the elements of two layers along x differ, or n_x of a period is even.
    """

    def __init__(
        self,
        upper: tuple[Grid, Material],
        lower: tuple[Grid, Material] | None = None,
        far_side: str = "free",
    ) -> None:
        self.grid, _ = upper
        self.modes = PeriodModes(self.grid) if self.grid.periodic else BlockModes(self.grid)
        self.layers = [Layer(*upper, self.modes)]
        if lower is not None:
            one, other = self.grid, lower[0]
            if (one.n_x, one.length) != (other.n_x, other.length):
                raise ValueError(
                    f"a pair needs the same elements along x: the upper body has n_x = {one.n_x} "
                    f"on {one.length:g} m, the lower one n_x = {other.n_x} on {other.length:g} m"
                )
            self.layers.append(Layer(*lower, self.modes, far_side))
        self.crossing_time = max(layer.crossing_time for layer in self.layers)  # s, by shear waves
        self.total_mass = self.layers[0].total_mass  # kg/m, that moves with the driven edge

    @property
    def is_held_along_y(self) -> bool:
        """Whether the base, or the lower far side, is held along y."""
        return len(self.layers) == 1 or self.layers[1].held[1]

    def split(self, values: Array) -> list[Array]:
        """Views of an array over levels: each layer's."""
        above = self.layers[0].levels
        return [values] if len(self.layers) == 1 else [values[:above], values[above:]]

    def parts(self, field: Field) -> list[Field]:
        """Views of a field: each layer's, the lower one's mirrored."""
        if len(self.layers) == 1:
            return [field]
        return list(
            map(
                Field,
                self.split(field.modes),
                self.split(field.edge),
            )
        )

    def joined(self, *parts: Field) -> Field:
        """The field of the fields of each layer."""
        if len(parts) == 1:
            return parts[0]
        modes = np.concatenate([part.modes for part in parts])
        return Field(modes, np.concatenate([part.edge for part in parts]))

    def zero_field(self) -> Field:
        """A field of zeros."""
        return self.joined(*(layer.zero_field() for layer in self.layers))
