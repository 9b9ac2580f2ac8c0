"""The elastic body of a simulation: one block or two on their interface, finite or periodic.

The displacement is ``u_x = U(t) + w_x`` and ``u_y``, with the displacement U of a block's driven
left edge. On a grid that is uniform along x the matrices of bilinear elements are sums of Kronecker
products of one-dimensional matrices, and the equations decouple in the modes of :mod:`.modes`. The
paper's right edge is free of sigma_xy too: its values of u_y couple to all modes, and are
eliminated last (:mod:`.right_edge`). The result is that of the assembled matrix to round-off
(tests/fem/test_block.py).

The lower body of two, ``-H2 <= y <= 0``, is stored mirrored, as if it were above the interface:
``y -> -y`` and ``u_y -> -u_y``. The upper one is driven, so that ``w1 = u_x - U(t)`` above and
``w2 = u_x`` below; ``w = w1 - w2`` is the slip less that of the driven edge. Both have the same
``u_y`` on the interface (no opening); on a rigid base ``u_y = 0`` and ``w = w1``.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from . import edge_kernels
from .grid import Components, Field, Motion, Motions, Terms
from .layer import Layers
from .modes import BlockModes
from .operator import Operator
from .right_edge import elastic_energy

LIFTED = 100.0  # times the slip: a translation along y that has grown from round-off


class Body(Layers):
    """The layers as the elastic body of a run."""

    def operator(self, s: float) -> Operator:
        """Factorise the dynamic stiffness ``K + s M`` (`s` in 1/s^2); zero is statics."""
        return Operator(self, s)

    def far_load(self, normal: float, shear: float = 0.0) -> Field:
        """Nodal forces (N/m) of a compressive and, in a period, a shear stress (Pa).

        They act on the far sides that are free, the shear stress in opposite directions.
        """
        shears = (shear, -shear)
        loads = [
            layer.far_load(normal, x)
            for layer, x in zip(
                self.layers,
                shears,
                strict=False,
            )
        ]
        return self.joined(*loads)

    def _of_the_first(self, field: Field) -> Field:
        """A field of the body from one of its first layer, which the driven edge belongs to."""
        return self.joined(field, *(layer.zero_field() for layer in self.layers[1:]))

    def translation_load(self, acceleration: float) -> Field:
        """Inertia (N/m) against an acceleration (m/s^2) along x of all that moves with the edge."""
        return self._of_the_first(self.layers[0].translation_load(acceleration))

    def at_rest(self, displacement: Field, velocity: float) -> Motion:
        """The motion of the body at rest, seen from an edge that moves at a velocity (m/s)."""
        rates = self.layers[0].zero_field()
        ones = np.ones(self.modes.n_x)
        rates.modes[:, 0] = -velocity * self.modes.sine_amplitudes(ones)
        field = self._of_the_first(rates)
        return Motion(displacement, field, self.momentum_x(field))

    def inertia_load(
        self,
        s: float,
        terms: Terms,
        load: Field | None = None,
    ) -> Field:
        """``load + s M sum_i c_i f_i`` (N/m) of at most four terms; `s` in 1/s^2, f_i in m."""
        load = self.zero_field() if load is None else load
        found = Field(np.empty_like(load.modes), np.empty_like(load.edge))
        split = [(coefficient, self.parts(field)) for coefficient, field in terms]
        outputs = zip(
            self.layers,
            self.parts(load),
            self.parts(found),
            strict=True,
        )
        for i, (layer, own, out) in enumerate(outputs):
            layer.add_inertia(
                s,
                [(c, parts[i]) for c, parts in split],
                own,
                out,
            )
        return found

    def momentum_x(self, velocity: Field) -> float:
        """Momentum along x (kg/s per unit depth), at w_t (m/s), of what moves with the edge."""
        return self.layers[0].momentum_x(self.parts(velocity)[0])

    def product(self, load: Field, field: Field) -> float:
        """Work per depth (J/m) of forces (N/m) on a displacement (m)."""
        modes = (load.modes * field.modes).sum(axis=(0, 1)) @ self.modes.norms
        return float(modes + load.edge @ field.edge)

    def far_work(self, loads: tuple[Field, Field], fields: tuple[Field, Field]) -> float:
        """Work (J/m) of far loads (N/m) between two displacements (m), by the trapezoidal rule."""
        pairs = *loads, *fields
        modes = tuple(field.modes for field in pairs)
        edges = tuple(field.edge for field in pairs)
        end = -1
        work = 0.0
        for layer in self.layers:
            end += layer.levels
            work += edge_kernels.work_on_a_level(end, modes, edges, self.modes.norms)
        return work

    def kinetic_energy(self, velocity: Field, of_edge: float) -> float:
        """Kinetic energy (J/m) at a velocity w_t and that of the driven edge (m/s)."""
        own = 0.5 * self.product(self.inertia_load(1.0, [(1.0, velocity)]), velocity)
        return own + of_edge * (self.momentum_x(velocity) + 0.5 * self.total_mass * of_edge)

    def elastic_energy(self, displacement: Field) -> float:
        """Elastic energy (J/m) of a displacement (m)."""
        parts = zip(self.layers, self.parts(displacement), strict=True)
        return sum(elastic_energy(layer, part) for layer, part in parts)

    def nodal_values(self, field: Field, number: int = 0) -> Components:
        """Nodal w_x and u_y of a layer, by its number, levels from the interface on.

        Each has the shape (n_y + 1, n_x + 1).
        """
        x, y = self.layers[number].nodal_values(self.parts(field)[number])
        return x, -y if number else y

    @cached_property
    def _risen(self) -> Field:
        """Both blocks moved up by one metre."""
        assert isinstance(self.modes, BlockModes)
        field = self.zero_field()
        level = self.modes.cosine_amplitudes(np.ones(self.modes.n_x))
        for part, up in zip(
            self.parts(field),
            (1.0, -1.0),
            strict=True,
        ):
            part.modes[:, 1] = up * level
            part.edge[:] = up
        return field

    def settled(
        self,
        motions: Motions,
        step: float,
        slid: float,
    ) -> Motions:
        """Remove a translation of two blocks along y that has grown from round-off.

        If no far side is held, no force acts on such a translation but round-off, which makes it
        grow without bound over minutes. Once it exceeds :data:`LIFTED` times the slip `slid` (m),
        it is removed with its velocity: the motions, the newest first and `step` (s) apart, are
        seen from a corner that does not rise.
        """
        if self.is_held_along_y or not self.modes.has_edge:
            return motions
        rise = float(motions[0].displacement.edge[0])
        rate = float(motions[0].velocity.edge[0])
        if not abs(rise) > LIFTED * slid:
            return motions
        settled = []
        for motion, age in zip(motions, (0.0, step), strict=False):
            displacement = motion.displacement.plus(self._risen.times(age * rate - rise))
            velocity = motion.velocity.plus(self._risen.times(-rate))
            settled.append(Motion(displacement, velocity, motion.momentum))
        return tuple(settled)
