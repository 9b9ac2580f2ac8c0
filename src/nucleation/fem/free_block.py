"""A block, or a pair, that is free at both side edges and moved at its top.

Any displacement is the sum of two parts about the middle of the block: one in which u_x is odd and
u_y even, as in a half block that is held along x in the middle, which is a :class:`.block.Block`
with its left edge there; and one in which u_x is even and u_y odd (:class:`EvenHalf`). On a grid of
an even number of elements either is a block of half the length with one free edge, and they do not
know of each other: stiffness, inertia, edge and interface are those of :mod:`.block` and
:mod:`.pair`. A node at ``c + i`` from the middle node c has the sum of both, one at ``c - i`` their
difference, and the interface's nodes 0..n_x are all free.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ..model.material import Material
from ..types import Array
from .block import Block
from .condensed import Balance, Expectation, Response
from .grid import Field, Grid, Motion, Motions, Terms
from .pair import Pair


class EvenHalf(Block):
    """The right half of a block in which u_x is even about the middle and u_y odd.

    The modes are ``u_x = cos(theta_m i)``, ``u_y = -sin(theta_m i)`` with ``theta_m = m pi/n_x``,
    m = 0..n_x; the first and the last one over the square root of two, as their norm is twice that
    of the others. Of the interface the nodes 0..n_x are free, and count as a block's 1..n_x + 1;
    its node 0 is here the mirror image of node 1.
    """

    def __init__(self, grid: Grid, material: Material, far_side: str = "free") -> None:
        super().__init__(grid, material, far_side)
        n = grid.n_x
        self._ends = np.ones(n + 1)
        self._ends[[0, -1]] = 0.5**0.5
        theta = np.arange(n + 1) * np.pi / n
        weights = [np.sin(theta / 2.0) ** 2, np.cos(theta / 2.0) ** 2, np.sin(theta)]
        weights = (-1.0) ** np.arange(n + 1) * self._ends * np.array(weights)
        x_integral = np.append(grid.length * self._ends[0], np.zeros(n))
        self._set_modes(theta, x_integral, weights)

    @property
    def free_nodes(self) -> int:
        """Number of the interface's nodes that friction moves."""
        return self.modes

    def sine_amplitudes(self, nodal: Array) -> Array:
        """Amplitudes of u_x from nodal values at i = 0..n_x (last axis)."""
        scaled = (2.0 / self.grid.n_x) ** 0.5 * self._ends * nodal
        return fft.dct(scaled, type=1, norm="ortho")

    def sine_values(self, amplitudes: Array) -> Array:
        """Nodal values of u_x at i = 0..n_x (last axis)."""
        values = fft.dct(amplitudes, type=1, norm="ortho")
        return values * (self.grid.n_x / 2.0) ** 0.5 / self._ends

    def cosine_values(self, amplitudes: Array) -> Array:
        """Nodal values of u_y at i = -1..n_x - 1 (last axis)."""
        inner = -0.5 * fft.dst(amplitudes[..., 1:-1], type=1)
        return np.concatenate((-inner[..., :1], np.zeros_like(inner[..., :1]), inner), axis=-1)

    def interface_forces(self, modal: Array) -> tuple[Array, Array]:
        """Nodal forces along x at i = 0..n_x and along y at i = -1..n_x - 1 of modal ones."""
        return self._ends**2 * self.sine_values(modal[0]), self.cosine_values(modal[1])

    def forces(self, stiffness: Array, amplitudes: Array, reduced: Array) -> tuple[Array, Array]:
        """Nodal forces of ``stiffness * amplitudes - reduced`` per mode: x 0..n_x, y -1..n_x."""
        tangential, normal = self.interface_forces(stiffness * amplitudes - reduced)
        return tangential, np.append(normal, 0.0)

    def top_load(self, normal_stress: float) -> Field:
        """None: an even stress on the top belongs to the other half."""
        return self.zero_field()

    def nodal_values(self, field: Field) -> tuple[Array, Array]:
        """Nodal w_x and u_y at i = 0..n_x, each of shape (n_y + 1, n_x + 1)."""
        y = self.cosine_values(field.modes[:, 1])[:, 1:]
        return self.sine_values(field.modes[:, 0]), np.hstack((y, field.edge[:, None]))


class FreeBlock:
    """A block, or two, with free side edges; seen from its top, which is moved along x.

    Its `odd` and `even` right halves have u_x odd and even about the middle; the (upper) block's
    `grid` has an even number of elements along x.
    """

    def __init__(self, grid: Grid, odd: Block | Pair, even: Block | Pair) -> None:
        self.grid, self.odd, self.even, self.halves = grid, odd, even, (odd, even)

    @property
    def grid_below(self) -> Grid | None:
        """The mesh of a second block."""
        below = self.odd.grid_below
        return None if below is None else dataclasses.replace(
            below, length=self.grid.length, n_x=self.grid.n_x
        )  # fmt: skip

    @property
    def crossing_time(self) -> float:
        """Time (s) in which shear waves cross the block."""
        return self.odd.crossing_time

    @property
    def no_memory(self) -> Array:
        """It remembers nothing."""
        return np.empty(0)

    @property
    def free_nodes(self) -> int:
        """All of the interface's nodes."""
        return self.grid.n_x + 1

    def on_all_nodes(self, values: Array, driven: float) -> Array:
        """The values themselves: no node of the interface is driven."""
        return values

    def operator(self, s: float) -> FreeOperator:
        """The dynamic stiffness ``K + s M`` (`s` in 1/s^2), condensed on the interface."""
        return FreeOperator(self, s)

    def parts(self, field: Field) -> list[Field]:
        """The fields of both halves in one."""
        n, levels = self.grid.n_x // 2, field.modes.shape[0]
        odd, even = map(np.ascontiguousarray, (field.modes[..., :n], field.modes[..., n:]))
        return [Field(odd, field.edge[:levels]), Field(even, field.edge[levels:])]

    def joined(self, odd: Field, even: Field) -> Field:
        """The field of both halves."""
        modes = np.concatenate((odd.modes, even.modes), axis=-1)
        return Field(modes, np.concatenate((odd.edge, even.edge)))

    def halved(self, w: Array) -> tuple[Array, Array]:
        """Odd and even part of nodal values along x, at the halves' free nodes."""
        n = self.grid.n_x // 2
        right, left = w[n:], w[n::-1]
        return 0.5 * (right - left)[1:], 0.5 * (right + left)

    def whole(self, odd: Array, even: Array) -> Array:
        """Nodal values (last axis) of a part that is odd and one that is even, at i = 0..n_x/2."""
        return np.concatenate(((even - odd)[..., :0:-1], even + odd), axis=-1)

    def settled(self, motions: Motions, step: float, slid: float) -> Motions:
        """The motions themselves: its second body has to be clamped."""
        return motions

    def at_rest(self, displacement: Field, velocity: float) -> Motion:
        """The motion of the block at rest, seen from its top that moves at a velocity (m/s)."""
        motion = self.even.at_rest(self.parts(displacement)[1], velocity)
        rates = self.joined(self.odd.zero_field(), motion.velocity)
        return Motion(displacement, rates, 2.0 * motion.momentum)

    @property
    def total_mass(self) -> float:
        """Mass (kg/m) of the (upper) block."""
        return 2.0 * self.even.total_mass

    def translation_load(self, acceleration: float) -> Field:
        """Inertia (N/m) against an acceleration (m/s^2) of the top and the block with it."""
        return self.joined(self.odd.zero_field(), self.even.translation_load(acceleration))

    def top_load(self, normal_stress: float) -> Field:
        """Nodal forces (N/m) of a compressive stress (Pa) on the top."""
        return self.joined(*(half.top_load(normal_stress) for half in self.halves))

    def inertia_load(self, s: float, terms: Terms, load: Field | None = None) -> Field:
        """``load + s M sum_i c_i f_i`` for terms ``(c_i, f_i)``, as of either half."""
        split = [(c, self.parts(field)) for c, field in terms]
        loads = (None, None) if load is None else self.parts(load)
        return self.joined(
            *(
                half.inertia_load(s, [(c, fields[i]) for c, fields in split], loads[i])
                for i, half in enumerate(self.halves)
            )
        )

    def motion(
        self, past: Sequence[float], beta: float, displacement: Field, motions: Sequence[Motion]
    ) -> Motion:
        """The motion at a new displacement; only the even half has a momentum along x."""
        split = [self.parts(motion.displacement) for motion in motions]
        odd, even = (
            half.motion(past, beta, own, [Motion(f[i], f[i], 0.0) for f in split])
            for i, (half, own) in enumerate(zip(self.halves, self.parts(displacement), strict=True))
        )
        velocity = self.joined(odd.velocity, even.velocity)
        return Motion(displacement, velocity, 2.0 * even.momentum)

    def nodal_values(self, field: Field) -> tuple[Array, Array]:
        """Nodal w_x and u_y of the (upper) block, each of shape (n_y + 1, n_x + 1)."""
        return self._nodal("nodal_values", field)

    def nodal_values_below(self, field: Field) -> tuple[Array, Array]:
        """Nodal u_x and u_y of the second block, its levels from the interface down."""
        return self._nodal("nodal_values_below", field)

    def _nodal(self, method: str, field: Field) -> tuple[Array, Array]:
        (odd_x, even_y), (even_x, odd_y) = (
            getattr(half, method)(own)
            for half, own in zip(self.halves, self.parts(field), strict=True)
        )
        return self.whole(odd_x, even_x), self.whole(odd_y, even_y)


@dataclasses.dataclass(frozen=True)
class FreeResponse(Response):
    """A response and those of both halves."""

    halves: tuple[Any, Any]


class FreeOperator:
    """``K + s M`` of a :class:`FreeBlock` for one ``s`` (1/s^2), with ``s = 0`` for statics."""

    def __init__(self, body: FreeBlock, s: float) -> None:
        self.body, self.s = body, s
        self.halves = tuple(half.operator(s) for half in body.halves)

    @property
    def megabytes(self) -> float:
        """Memory that this operator holds once all of its parts are in use (MB)."""
        dense = 16e-6 * self.body.free_nodes**2
        return sum(half.megabytes for half in self.halves) + dense

    def _forces(self, odd: tuple[Array, Array], even: tuple[Array, Array]) -> tuple[Array, Array]:
        """Nodal forces at all nodes from those on the halves: tangential, normal."""
        (odd_x, even_y), (even_x, odd_y) = odd, even
        x = self.body.whole(np.insert(odd_x, 0, 0.0, axis=-1), even_x)
        y = self.body.whole(odd_y[..., 1:], even_y)
        middle = self.body.grid.n_x // 2  # which belongs to both halves of the block
        x[..., middle] *= 2.0
        y[..., middle] *= 2.0
        return x, y

    def apply(self, w: Array) -> tuple[Array, Array]:
        """``D w`` and ``N w`` (N/m) at all nodes, for w (m) there."""
        parts = zip(self.halves, self.body.halved(w), strict=True)
        return self._forces(*(half.apply(own) for half, own in parts))

    @cached_property
    def _dense(self) -> tuple[Array, Array]:
        """D and N between all nodes, a column for each node that moves."""
        columns = [self.apply(unit) for unit in np.eye(self.body.free_nodes)]
        stiffness, coupling = (np.array(forces).T for forces in zip(*columns, strict=True))
        return stiffness, coupling

    @property
    def diagonal(self) -> Array:
        """Diagonal of D (N/m per m), (n_x + 1,)."""
        return np.ascontiguousarray(self._dense[0].diagonal())

    def tangent(self, nodes: NDArray[np.intp], dtype: type = float) -> tuple[NDArray, NDArray]:
        """Dense blocks of D and N between some nodes, counted from 1, (n, n) each."""
        block = np.ix_(nodes - 1, nodes - 1)
        stiffness, coupling = self._dense
        return stiffness[block].astype(dtype), coupling[block].astype(dtype)

    def respond(self, load: Field, w: Array) -> FreeResponse:
        """The forces that hold the interface at nodal `w` (m) under a load, edges in balance."""
        parts = zip(self.halves, self.body.parts(load), self.body.halved(w), strict=True)
        odd, even = (half.respond(own, at) for half, own, at in parts)
        forces = self._forces((odd.tangential, odd.normal), (even.tangential, even.normal))
        return FreeResponse(w, *forces, (odd, even))

    def responses(self, load: Field, w: Array, expected: Expectation) -> Iterator[FreeResponse]:
        """The one response at nodal `w` (m) under a load."""
        yield self.respond(load, w)

    def balance(
        self, response: FreeResponse, w: Array, expected: Expectation | None = None
    ) -> Balance:
        """The block at nodal `w` (m) under the load of a response."""
        parts = zip(self.halves, response.halves, self.body.halved(w), strict=True)
        fields = [half.balance(own, at).displacement for half, own, at in parts]
        return Balance(self.body.joined(*fields), self.body.no_memory, True)
