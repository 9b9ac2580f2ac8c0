"""The elastic body of a simulation: one block or two on their interface, finite or periodic.

The displacement is ``u_x = U(t) + w_x`` and ``u_y``, with the displacement U of a block's driven
left edge. On a grid that is uniform along x the matrices of bilinear elements are sums of Kronecker
products of one-dimensional matrices, and the equations decouple in the modes of :mod:`.modes`. The
paper's right edge is free of sigma_xy too: its values of u_y couple to all modes, and are
eliminated last (:mod:`.right_edge`). The result is that of the assembled matrix to round-off
(tests/fem/test_bodies.py).

The lower body of two, ``-H2 <= y <= 0``, is stored mirrored, as if it were above the interface:
``y -> -y`` and ``u_y -> -u_y``. The upper one is driven, so that ``w1 = u_x - U(t)`` above and
``w2 = u_x`` below; ``w = w1 - w2`` is the slip less that of the driven edge. Both have the same
``u_y`` on the interface (no opening); on a rigid base ``u_y = 0`` and ``w = w1``.

A tridiagonal matrix A of size n along y is an array (3, n) of its diagonals: ``A[i, i-1]``,
``A[i, i]`` and ``A[i, i+1]`` in row i. The first entry of the first diagonal and the last entry of
the last one are zero.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from ..model.material import Material
from ..types import Array
from . import kernels
from .grid import Field, Grid, Motion
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
    return mass, stiffness, np.array([-left, left - right, right])


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
        self.mass, self.stiffness, self.derivative = element_matrices(grid.y)
        self.row_sums = self.mass.sum(axis=0)


class Body:
    """One layer on a rigid base, or two on one another, each a grid and a material.

    The far side of the first one is free; `far_side` is that of the second one. If both are free,
    both bear the same normal stress. Raises ValueError if the elements of two layers along x
    differ, or n_x of a period is even.
    """

    def __init__(
        self,
        upper: tuple[Grid, Material],
        lower: tuple[Grid, Material] | None = None,
        far_side: str = "free",
    ) -> None:
        self.grid, material = upper
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
        # m/s per Pa, of the faces apart by waves that leave the interface; infinite without inertia
        impedances = [
            layer.material.density * layer.material.shear_wave_speed for layer in self.layers
        ]
        self.admittance = sum(1.0 / one if one > 0.0 else np.inf for one in impedances)
        # kg/m, that moves with the driven edge
        self.total_mass = material.density * self.grid.length * self.grid.height

    @property
    def is_held_along_y(self) -> bool:
        """Whether the base, or the lower far side, is held along y."""
        return len(self.layers) == 1 or self.layers[1].held[1]

    @property
    def is_held(self) -> bool:
        """Whether at given slip no layer can move as a whole."""
        return not self.translations

    @cached_property
    def translations(self) -> tuple[Translation, ...]:
        """The translations that nothing holds, one along each such direction."""
        if len(self.layers) == 1:
            return ()
        along_x, along_y = self.layers[1].held
        free = (not (along_x or self.modes.has_edge), not along_y)
        return tuple(Translation(self, component) for component in (0, 1) if free[component])

    @property
    def operator_megabytes(self) -> float:
        """Memory of ``K + s M`` for one s, once all of its parts are in use (MB)."""
        n = self.modes.n_x
        levels = [layer.levels for layer in self.layers]
        numbers = sum(each * (9 * n + 2 * each) for each in levels)
        if len(levels) == 2:
            numbers += 13 * n + 2 * sum(levels) ** 2
        return 8e-6 * numbers

    def split(self, values: Array) -> list[Array]:
        """Views of an array over levels: each layer's."""
        above = self.layers[0].levels
        return [values] if len(self.layers) == 1 else [values[:above], values[above:]]

    def parts(self, field: Field) -> list[Field]:
        """Views of a field: each layer's, the lower one's mirrored."""
        if len(self.layers) == 1:
            return [field]
        return list(map(Field, self.split(field.modes), self.split(field.edge)))

    def zero_field(self) -> Field:
        """A field of zeros."""
        levels = sum(layer.levels for layer in self.layers)
        return Field(np.zeros((levels, 2, self.modes.n_x)), np.zeros(levels))

    def far_load(self, normal: float, shear: float = 0.0) -> Field:
        """Nodal forces (N/m) of a compressive and, in a period, a shear stress (Pa).

        They act on the far sides that are free, the shear stress in opposite directions.
        """
        load = self.zero_field()
        for layer, part, along_x in zip(
            self.layers, self.parts(load), (shear, -shear), strict=False
        ):
            held_x, held_y = layer.held
            part.modes[-1], part.edge[-1] = self.modes.uniform_load(
                layer.grid, 0.0 if held_y else normal, 0.0 if held_x else along_x
            )
        return load

    def translation_load(self, acceleration: float) -> Field:
        """Inertia (N/m) against an acceleration (m/s^2) along x of all that moves with the edge."""
        first = self.layers[0]
        load = self.zero_field()
        per_level = -first.material.density * acceleration * first.row_sums
        per_mode = self.modes.sine_amplitudes(np.full(self.modes.n_x, self.grid.dx))
        load.modes[: first.levels, 0] = per_level[:, None] * per_mode
        return load

    def at_rest(self, displacement: Field, velocity: float, factors: Array) -> Motion:
        """The motion of the body at rest, seen from an edge that moves at a velocity (m/s).

        `factors` are those of the loads. Where nothing holds the body, its centre of mass is the
        origin.
        """
        for free in self.translations:
            free.taken_from(displacement, free.of(displacement))
        rates = self.zero_field()
        ones = self.modes.sine_amplitudes(np.ones(self.modes.n_x))
        rates.modes[: self.layers[0].levels, 0] = -velocity * ones
        return Motion(displacement, rates, self.momentum_x(rates), factors, np.zeros_like(factors))

    def combined(self, loads: Sequence[Field], factors: Array) -> Field:
        """The sum of some loads (N/m) times their factors."""
        total = None
        for load, factor in zip(loads, factors.tolist(), strict=True):
            if factor != 0.0:
                part = load if factor == 1.0 else load.times(factor)
                total = part if total is None else total.plus(part)
        return self.zero_field() if total is None else total

    def work(self, load: Field, way: Field) -> float:
        """Work (J/m) of a load (N/m) on a displacement (m)."""
        of_modes = (load.modes * way.modes).sum(axis=(0, 1))
        return float(of_modes @ self.modes.norms + load.edge @ way.edge)

    def inertia_load(self, s: float, terms: Sequence[tuple[float, Field]], load: Field) -> Field:
        """``load + s M sum_i c_i f_i`` (N/m) of at most four terms; `s` in 1/s^2, f_i in m."""
        found = Field(np.empty_like(load.modes), np.empty_like(load.edge))
        nothing = (0.0, terms[0][1])
        missing = 4 - len(terms)  # the kernel takes four terms
        coefficients, fields = zip(*terms, *[nothing] * missing, strict=True)
        split = zip(*map(self.parts, fields), strict=True)
        for layer, of_layer, own, out in zip(
            self.layers, split, self.parts(load), self.parts(found), strict=True
        ):
            density = s * layer.material.density
            kernels.add_inertia(
                layer.mass,
                density * self.modes.x_mass,
                density * self.grid.dx / 6.0,
                self.modes.edge_weights[2],
                self.modes.scale,
                coefficients,
                tuple(field.modes for field in of_layer),
                tuple(field.edge for field in of_layer),
                own.modes,
                own.edge,
                out.modes,
                out.edge,
            )
        return found

    def momentum_x(self, velocity: Field) -> float:
        """Momentum along x (kg/s per unit depth), at w_t (m/s), of what moves with the edge."""
        first = self.layers[0]
        along_x = velocity.modes[: first.levels, 0] @ self.modes.x_integral
        return first.material.density * float(first.row_sums @ along_x)

    def kinetic_energy(self, velocity: Field, of_edge: float) -> float:
        """Kinetic energy (J/m) at a velocity w_t and that of the driven edge (m/s)."""
        momentum = self.inertia_load(1.0, [(1.0, velocity)], self.zero_field())
        own = 0.5 * self.work(momentum, velocity)
        return own + of_edge * (self.momentum_x(velocity) + 0.5 * self.total_mass * of_edge)


class Translation:
    """A translation of two layers as a whole, along a direction in which nothing holds them.

    All loads on a body are in balance along such a direction, so its centre of mass stays where it
    is, and there is no stiffness that would hold it against round-off. It is kept in place by
    :meth:`taken_from`: positions are seen from the centre of mass.
    """

    def __init__(self, body: Body, component: int) -> None:
        """The component 0 is along x, 1 along y."""
        self._component = component
        signs = (1.0, 1.0) if component == 0 else (1.0, -1.0)  # the lower layer is mirrored
        unit = body.zero_field()  # one metre
        for part, sign in zip(body.parts(unit), signs, strict=True):
            part.modes[:, component] = sign * body.modes.level
            part.edge[:] = sign * component * body.modes.has_edge
        inertia = body.inertia_load(1.0, [(1.0, unit)], body.zero_field())
        self.mass = body.work(inertia, unit)  # kg/m
        along_x = unit.modes[0, component]
        self._row = along_x[: np.flatnonzero(along_x)[-1] + 1].copy()
        self._signs = np.concatenate(
            [np.full(layer.levels, sign) for layer, sign in zip(body.layers, signs, strict=True)]
        )
        self._edge = unit.edge
        weights = inertia.modes[:, component] * body.modes.norms / self.mass
        self._weights = weights[:, : self._row.size].copy()
        self._edge_weights = inertia.edge / self.mass

    def of(self, field: Field) -> float:
        """The displacement (m) or velocity (m/s) of the centre of mass."""
        modes = field.modes[:, self._component, : self._row.size]
        of_modes = np.einsum("ij,ij->", self._weights, modes)
        return float(of_modes + self._edge_weights @ field.edge)

    def taken_from(self, field: Field, amount: float) -> None:
        """Subtract a translation (m, or m/s) from a field, in place."""
        kernels.translate(field.modes, self._component, -amount * self._signs, self._row)
        field.edge[:] -= amount * self._edge
