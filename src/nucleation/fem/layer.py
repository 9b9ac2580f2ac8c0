"""One elastic layer on a grid: its matrices along y, inertia and loads, and its factors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..model.material import Material
from ..types import Array
from . import kernels
from .grid import Components, Field, Grid, Terms
from .matrices import element_matrices
from .modes import Modes
from .right_edge import RightEdge

HELD = {
    "free": (False, False),
    "clamped": (True, True),
    "roller": (False, True),
    "velocity": (True, False),
}
"""Which of u_x and u_y are zero on the far side, by its boundary condition; the others are free."""


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
        load.modes[-1], load.edge[-1] = self.modes.uniform_load(self.grid, normal, shear)
        return load

    def translation_load(self, acceleration: float) -> Field:
        """Inertia (N/m) against an acceleration (m/s^2) of the layer along x."""
        load = self.zero_field()
        per_level = -self.material.density * acceleration * self.row_sums
        per_mode = self.modes.sine_amplitudes(np.full(self.modes.n_x, self.grid.dx))
        load.modes[:, 0] = per_level[:, None] * per_mode
        return load

    def add_inertia(self, s: float, terms: Terms, load: Field, out: Field) -> None:
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


class Before(NamedTuple):
    """Displacements (m) before a step with ``u = c1 u_1 + c2 u_2 + beta du/dt``."""

    coefficients: Sequence[float]  # c1 and c2
    beta: float  # s
    newest: Field
    oldest: Field


class LayerFactors:
    """``K + s M`` of a layer for one ``s`` (1/s^2), eliminated mode by mode down to its interface.

    `pivot` is the stiffness on the interface per mode, times 2/n_x (N/m per m): xx, xy, yy.
    """

    def __init__(self, layer: Layer, s: float) -> None:
        self.layer = layer
        modes = layer.modes
        material = layer.material
        density = s * material.density
        self.pivot = np.empty((3, modes.n_x))
        self.inverse = np.zeros((layer.levels, 3, modes.n_x))
        self.lower = np.empty((layer.levels - 1, 4, modes.n_x))
        kernels.factorise(
            material.p_wave_modulus * modes.x_stiffness + density * modes.x_mass,
            material.shear_modulus * modes.x_mass,
            material.shear_modulus * modes.x_stiffness + density * modes.x_mass,
            material.p_wave_modulus * modes.x_mass,
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
        self.edge = RightEdge(self, s) if modes.has_edge else None

    @property
    def megabytes(self) -> float:
        """Memory that the factors hold once all of their parts are in use (MB)."""
        levels = self.layer.levels
        return 8e-6 * levels * (9 * self.layer.modes.n_x + 2 * levels)

    def sweep_down(self, load: Field, edge: Array, out: Array) -> None:
        """Fill `out` with a load (N/m) swept to the interface, with given edge values (m)."""
        profiles = np.zeros((3, edge.size)) if self.edge is None else self.edge.profiles(edge)
        modes = self.layer.modes
        kernels.eliminate(self.lower, load.modes, profiles, modes.edge_weights, modes.scale, out)

    def substitute(self, modes: Array) -> None:
        """Sweep a swept load back from the interface's displacement in level 0, in place.

        At least the two lowest levels are given.
        """
        levels = len(modes)
        kernels.substitute(self.inverse[:levels], self.lower[: levels - 1], modes)

    def move(self, modes: Array, before: Before, rate: Array) -> None:
        """Sweep a swept load back likewise, and fill `rate` (m/s) by the step's formula."""
        (c1, c2), beta, newest, oldest = before
        kernels.move(
            self.inverse, self.lower, modes, c1, c2, beta, newest.modes, oldest.modes, rate
        )
