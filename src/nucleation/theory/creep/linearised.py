"""Linear algebra of a patch whose friction and elasticity are linearised: modes and amplitudes.

For perturbations of slip w and of psi = log(phi) at some places, force balance and the evolution of
the state read ``dv = A dw + b dpsi``, b diagonal, and ``d(dpsi)/dt = g_v dv + g_psi dpsi``: an
eigenvalue problem of twice their number. Its eigenvalues need no vectors: in a mode exp(Lambda t)
each place has ``dpsi = g_v Lambda dw / (Lambda - g_psi)``, so that the few modes looked at are null
vectors of the half as large

    T(Lambda) = A - Lambda + diag(b g_v Lambda / (Lambda - g_psi)).
"""

import dataclasses
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

from ...model.friction.law import Friction
from ...types import Array, ComplexArray
from .modes import Creep

OSCILLATING = 0.1  # modes of a smaller angular frequency, over V/D, count as not oscillating
INVERSE_ITERATIONS = 3  # towards the null vector of a matrix that is singular to round-off
OFFSET = 1e-9  # relative, from the eigenvalue: T can be factorised there


@dataclasses.dataclass(frozen=True)
class FrozenPatch:
    """The linearised patch: coefficients of dv and of d(dpsi)/dt at the slipping `nodes`."""

    nodes: NDArray[np.intp]
    by_w: Array  # A (1/s), dv by dw, (n, n)
    by_log_state: Array  # b (m/s), dv by dpsi, (n,)
    evolution_by_rate: Array  # g_v (1/m), (n,)
    evolution_by_log_state: Array  # g_psi (1/s), (n,)

    @property
    def matrix(self) -> Array:
        """Jacobian of (dw, dpsi), shape (2 n, 2 n)."""
        g_v, b = self.evolution_by_rate, self.by_log_state
        lower = np.diag(g_v * b + self.evolution_by_log_state)
        return np.block([[self.by_w, np.diag(b)], [g_v[:, None] * self.by_w, lower]])

    @cached_property
    def eigenvalues(self) -> ComplexArray:
        """All eigenvalues Lambda (1/s), fastest growing first."""
        values = np.linalg.eigvals(self.matrix)
        return values[np.argsort(-values.real)]

    def oscillating(self, frequency: float) -> complex:
        """The fastest growing eigenvalue of at least an angular frequency (1/s), or NaN."""
        fast = self.eigenvalues[self.eigenvalues.imag >= frequency]
        return complex(fast[0]) if fast.size else complex(np.nan, np.nan)

    def mode(self, eigenvalue: complex) -> tuple[ComplexArray, ComplexArray]:
        """Displacement, of largest modulus 1, and log state of an eigenvalue's mode, (n,) each."""
        ratio = 1.0 / (eigenvalue - self.evolution_by_log_state)
        w = _null_vector(self._reduced(eigenvalue))
        w /= w[np.abs(w).argmax()]
        return w, self.evolution_by_rate * eigenvalue * ratio * w

    def amplitude(self, eigenvalue: complex) -> ComplexArray:
        """Weights (2 n,) that give a mode's complex amplitude in any perturbation (dw, dpsi).

        They are the left eigenvector, orthogonal to all other modes, scaled to give 1 for
        :meth:`mode`.
        """
        share = self.by_log_state / (eigenvalue - self.evolution_by_log_state)
        z = _null_vector(self._reduced(eigenvalue).T)
        weights = np.append(z * (1.0 - self.evolution_by_rate * share), z * share)
        return weights / (weights @ np.concatenate(self.mode(eigenvalue)))

    def _reduced(self, eigenvalue: complex) -> ComplexArray:
        """T(Lambda), next to where it is singular."""
        value = eigenvalue * (1.0 + OFFSET)
        matrix = self.by_w.astype(complex)
        matrix[np.diag_indices_from(matrix)] += value * (
            self.by_log_state * self.evolution_by_rate / (value - self.evolution_by_log_state) - 1.0
        )
        return matrix


def _null_vector(matrix: ComplexArray) -> ComplexArray:
    """Null vector of a nearly singular matrix, by inverse iteration."""
    factors = lu_factor(matrix)
    vector = np.ones(matrix.shape[0], dtype=complex)
    for _ in range(INVERSE_ITERATIONS):
        vector = lu_solve(factors, vector)
        vector /= np.abs(vector).max()
    return vector


def log_state_derivatives(law: Friction, slip_rate: Array, state: Array) -> tuple[Array, Array]:
    """Derivatives of ``dpsi/dt`` by v at fixed psi (1/m) and by psi at fixed v (1/s).

    With ``g(omega)`` the evolution law, ``dpsi/dt = g(phi w / D) / phi``.
    """
    speed, distance = law.slip_speed(slip_rate), law.characteristic_slip_distance
    omega = state * speed / distance
    evolution = law.evolution_law
    by_omega = evolution.slope(omega)
    by_rate = by_omega * slip_rate / (speed * distance)
    by_log_state = (by_omega * omega - evolution.growth(omega)) / state
    return by_rate, by_log_state


class Coefficients(NamedTuple):
    """Friction linearised at each place, (N,); slip in D, time in D/V.

    ``df = by_rate dv + by_state dpsi`` and ``d(dpsi)/dt = evolution_by_rate dv +
    evolution_by_state dpsi``.
    """

    friction: Array
    by_rate: Array
    by_state: Array
    evolution_by_rate: Array
    evolution_by_state: Array


def constant_coefficients(rate: Array, friction: float, a: float, zeta: float) -> Coefficients:
    """Friction with constant a and b about steady sliding at each place."""
    ones = np.ones_like(rate)
    return Coefficients(friction * ones, a / rate, (a + zeta) * ones, -ones, -rate)


def local_coefficients(
    law: Friction, velocity: float, rate: Array, log_state: Array | None = None
) -> Coefficients:
    """A friction law linearised at slip rates over V (m/s) and states, log(phi), phi in s.

    The states are those of steady sliding by default.
    """
    v, distance = velocity * rate, law.characteristic_slip_distance
    psi = np.log(law.steady_state(v)) if log_state is None else log_state
    f, f_v, f_psi = law.coefficient_and_slopes(v, psi)
    g_v, g_psi = log_state_derivatives(law, v, np.exp(psi))
    memory = distance / velocity
    return Coefficients(f, velocity * f_v, f_psi, distance * g_v, memory * g_psi)


def creeping_patch(creep: Creep, friction: Coefficients) -> FrozenPatch:
    """The patch about its creep, at the angles of its modes: slip in D, time in D/V.

    ``dv = -[(K1 + f S2) dw / sigma + f_psi dpsi] / f_v``, with sigma and f those of each place.
    """
    held = creep.response
    by_slip = held.coupled(friction.friction)[:, 1:] @ held.modes.inverse
    by_slip = -by_slip / (creep.normal_stress * friction.by_rate)[:, None]
    by_state = -friction.by_state / friction.by_rate
    return FrozenPatch(np.arange(friction.by_rate.size), by_slip, by_state, *friction[3:])
