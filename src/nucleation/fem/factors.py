"""``K + s M`` of one layer, eliminated mode by mode from the far side down to the interface.

The free right edge has n_y values of u_y of its own. They and the bulk u obey ``K_e e + G u =
load``; eliminating the bulk too, at a given displacement of the interface, leaves a small dense
system: their Schur complement.
"""

from collections.abc import Sequence

import numpy as np

from ..types import Array
from . import edge_kernels, kernels
from .body import Layer, product, transposed
from .grid import Field

Before = tuple[Sequence[float], float, Field, Field]
"""(c1, c2), beta (s), u_1 and u_2 (m) before a step with ``u = c1 u_1 + c2 u_2 + beta du/dt``."""


class LayerFactors:
    """``K + s M`` of a layer for one ``s`` (1/s^2), with the rows of its edge values.

    `pivot` is the stiffness on the interface per mode, times 2/n_x (N/m per m): xx, xy, yy. In a
    period there are no edge values: zeros stand for them.
    """

    def __init__(self, layer: Layer, s: float) -> None:
        self.layer = layer
        modes = layer.modes
        material = layer.material
        density = s * material.density
        shear = material.shear_modulus
        stretch = material.p_wave_modulus
        self.pivot = np.empty((3, modes.n_x))
        self.inverse = np.zeros((layer.levels, 3, modes.n_x))
        self.lower = np.empty((layer.levels - 1, 4, modes.n_x))
        kernels.factorise(
            stretch * modes.x_stiffness + density * modes.x_mass,
            shear * modes.x_mass,
            shear * modes.x_stiffness + density * modes.x_mass,
            stretch * modes.x_mass,
            modes.sine,
            layer.mass,
            layer.stiffness,
            layer.derivative,
            material.lame_modulus,
            material.coupling_modulus,
            layer.held,
            self.pivot,
            self.inverse,
            self.lower,
        )
        dx = layer.grid.dx
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

    def substitute(self, modes: Array) -> None:
        """Sweep a swept load back from the interface's displacement in level 0, in place."""
        kernels.substitute(self.inverse, self.lower, modes)

    def residual(self, load: Field, modes: Array, edge: Array) -> Array:
        """Unbalanced force on the edge values (N/m), given those and amplitudes (m)."""
        weights = self.layer.modes.edge_weights
        return edge_kernels.edge_residual(self._rows, weights, modes, edge, load.edge)

    def schur(self) -> Array:
        """Stiffness of the edge values (N/m per m), bulk eliminated, interface held fixed."""
        modes = self.layer.modes
        levels = self.layer.levels
        diagonal = np.empty_like(self.inverse)
        edge_kernels.diagonal_inverse(self.inverse, self.lower, diagonal)
        sums = np.zeros((levels, 3, levels))  # of the response to each edge value over the modes
        edge_kernels.response_sums(
            self.inverse, self.lower, diagonal, self._rows, modes.edge_weights, modes.scale, sums
        )
        rows = np.zeros((levels, levels))
        for matrix, by_value in zip(self._rows[:3], np.moveaxis(sums, 1, 0), strict=True):
            rows += product(matrix, by_value.T).T
        # the sums begin at the level of each edge value: the other half follows by symmetry
        lower = np.tril(product(self._rows[3], np.eye(levels)) - rows.T)
        return lower + np.tril(lower, -1).T

    def to_modes(self) -> Array:
        """Forces on the interface's modes along x and y per edge value, bulk eliminated.

        In N/m per m, (2, n_y + 1, n_x); also the forces on the edge values per unit of amplitude.
        """
        weights = self.layer.modes.edge_weights
        against_x, against_slope, against_y, _ = self._rows
        forces = np.empty((2, self.layer.levels, self.layer.modes.n_x))
        for component in (0, 1):
            modes = np.zeros((self.layer.levels, 2, self.layer.modes.n_x))
            modes[0, component] = 1.0
            self.substitute(modes)
            x = modes[:, 0]
            y = modes[:, 1]
            forces[component] = weights[0] * product(against_x, x)
            forces[component] += weights[1] * product(against_slope, x)
            forces[component] += weights[2] * product(against_y, y)
        return forces


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
    rows = LayerFactors(layer, 0.0)
    none = np.zeros_like(displacement.edge)
    for edge in (none, displacement.edge):
        forces = rows.residual(Field(displacement.modes, none), displacement.modes, edge)
        twice -= float(displacement.edge @ forces)
    return 0.5 * twice
