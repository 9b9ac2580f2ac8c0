"""The modes along x in which the finite-element equations separate, and their transforms.

In modes of one angle theta per element each, the equations decouple: one block-tridiagonal system
along y for each mode. There are the modes of a block with two ends, and those of a period.
"""

import numpy as np
import rocket_fft  # noqa: F401 - lets numba compile scipy.fft
from scipy import fft

from ..types import Array, ComplexArray
from .compiling import compiled
from .grid import Components, Grid


class _Modes:
    """The modes of a grid, with the integral of each mode of u_x along x (m)."""

    level: Array  # amplitudes of u_y = 1 m, beside edge values of 1 m; in a period of u_x, too

    def __init__(self, grid: Grid, theta: Array, x_integral: Array) -> None:
        self.n_x = grid.n_x
        self.scale = 2.0 / grid.n_x  # of all loads and stiffnesses per mode
        self.norms = np.full(grid.n_x, 0.5 * grid.n_x)  # sums of each mode's squares over the nodes
        self.x_stiffness = 4.0 * np.sin(theta / 2.0) ** 2 / grid.dx
        self.x_mass = grid.dx * (4.0 + 2.0 * np.cos(theta)) / 6.0
        self.sine = np.sin(theta)
        self.x_integral = x_integral
        self.edge_weights = np.zeros((3, grid.n_x))  # of each mode in the forces on the edge


# An interface has some hundred nodes: calling a transform of SciPy takes three times as long as the
# transform itself. With rocket-fft, compiled code calls the same transforms; results are equal to
# the last bit.


@compiled
def _sine_amplitudes(nodal: Array) -> Array:
    """Amplitudes of values of u_x at the nodes 1..n_x (last axis)."""
    # the inverse transform counts the last node half, and so does type 3
    return fft.dst(nodal, 3) / nodal.shape[-1]


@compiled
def _nodal_forces(
    stiffness: Array, amplitudes: Array, reduced: Array, alternating: Array
) -> Components:
    """Nodal forces of ``(stiffness * amplitudes - reduced) n_x/2`` per mode."""
    n = amplitudes.size
    modal = np.empty((2, n))
    for m in range(n):
        along_x = stiffness[0, m] * amplitudes[m] - reduced[0, m]
        along_y = stiffness[1, m] * amplitudes[m] - reduced[1, m]
        modal[0, m] = along_x * alternating[m]
        modal[1, m] = along_y
    forces = fft.dct(modal, 2)
    tangential = np.empty(n)
    normal = np.empty(n + 1)
    for i in range(n):
        tangential[i] = 0.5 * forces[0, n - 1 - i]  # reversed, alternating cosines are sines
        normal[i] = 0.5 * forces[1, i]
    tangential[n - 1] *= 0.5  # half of an element belongs to the last node
    normal[0] *= 0.5  # and to the first one
    normal[n] = 0.0  # the modes do not act there along y
    return tangential, normal


class BlockModes(_Modes):
    """The modes of a block: ``theta_m = (m + 1/2) pi / n_x``.

    ``w_x = sum_m W_m sin(theta_m i)`` at i = 1..n_x vanishes at the left edge and is free of
    sigma_xx at the right one; ``u_y = sum_m U_m cos(theta_m i)`` at i = 0..n_x - 1 vanishes at the
    right one, where edge values of its own are added.
    """

    has_edge = True  # the right edge has unknowns u_y of its own
    sine_amplitudes = staticmethod(_sine_amplitudes)

    def __init__(self, grid: Grid) -> None:
        mode = np.arange(grid.n_x)
        theta = (mode + 0.5) * np.pi / grid.n_x
        super().__init__(grid, theta, 0.5 * grid.dx / np.tan(theta / 2.0))
        self._alternating = (-1.0) ** mode
        # int chi w' and int chi' w, chi being the edge's hat function, and the value beside it
        weights = [np.sin(theta / 2.0) ** 2, np.cos(theta / 2.0) ** 2, np.sin(theta)]
        self.edge_weights = self._alternating * np.array(weights)
        self.level = self.cosine_amplitudes(np.ones(grid.n_x))

    def sine_values(self, amplitudes: Array) -> Array:
        """Values of u_x at the nodes 1..n_x (last axis)."""
        return fft.idst(amplitudes * self.n_x, 3)

    def cosine_amplitudes(self, nodal: Array) -> Array:
        """Amplitudes of values of u_y at the nodes 0..n_x - 1 (last axis)."""
        return fft.dct(nodal, type=3) / self.n_x

    def forces(self, stiffness: Array, amplitudes: Array, reduced: Array) -> Components:
        """Nodal forces (N/m) at 1..n_x and 0..n_x of ``stiffness * amplitudes - reduced``."""
        return _nodal_forces(stiffness, amplitudes, reduced, self._alternating)

    def on_all_nodes(self, values: Array, driven: float) -> Array:
        """Values at the nodes 0..n_x, given those at 1..n_x and at the driven edge."""
        nodal = np.empty(values.size + 1)
        nodal[0] = driven
        nodal[1:] = values
        return nodal

    def uniform_load(self, grid: Grid, normal: float, shear: float) -> tuple[Array, float]:
        """Load (N/m) of stresses (Pa) on a far side: per mode, (2, n_x), and its edge value."""
        assert shear == 0.0, "a block bears no shear stress on its far side"
        forces = -normal * grid.nodal_lengths
        inner = np.array(forces[:-1])
        # sum_i F_i cos(theta_m i): scipy's type 3 counts the first entry once, others twice
        inner[0] *= 2.0
        return np.array([np.zeros(self.n_x), self.cosine_amplitudes(inner)]), forces[-1]


class PeriodModes(_Modes):
    """The modes of a period of n_x nodes, an odd number: ``theta_m = 2 pi m / n_x``.

    ``u_x = W0 + sum_m A_m sin(theta_m i) + B_m cos(theta_m i)`` and ``u_y = U0 + sum_m A_m
    cos(theta_m i) - B_m sin(theta_m i)``, m = 1..(n_x - 1)/2, with other A_m, B_m for each. B is A
    shifted by a quarter wave: each set obeys the system of its theta. Arrays over the nodes 0..n_x
    repeat the last node in entry 0.
    """

    has_edge = False

    def __init__(self, grid: Grid) -> None:
        if grid.n_x % 2 == 0:
            raise ValueError(f"n_x = {grid.n_x} is not allowed: it must be odd in a periodic body")
        half = np.arange(1, grid.n_x // 2 + 1)
        theta = 2.0 * np.pi / grid.n_x * np.concatenate(([0], half, half))
        super().__init__(grid, theta, np.where(theta == 0.0, grid.length, 0.0))
        self.norms[0] *= 2.0  # of the mean
        self.level = np.append(1.0, np.zeros(grid.n_x - 1))

    def _split(self, amplitudes: Array) -> tuple[Array, Array, Array]:
        """The mean, A and B."""
        first_b = self.n_x // 2 + 1
        return amplitudes[..., :1], amplitudes[..., 1:first_b], amplitudes[..., first_b:]

    def _values(self, mean: Array, coefficients: ComplexArray) -> Array:
        """``mean + Re sum_m c_m exp(i theta_m i)`` at all nodes."""
        n = self.n_x
        spectrum = np.concatenate((n * mean, 0.5 * n * coefficients), axis=-1)
        return fft.irfft(spectrum, n)

    def sine_amplitudes(self, nodal: Array) -> Array:
        spectrum = fft.rfft(nodal) / self.n_x
        waves = spectrum[..., 1:]
        return np.concatenate((spectrum[..., :1].real, -2 * waves.imag, 2 * waves.real), axis=-1)

    def sine_values(self, amplitudes: Array) -> Array:
        mean, a, b = self._split(amplitudes)
        return self._values(mean, b - 1j * a)

    def cosine_values(self, amplitudes: Array) -> Array:
        """Values of u_y at the nodes 1..n_x (last axis)."""
        mean, a, b = self._split(amplitudes)
        return self._values(mean, a + 1j * b)

    def forces(self, stiffness: Array, amplitudes: Array, reduced: Array) -> Components:
        along_x, along_y = stiffness * amplitudes - reduced
        return self.sine_values(along_x), self.on_all_nodes(self.cosine_values(along_y))

    def on_all_nodes(self, values: Array, driven: float = 0.0) -> Array:
        return np.concatenate((values[..., -1:], values), axis=-1)

    def uniform_load(self, grid: Grid, normal: float, shear: float) -> tuple[Array, float]:
        load = np.zeros((2, self.n_x))
        load[:, 0] = shear * grid.dx, -normal * grid.dx
        return load, 0.0


Modes = BlockModes | PeriodModes
