"""The same solver on a block that is periodic along x: homogeneous sliding and its modes.

On n_x nodes (an odd number) per period, ``theta_m = 2 pi m / n_x``, the modes are

    u_x = W0 + sum_m A_m sin(theta_m i) + B_m cos(theta_m i),   m = 1..(n_x - 1)/2
    u_y = U0 + sum_m A_m cos(theta_m i) - B_m sin(theta_m i),   i = 0..n_x - 1

with other A_m, B_m for either component. Each of the sets A and B obeys the block-tridiagonal
system of :mod:`.separable` at its theta, B being A shifted by a quarter wave; a travelling wave is
the pair. There is no driven and no free edge: traction on the top drives the block. The interface,
the step and the factorisation are those of the block.

Interface arrays over "nodes 0..n_x" hold the period's nodes in the entries 1..n_x. Entry 0, in the
block the node of the driven edge, repeats the last one.
"""

from __future__ import annotations

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import fft
from scipy.linalg import circulant

from ..model.material import Material
from ..types import Array
from .condensed import Balance, Expectation
from .grid import Field, Grid
from .separable import LoadedResponse, SeparableBody, SeparableOperator


class PeriodicBlock(SeparableBody):
    """A layer of one period along x on the interface y = 0."""

    def __init__(self, grid: Grid, material: Material, far_side: str = "free") -> None:
        if grid.n_x % 2 == 0:
            raise ValueError(f"n_x = {grid.n_x} is not allowed: it must be odd in a periodic body")
        grid = dataclasses.replace(grid, periodic=True)
        half = np.arange(1, grid.n_x // 2 + 1)
        theta = 2.0 * np.pi / grid.n_x * np.concatenate(([0], half, half))
        x_integral, no_edge = np.where(theta == 0.0, grid.length, 0.0), np.zeros((3, grid.n_x))
        super().__init__(grid, material, theta, x_integral, no_edge, far_side)

    def on_all_nodes(self, values: Array, driven: float) -> Array:
        """Values at the nodes 0..n_x, of which the first one is the last."""
        return with_entry_zero(values)

    def operator(self, s: float) -> PeriodicOperator:
        """The dynamic stiffness ``K + s M`` (`s` in 1/s^2), condensed on the interface."""
        return PeriodicOperator(self, s)

    def _split(self, amplitudes: Array) -> tuple[Array, Array, Array]:
        """The mean, A and B."""
        half = self.grid.n_x // 2
        return amplitudes[..., :1], amplitudes[..., 1 : half + 1], amplitudes[..., half + 1 :]

    def _values(self, mean: Array, coefficients: NDArray[np.complex128]) -> Array:
        """``mean + Re sum_m c_m exp(i theta_m i)`` at all nodes."""
        n = self.grid.n_x
        spectrum = np.concatenate((n * mean, 0.5 * n * coefficients), axis=-1)
        return fft.irfft(spectrum, n)

    def sine_amplitudes(self, nodal: Array) -> Array:
        """Amplitudes of nodal values (last axis) in the basis of u_x."""
        c = fft.rfft(nodal) / self.grid.n_x
        return np.concatenate((c[..., :1].real, -2 * c[..., 1:].imag, 2 * c[..., 1:].real), axis=-1)

    def sine_values(self, amplitudes: Array) -> Array:
        """Nodal values (last axis) of amplitudes in the basis of u_x."""
        mean, a, b = self._split(amplitudes)
        return self._values(mean, b - 1j * a)

    def cosine_values(self, amplitudes: Array) -> Array:
        """Nodal values (last axis) of amplitudes in the basis of u_y."""
        mean, a, b = self._split(amplitudes)
        return self._values(mean, a + 1j * b)

    def interface_forces(self, modal: Array) -> tuple[Array, Array]:
        """Nodal forces along x and y of modal ones, (2, n_x): all nodes are alike."""
        return self.sine_values(modal[0]), self.cosine_values(modal[1])

    def top_load(self, normal_stress: float, shear_stress: float = 0.0) -> Field:
        """Nodal forces of a compressive and a shear stress (Pa) on the top (N/m)."""
        load = self.zero_field()
        load.modes[-1, :, 0] = shear_stress * self.grid.dx, -normal_stress * self.grid.dx
        return load

    def nodal_values(self, field: Field) -> tuple[Array, Array]:
        """Nodal w_x and u_y, each of shape (n_y + 1, n_x + 1), the first column as the last."""
        x, y = self.sine_values(field.modes[:, 0]), self.cosine_values(field.modes[:, 1])
        return np.hstack((x[:, -1:], x)), np.hstack((y[:, -1:], y))


class Circulant(ABC):
    """D and N between the nodes of a period, from those between its modes."""

    @property
    @abstractmethod
    def along_x(self) -> PeriodicBlock:
        """A layer with the modes."""

    @abstractmethod
    def interface_forces(
        self, w_amplitudes: Array, reduced: Array | float = 0.0
    ) -> tuple[Array, Array]:
        """Nodal forces along x and y (N/m) at all nodes."""

    def apply(self, w: Array) -> tuple[Array, Array]:
        """``D w`` and ``N w`` (with entry 0)."""
        p, reaction = self.interface_forces(self.along_x.sine_amplitudes(w))
        return p, with_entry_zero(reaction)

    @cached_property
    def _columns(self) -> tuple[Array, Array]:
        """First columns of D and N."""
        unit = np.zeros(self.along_x.grid.n_x)
        unit[0] = 1.0
        p, normal = self.apply(unit)
        return p, normal[1:]

    @cached_property
    def diagonal(self) -> Array:
        """Diagonal of D (N/m per m), shape (n_x,)."""
        return np.full(self.along_x.grid.n_x, self._columns[0][0])

    def tangent(self, nodes: NDArray[np.intp], dtype: type = float) -> tuple[NDArray, NDArray]:
        """Dense blocks of D and N between some interface nodes (in 1..n_x), (n, n)."""
        every = nodes.size == self.along_x.grid.n_x
        block: Any = ... if every else np.ix_(nodes - 1, nodes - 1)
        stiffness, coupling = self._dense
        return stiffness[block].astype(dtype), coupling[block].astype(dtype)

    @cached_property
    def _dense(self) -> list[Array]:
        """D and N between all nodes."""
        return [circulant(column) for column in self._columns]


class PeriodicOperator(SeparableOperator, Circulant):
    """``K + s M`` of a :class:`PeriodicBlock`; D and N are circulant."""

    body: PeriodicBlock

    @property
    def along_x(self) -> PeriodicBlock:
        """The layer itself."""
        return self.body

    def respond(self, load: Field, w: Array) -> LoadedResponse:
        """The forces that hold the interface at nodal `w` (m) under a load; there is no edge."""
        amplitudes = self.body.sine_amplitudes(w)
        _, reduced = self.solve(load, amplitudes, np.zeros_like(load.edge))
        tangential, normal = self.interface_forces(amplitudes, reduced)
        return LoadedResponse(w, tangential, with_entry_zero(normal), load)

    def responses(self, load: Field, w: Array, expected: Expectation) -> Iterator[LoadedResponse]:
        """The one response at nodal `w` (m) under a load."""
        yield self.respond(load, w)

    def balance(
        self, response: LoadedResponse, w: Array, expected: Expectation | None = None
    ) -> Balance:
        """The layer at nodal `w` (m) under the load of a response."""
        edge = np.zeros_like(response.load.edge)
        modes, _ = self.solve(response.load, self.body.sine_amplitudes(w), edge)
        return Balance(Field(modes, edge), self.body.no_memory, True)


def with_entry_zero(nodal: Array) -> Array:
    """Values at the period's nodes as an interface array: entry 0 repeats the last node."""
    return np.concatenate((nodal[-1:], nodal))
