"""Steady creep of a patch under its loading, and its linearisation: modes and amplitudes.

For perturbations of slip w and of psi = log(phi) at some places, force balance and the evolution of
the state read ``dv = A dw + b dpsi``, b diagonal, and ``d(dpsi)/dt = g_v dv + g_psi dpsi``. This is
an eigenvalue problem of twice their number. Its eigenvectors are needed for few modes only. In a
mode exp(Lambda t) each place has ``dpsi = g_v Lambda dw / (Lambda - g_psi)``, so that such a mode
is the null vector of a matrix of half the size

    T(Lambda) = A - Lambda + diag(b g_v Lambda / (Lambda - g_psi)).
"""

import dataclasses
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.friction import Friction
from ...types import Array, ComplexArray
from ..status import NoLength
from .response import PatchResponse

SLOWEST = 1e-6  # least slip rate over V: friction's logarithm diverges at rest
NEAR = 2  # places next to the front that determine the share of the singularity
OSCILLATING = 0.1  # modes of a smaller angular frequency, over V/D, count as not oscillating
INVERSE_ITERATIONS = 3  # towards the null vector of a matrix that is singular to round-off
OFFSET = 1e-9  # relative, from the eigenvalue, so that T can be factorised


class Creep(NamedTuple):
    """A creeping patch, at the angles of its modes.

    Slip rates are relative to `fastest`: V at an edge that is pushed, else the largest one.
    """

    response: PatchResponse  # of the bodies, and L
    slip_rate: Array  # over `fastest`, (N,)
    normal_stress: Array  # compression over sigma0, (N,)
    loaded: Array | float  # at L: displacement of the edge over D, or shear stress over sigma0
    fastest: float = 1.0  # over V


def creep(response: PatchResponse, friction: float, load_rate: float | None = None) -> Creep:
    """The creep of a patch under the loading of a response.

    Slip rate: the strength is constant. So ``(K1 + f S2) v = 0`` with ``v(0) = V``, or ``(K1 + f
    S2) v`` is the rate of the stress. Slip: the patch is loaded to its strength, ``-(K1 + f S2) u =
    f sigma0``, and the edge has the displacement for which the front has no singularity. That slip
    has changed the normal stress by ``S2 u``. A stress that loads a uniform interface evenly
    reaches the strength everywhere at once, and u = 0.
    """
    coefficients, slip, loaded = edge_slip(response, friction, friction)
    rates = response.modes.values @ coefficients
    fastest = 1.0
    if load_rate is not None:
        scale = float(rates.max())
        rates = rates / scale
        fastest = scale * load_rate
    return Creep(
        response=response,
        slip_rate=np.maximum(rates, SLOWEST),
        normal_stress=1.0 + response.normal @ slip,
        loaded=loaded,
        fastest=fastest,
    )


def edge_slip(
    response: PatchResponse, friction: Array | float, strength: Array | float
) -> tuple[Array, Array, Array]:
    """The modes' coefficients of slip rate over V and slip over D, (..., N + 1); and U over D.

    Where slip changes the normal stress, the front's singularity is no square root, and the edge is
    not regular. An error of alternating sign at neighbouring places remains, which
    the modes' smoothing removes from the result.
    """
    matrix = response.coupled(friction)
    by_edge = matrix[..., 0]
    by_strength = np.broadcast_to(strength, by_edge.shape)
    loads = np.stack([by_edge, by_strength], axis=-1)
    sines = -np.linalg.solve(matrix[..., 1:], loads)
    rates, held = np.moveaxis(np.insert(sines, 0, [1.0, 0.0], axis=-2), -1, 0)
    near = response.modes.values[:NEAR]
    squares = response.modes.theta[:NEAR] ** 2
    ratio = (near @ held[..., None]) / (near @ rates[..., None])
    loaded = -np.polyfit(squares, ratio.reshape(-1, NEAR).T, NEAR - 1)[-1]
    loaded = loaded.reshape(by_edge.shape[:-1])
    smoothing = response.modes.smoothing
    return smoothing * rates, smoothing * (loaded[..., None] * rates + held), loaded


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
        upper = np.hstack([self.by_w, np.diag(self.by_log_state)])
        lower = self.evolution_by_rate[:, None] * upper
        lower[:, len(upper) :] += np.diag(self.evolution_by_log_state)
        return np.vstack([upper, lower])

    @cached_property
    def eigenvalues(self) -> ComplexArray:
        """All eigenvalues Lambda (1/s), fastest growing first."""
        matrix = self.matrix
        if not np.isfinite(matrix).all():
            raise NoLength("the equations of its patches have no finite numbers")
        values: ComplexArray = np.asarray(np.linalg.eigvals(matrix), dtype=complex)
        return values[np.argsort(-values.real)]

    def oscillating(self, frequency: float) -> complex:
        """The fastest growing eigenvalue of at least an angular frequency (1/s), or NaN."""
        fast = self.eigenvalues[self.eigenvalues.imag >= frequency]
        return complex(fast[0]) if fast.size else complex(np.nan, np.nan)

    def mode(self, eigenvalue: complex) -> tuple[ComplexArray, ComplexArray]:
        """Displacement, with the largest modulus 1, and log state of a mode, (n,) each."""
        ratio = 1.0 / (eigenvalue - self.evolution_by_log_state)
        w = _null_vector(self._reduced(eigenvalue))
        w /= w[np.abs(w).argmax()]
        return w, self.evolution_by_rate * eigenvalue * ratio * w

    def amplitude(self, eigenvalue: complex) -> ComplexArray:
        """Weights (2 n,) of a mode's complex amplitude in any perturbation (dw, dpsi).

        They are the left eigenvector, orthogonal to all other modes, scaled such that the amplitude
        of :meth:`mode` is 1.
        """
        share = self.by_log_state / (eigenvalue - self.evolution_by_log_state)
        z = _null_vector(self._reduced(eigenvalue).T)
        of_w = z * (1.0 - self.evolution_by_rate * share)
        of_log_state = z * share
        weights = np.append(of_w, of_log_state)
        mode = np.concatenate(self.mode(eigenvalue))
        return weights / (weights @ mode)

    def _reduced(self, eigenvalue: complex) -> ComplexArray:
        """T(Lambda), at a small offset from where it is singular."""
        value = eigenvalue * (1.0 + OFFSET)
        feedback = self.by_log_state * self.evolution_by_rate
        diagonal = value * (feedback / (value - self.evolution_by_log_state) - 1.0)
        matrix = self.by_w.astype(complex)
        matrix[np.diag_indices_from(matrix)] += diagonal
        return matrix


def _null_vector(matrix: ComplexArray) -> ComplexArray:
    """Null vector of a nearly singular matrix, by inverse iteration."""
    from scipy.linalg import lu_factor, lu_solve

    factors = lu_factor(matrix)
    vector = np.ones(matrix.shape[0], dtype=complex)
    for _ in range(INVERSE_ITERATIONS):
        vector = lu_solve(factors, vector)
        vector /= np.abs(vector).max()
    return vector


def log_state_derivatives(law: Friction, slip_rate: Array, state: Array) -> tuple[Array, Array]:
    """Derivatives of ``dpsi/dt = g(phi w / D) / phi`` by v (1/m) and by psi (1/s).

    Takes slip_rate (m/s) and state (s).
    """
    speed = law.slip_speed(slip_rate)
    distance = law.slip_distance
    evolution = law.evolution_law
    omega = state * speed / distance
    by_omega = evolution.slope(omega)
    by_rate = by_omega * slip_rate / (speed * distance)
    by_log_state = (by_omega * omega - evolution.growth(omega)) / state
    return by_rate, by_log_state


class _LinearFriction(NamedTuple):
    """Friction linearised at each place, (N,); slip in D, time in D/V.

    ``df = by_rate dv + by_state dpsi`` and ``d(dpsi)/dt = evolution_by_rate dv +
    evolution_by_state dpsi``.
    """

    friction: Array
    by_rate: Array
    by_state: Array
    evolution_by_rate: Array
    evolution_by_state: Array


def constant_coefficients(rate: Array, friction: float, a: float, zeta: float) -> _LinearFriction:
    """Friction with constant a and b about steady sliding at each place."""
    ones = np.ones_like(rate)
    return _LinearFriction(
        friction=friction * ones,
        by_rate=a / rate,
        by_state=(a + zeta) * ones,
        evolution_by_rate=-ones,
        evolution_by_state=-rate,
    )


def local_coefficients(
    law: Friction, velocity: float, rate: Array, log_state: Array | None = None
) -> _LinearFriction:
    """A friction law linearised at each place, about steady sliding unless log(phi) is given."""
    v = velocity * rate
    psi = np.log(law.steady_state(v)) if log_state is None else log_state
    f, f_v, f_psi = law.coefficient_and_slopes(v, psi)
    g_v, g_psi = log_state_derivatives(law, v, np.exp(psi))
    distance = law.slip_distance
    memory = distance / velocity
    return _LinearFriction(
        friction=f,
        by_rate=velocity * f_v,
        by_state=f_psi,
        evolution_by_rate=distance * g_v,
        evolution_by_state=memory * g_psi,
    )


def creeping_patch(creep: Creep, friction: _LinearFriction) -> FrozenPatch:
    """The patch linearised about its creep: slip in D, time in D/V.

    ``dv = -[(K1 + f S2) dw / sigma + f_psi dpsi] / f_v``, with sigma and f at each place.
    """
    response = creep.response
    stiffness = response.coupled(friction.friction)[:, 1:] @ response.modes.inverse
    by_force = creep.normal_stress * friction.by_rate
    return FrozenPatch(
        nodes=np.arange(friction.by_rate.size),
        by_w=-stiffness / by_force[:, None],
        by_log_state=-friction.by_state / friction.by_rate,
        evolution_by_rate=friction.evolution_by_rate,
        evolution_by_log_state=friction.evolution_by_state,
    )
