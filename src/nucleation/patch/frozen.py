"""Linear stability of the creeping patch itself, frozen at an instant of a simulation.

The paper replaces the patch by homogeneous sliding. Here friction, state and the static elastic
response of the block are linearised about the fields that the simulation has at one instant. For
perturbations of the displacement w and of psi = log(phi) at the slipping nodes, force balance
reads (p = -f R at each node, R the nodal normal force)

    (D + f N) dw + R (f_v dv + f_psi dpsi) = 0,      d(dw)/dt = dv,
    d(dpsi)/dt = g_v dv + g_psi dpsi,

with the condensed static operators D (tangential) and N (normal stress coupling) of the finite
elements and the evolution law ``dpsi/dt = g(v, psi)``. Eliminating dv leaves, with
``dv = A dw + b dpsi`` and b diagonal, an eigenvalue problem of twice the number of slipping nodes.
Its eigenvalues need no vectors: in a mode exp(Lambda t) each node has
``dpsi = g_v Lambda dw / (Lambda - g_psi)``, so that the few modes looked at are null vectors of
the half as large

    T(Lambda) = A - Lambda + diag(b g_v Lambda / (Lambda - g_psi)).
"""

from __future__ import annotations

import dataclasses
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

from ..analysis.definitions import SEARCHED
from ..fem.bodies import BodyOperator
from ..model.friction.law import Friction

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

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
        return values[np.argsort(-values.real)]  # type: ignore[return-value]

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


def frozen_patch(
    operator: BodyOperator, law: Friction, slip_rate: Array, state: Array, normal_force: Array,
    slowest: float,
) -> FrozenPatch:  # fmt: skip
    """Linearise the patch whose fields along the interface (n_x + 1,) are given.

    Parameters
    ----------
    operator : the static stiffness of the body or bodies (``s = 0``).
    law : friction law.
    slip_rate, state, normal_force : at the nodes 0..n_x (m/s, s, N/m; positive in compression).
    slowest : nodes that slip more slowly (m/s) are taken as stuck.
    """
    grid = operator.body.grid
    slipping = (slip_rate > slowest) & (grid.x <= SEARCHED * grid.length)
    nodes = np.flatnonzero(slipping[1:]) + 1
    v, phi, force = slip_rate[nodes], state[nodes], normal_force[nodes]
    f = law.coefficient(v, phi)
    f_v, f_phi = law.derivatives(v, phi)
    stiffness, coupling = operator.tangent(nodes)
    by_w = -(stiffness + f[:, None] * coupling) / (f_v * force)[:, None]
    return FrozenPatch(nodes, by_w, -f_phi * phi / f_v, *log_state_derivatives(law, v, phi))
