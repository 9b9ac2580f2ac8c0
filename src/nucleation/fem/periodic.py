"""The same solver on a block that is periodic along x: homogeneous sliding and its modes.

On n_x nodes (an odd number) per period, ``theta_m = 2 pi m / n_x``, the modes are

    u_x = W0 + sum_m A_m sin(theta_m i) + B_m cos(theta_m i),   m = 1..(n_x - 1)/2
    u_y = U0 + sum_m A_m cos(theta_m i) - B_m sin(theta_m i),   i = 0..n_x - 1

with other A_m, B_m for each component. Each of the sets A and B obeys the block-tridiagonal system
of :mod:`.separable` at its theta; B is A shifted by a quarter wave, and both together are a
travelling wave. There is no driven and no free edge: traction on the top drives the block. The
interface, the step and the factorisation are those of the block.

Interface arrays over "nodes 0..n_x" hold the period's nodes in the entries 1..n_x. Entry 0, in the
block the node of the driven edge, repeats the last one.
"""

from __future__ import annotations

import dataclasses
from functools import cached_property

import numpy as np
from scipy import fft
from scipy.linalg import circulant

from ..model.material import Material
from ..types import Array, ComplexArray
from .condensed import Balance, Expectation, Response
from .elimination import Elimination, SeparableOperator
from .grid import Components, Field, Grid
from .separable import SeparableBody


class PeriodicBlock(SeparableBody):
    """A layer of one period along x on the interface y = 0.

    Parameters
    ----------
    grid : Grid
        The mesh of one period.
    material : Material
        Elastic moduli and density.
    far_side : str
        Boundary condition of the far side, a key of :data:`.separable.HELD`.

    Raises
    ------
    ValueError
        If n_x is even.
    """

    def __init__(
        self,
        grid: Grid,
        material: Material,
        far_side: str = "free",
    ) -> None:
        if grid.n_x % 2 == 0:
            raise ValueError(f"n_x = {grid.n_x} is not allowed: it must be odd in a periodic body")
        grid = dataclasses.replace(grid, periodic=True)
        half = np.arange(1, grid.n_x // 2 + 1)
        number = np.concatenate(([0], half, half))
        theta = 2.0 * np.pi / grid.n_x * number
        x_integral = np.where(theta == 0.0, grid.length, 0.0)
        no_edge = np.zeros((3, grid.n_x))
        super().__init__(
            grid,
            material,
            theta,
            x_integral,
            no_edge,
            far_side,
        )

    def on_all_nodes(self, values: Array, driven: float) -> Array:
        """Repeat the last node's value as entry 0; `driven` is not used.

        Parameters
        ----------
        values, driven
            As in :meth:`.condensed.ElasticBody.on_all_nodes`.
        """
        return with_entry_zero(values)

    def operator(self, s: float) -> _PeriodicOperator:
        """Factorise the dynamic stiffness ``K + s M`` (`s` in 1/s^2)."""
        return _PeriodicOperator(self, s)

    def _split(self, amplitudes: Array) -> tuple[Array, Array, Array]:
        """The mean, A and B."""
        first_b = self.grid.n_x // 2 + 1
        mean = amplitudes[..., :1]
        a = amplitudes[..., 1:first_b]
        b = amplitudes[..., first_b:]
        return mean, a, b

    def _values(self, mean: Array, coefficients: ComplexArray) -> Array:
        """``mean + Re sum_m c_m exp(i theta_m i)`` at all nodes."""
        n = self.grid.n_x
        waves = 0.5 * n * coefficients
        spectrum = np.concatenate((n * mean, waves), axis=-1)
        return fft.irfft(spectrum, n)

    def sine_amplitudes(self, nodal: Array) -> Array:
        """Return the amplitudes of nodal values (last axis) in the basis of u_x."""
        spectrum = fft.rfft(nodal) / self.grid.n_x
        mean = spectrum[..., :1].real
        waves = spectrum[..., 1:]
        a = -2 * waves.imag
        b = 2 * waves.real
        return np.concatenate((mean, a, b), axis=-1)

    def sine_values(self, amplitudes: Array) -> Array:
        """Return the nodal values (last axis) of amplitudes in the basis of u_x."""
        mean, a, b = self._split(amplitudes)
        return self._values(mean, b - 1j * a)

    def cosine_values(self, amplitudes: Array) -> Array:
        """Return the nodal values (last axis) of amplitudes in the basis of u_y."""
        mean, a, b = self._split(amplitudes)
        return self._values(mean, a + 1j * b)

    def forces(
        self,
        stiffness: Array,
        amplitudes: Array,
        reduced: Array,
    ) -> Components:
        """Return the nodal forces along x at i = 1..n_x and along y at i = 0..n_x.

        Parameters
        ----------
        stiffness, amplitudes, reduced
            As in :meth:`.separable.SeparableBody.forces`.
        """
        tangential, normal = self.interface_forces(stiffness * amplitudes - reduced)
        return tangential, with_entry_zero(normal)

    def interface_forces(self, modal: Array) -> Components:
        """Return the nodal forces along x and y of modal ones, (2, n_x)."""
        along_x, along_y = modal
        return self.sine_values(along_x), self.cosine_values(along_y)

    def top_load(self, normal_stress: float, shear_stress: float = 0.0) -> Field:
        """Return the nodal forces of stresses on the top.

        Parameters
        ----------
        normal_stress : float
            Compressive stress (Pa).
        shear_stress : float
            Traction along x (Pa).

        Returns
        -------
        Field
            The load (N/m).
        """
        load = self.zero_field()
        dx = self.grid.dx
        load.modes[-1, 0, 0] = shear_stress * dx
        load.modes[-1, 1, 0] = -normal_stress * dx
        return load

    def nodal_values(self, field: Field) -> Components:
        """Return nodal w_x and u_y, each of shape (n_y + 1, n_x + 1); column 0 is the last one."""
        x = self.sine_values(field.modes[:, 0])
        y = self.cosine_values(field.modes[:, 1])
        return with_entry_zero(x), with_entry_zero(y)


class Circulant(Elimination):
    """D and N between the nodes of a period, which are circulant matrices."""

    def respond(self, load: Field, w: Array) -> Response:
        """Find the forces that hold the interface.

        Parameters
        ----------
        load, w
            As in :meth:`.condensed.Operator.respond`.
        """
        swept = self.swept_down(load, np.zeros_like(load.edge))
        reduced, start = self.reduced(swept)
        amplitudes = self.along_x.sine_amplitudes(w)
        tangential, normal = self.along_x.forces(self.modal, amplitudes, reduced)
        return Response(w, tangential, normal, load, swept, start)

    def balance(
        self,
        response: Response,
        w: Array,
        expected: Expectation | None = None,
    ) -> Balance:
        """Find the displacement.

        Parameters
        ----------
        response, w, expected
            As in :meth:`.condensed.Operator.balance`.
        """
        modes = response.swept
        assert modes is not None
        self.substitute_up(modes, self.along_x.sine_amplitudes(w), response.start)
        displacement = Field(modes, np.zeros_like(response.load.edge))
        return Balance(displacement, self.body.no_memory, True)

    @cached_property
    def _columns(self) -> Components:
        """First columns of D and N."""
        unit = np.zeros(self.along_x.grid.n_x)
        unit[0] = 1.0
        tangential, normal = self.apply(unit)
        return tangential, normal[1:]

    @cached_property
    def diagonal(self) -> Array:
        """Diagonal of D (N/m per m), shape (n_x,)."""
        column, _ = self._columns
        return np.full(self.along_x.grid.n_x, column[0])

    @cached_property
    def dense(self) -> Components:
        """D and N between all nodes."""
        stiffness, coupling = self._columns
        return circulant(stiffness), circulant(coupling)


class _PeriodicOperator(SeparableOperator, Circulant):
    """``K + s M`` of a :class:`PeriodicBlock`; D and N are circulant."""


def with_entry_zero(nodal: Array) -> Array:
    """Prepend the last value (last axis) to values at the period's nodes."""
    last = nodal[..., -1:]
    return np.concatenate((last, nodal), axis=-1)
