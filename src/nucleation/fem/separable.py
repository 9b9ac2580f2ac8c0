"""Bodies whose finite-element equations separate along x: what they have in common.

On a grid that is uniform along x the matrices of bilinear elements are sums of Kronecker products
of one-dimensional matrices. In modes of one angle theta per element each the equations decouple,
and leave a block-tridiagonal system along y per mode. Which modes these are, and what the ends
along x add, is for each body to say.
"""

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..model.material import Material
from ..types import Array
from . import kernels
from .condensed import Response
from .grid import Field, Grid, Motion, Motions, Terms
from .matrices import element_matrices


class Stacked(NamedTuple):
    """The y-matrices as arrays (3, n_y + 1) for the kernels: lower, diagonal, upper."""

    mass: Array
    stiffness: Array
    derivative: Array
    row_sums: Array  # of the mass


HELD = {
    "free": (False, False), "clamped": (True, True), "roller": (False, True),
    "velocity": (True, False),
}  # fmt: skip
"""Which of u_x and u_y are zero on the far side, by its condition; the others bear loads."""


class SeparableBody(ABC):
    """A layer of a material on a grid, its far side one of :data:`HELD`.

    Parameters
    ----------
    theta : angle of each mode per element, shape (n_x,).
    x_integral : integral along x (m) of each mode of u_x, for the momentum.
    edge_weights : of each mode in the forces on an edge that has unknowns of its own, (3, n_x).
    """

    def __init__(
        self, grid: Grid, material: Material, theta: Array, x_integral: Array,
        edge_weights: Array, far_side: str = "free",
    ) -> None:  # fmt: skip
        self.grid, self.material, self.far_side = grid, material, far_side
        self.mass, self.stiffness, self.derivative = element_matrices(grid.y)
        matrices = self.mass.stacked, self.stiffness.stacked, self.derivative.stacked
        self.stacked = Stacked(*matrices, matrices[0].sum(axis=0))
        self._set_modes(theta, x_integral, edge_weights)

    def _set_modes(self, theta: Array, x_integral: Array, edge_weights: Array) -> None:
        grid = self.grid
        self.x_stiffness = 4.0 * np.sin(theta / 2.0) ** 2 / grid.dx
        self.x_mass = grid.dx * (4.0 + 2.0 * np.cos(theta)) / 6.0
        self.sine = np.sin(theta)
        self.x_integral, self.edge_weights = x_integral, edge_weights
        self.modes = theta.size

    @property
    def free_nodes(self) -> int:
        """Number of the interface's nodes that friction moves, all but the driven edge's."""
        return self.grid.n_x

    def on_all_nodes(self, values: Array, driven: float) -> Array:
        """Values at the free nodes and that of the driven edge's own node, at the nodes 0..n_x."""
        nodal = np.empty(values.size + 1)
        nodal[0], nodal[1:] = driven, values
        return nodal

    @abstractmethod
    def sine_amplitudes(self, nodal: Array) -> Array:
        """Amplitudes of nodal values at i = 1..n_x (last axis) in the basis of u_x."""

    @abstractmethod
    def interface_forces(self, modal: Array) -> tuple[Array, Array]:
        """Nodal forces along x and y whose generalised forces per mode are ``modal * n_x/2``."""

    @abstractmethod
    def nodal_values(self, field: Field) -> tuple[Array, Array]:
        """Nodal w_x and u_y, levels from the interface up."""

    @property
    def crossing_time(self) -> float:
        """Time (s) in which shear waves cross the height."""
        return self.grid.height / self.material.shear_wave_speed

    @property
    def grid_below(self) -> Grid | None:
        """No second body: it stands on a rigid base."""
        return None

    def nodal_values_below(self, field: Field) -> tuple[Array, Array]:
        """There is no second body to have any."""
        raise NotImplementedError

    @property
    def no_memory(self) -> Array:
        """What it remembers before its first step."""
        return np.empty(0)

    def zero_field(self) -> Field:
        """A field of zeros."""
        n = self.grid.n_y + 1
        return Field(np.zeros((n, 2, self.modes)), np.zeros(n))

    @property
    def total_mass(self) -> float:
        """Mass of the body (kg/m)."""
        return self.material.density * self.grid.length * self.grid.height

    def translation_load(self, acceleration: float) -> Field:
        """Inertia (N/m) against an acceleration (m/s^2) of the whole body along x.

        In the scaling of all loads, per mode times 2/n_x.
        """
        load = self.zero_field()
        per_level = -self.material.density * acceleration * self.stacked.row_sums
        per_mode = self.sine_amplitudes(np.full(self.modes, self.grid.dx))
        load.modes[:, 0] = per_level[:, None] * per_mode
        return load

    def inertia_load(self, s: float, terms: Terms, load: Field | None = None) -> Field:
        """``load + s M sum_i c_i f_i`` for terms ``(c_i, f_i)``, in the scaling of `top_load`."""
        load = self.zero_field() if load is None else load
        terms = [*terms, *[(0.0, terms[0][1])] * (4 - len(terms))]  # the kernel takes four
        coefficients, fields = zip(*terms, strict=True)
        rho_s = s * self.material.density
        modes, edge = kernels.add_inertia(
            self.stacked.mass, rho_s * self.x_mass, rho_s * self.grid.dx / 6.0,
            self.edge_weights[2], 2.0 / self.grid.n_x, coefficients,
            tuple(field.modes for field in fields), tuple(field.edge for field in fields),
            load.modes, load.edge,
        )  # fmt: skip
        return Field(modes, edge)

    def motion(
        self, past: Sequence[float], beta: float, displacement: Field, motions: Sequence[Motion]
    ) -> Motion:
        """The motion at a new displacement, of which one past value or two are taken.

        Its velocity is the rate by ``u = sum_i past_i u_i + beta du/dt``, newest value first.
        """
        velocity = rate_of_change(past, beta, displacement, motions)
        return Motion(displacement, velocity, self.momentum_x(velocity))

    def settled(self, motions: Motions, step: float, slid: float) -> Motions:
        """The motions themselves: what holds the body holds it along y too."""
        return motions

    def at_rest(self, displacement: Field, velocity: float) -> Motion:
        """The motion of a body at rest, seen from its driven edge (velocity in m/s)."""
        rates = self.zero_field()
        rates.modes[:, 0] = -velocity * self.sine_amplitudes(np.ones(self.modes))
        return Motion(displacement, rates, self.momentum_x(rates))

    def momentum_x(self, velocity: Field) -> float:
        """Momentum along x of the velocity field w_t (kg/s per unit depth)."""
        along_x = velocity.modes[:, 0] @ self.x_integral
        return self.material.density * float(self.stacked.row_sums @ along_x)


def rate_of_change(
    past: Sequence[float], beta: float, displacement: Field, motions: Sequence[Motion]
) -> Field:
    """The rate (m/s) of a displacement by ``u = c1 u_1 + c2 u_2 + beta du/dt``, newest first."""
    c1, c2 = past
    u, u_past = motions[0].displacement, motions[-1].displacement
    rates = np.empty_like(displacement.modes)
    kernels.rate_of_change(c1, c2, beta, displacement.modes, u.modes, u_past.modes, rates)
    return Field(rates, (displacement.edge - c1 * u.edge - c2 * u_past.edge) / beta)


@dataclasses.dataclass(frozen=True)
class LoadedResponse(Response):
    """A response with the load (N/m) that it is to."""

    load: Field


class SeparableOperator:
    """``K + s M`` of a body for one ``s`` (1/s^2), with ``s = 0`` for statics."""

    def __init__(self, body: SeparableBody, s: float) -> None:
        self.body, self.s = body, s
        grid, material = body.grid, body.material
        lame, shear = material.lame_modulus, material.shear_modulus
        p_modulus, rho_s = material.p_wave_modulus, s * material.density
        # stiffness on the interface per mode, times 2/n_x (N/m per m): xx, xy, yy
        self.pivot = np.empty((3, body.modes))
        self._inverse = np.zeros((grid.n_y + 1, 3, body.modes))
        self._lower = np.empty((grid.n_y, 4, body.modes))
        kernels.factorise(
            p_modulus * body.x_stiffness + rho_s * body.x_mass, shear * body.x_mass,
            shear * body.x_stiffness + rho_s * body.x_mass, p_modulus * body.x_mass,
            body.sine, body.stacked.mass, body.stacked.stiffness, body.stacked.derivative,
            lame, material.coupling_modulus, HELD[body.far_side], self.pivot, self._inverse,
            self._lower,
        )  # fmt: skip

    def solve(self, load: Field, w_amplitudes: Array, edge: Array) -> tuple[Array, Array]:
        """Modes of the bulk for a given interface ``w`` (amplitudes) and given edge values.

        Returns the mode amplitudes (n_y + 1, 2, n_x) and the reduced load at the interface
        (2, n_x); all loads in the scaling of a body's ``top_load`` (N/m).
        """
        modes = self.swept(load, edge)
        reduced = modes[0].copy()
        modes[0, 0], modes[0, 1] = w_amplitudes, 0.0
        self.substitute(modes)
        return modes, reduced

    def substitute(self, modes: Array) -> None:
        """The backward sweep from the interface, whose displacement is known, in place.

        Of `modes` only some lowest levels may be given, at least two.
        """
        kernels.substitute(self._inverse[: len(modes)], self._lower[: len(modes) - 1], modes)

    def swept(self, load: Field, edge: Array, modes: Array | None = None) -> Array:
        """The forward sweep from the top down to the interface, into `modes` if they are given."""
        modes = np.empty_like(load.modes) if modes is None else modes
        kernels.eliminate(
            self._lower, load.modes, self._profiles(edge), self.body.edge_weights,
            2.0 / self.body.grid.n_x, modes,
        )  # fmt: skip
        return modes

    def interface_forces(
        self, w_amplitudes: Array, reduced: Array | float = 0.0
    ) -> tuple[Array, Array]:
        """Nodal tangential forces at 1..n_x and normal forces at 0..n_x - 1 (N/m), edge apart."""
        return self.body.interface_forces(self.pivot[:2] * w_amplitudes - reduced)

    def _profiles(self, edge: Array) -> Array:
        """What given edge values do to the modes, as profiles along y: nothing without an edge."""
        return np.zeros((3, edge.size))

    @property
    def megabytes(self) -> float:
        """Memory that this operator holds once all of its parts are in use (MB)."""
        grid = self.body.grid
        levels = grid.n_y + 1
        return 8e-6 * levels * (9 * grid.n_x + 2 * levels)
