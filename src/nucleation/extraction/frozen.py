"""Linear stability of the creeping patch itself, frozen at an instant of a simulation.

The paper replaces the patch by homogeneous sliding. Here friction, state and the static elastic
response of the block are linearised about the fields of the simulation at one instant. For
perturbations of the displacement w and of psi = log(phi) at the slipping nodes, force balance
reads (p = -f R at each node, R the nodal normal force)

    (D + f N) dw + R (f_v dv + f_psi dpsi) = 0,      d(dw)/dt = dv,
    d(dpsi)/dt = g_v dv + g_psi dpsi,

with the condensed static operators D (tangential) and N (normal stress coupling) of the finite
elements and the evolution law ``dpsi/dt = g(v, psi)``. Eliminating dv leaves the eigenvalue problem
of :mod:`nucleation.theory.creep.linearised`, of twice the number of slipping nodes.
"""

import copy

import numpy as np
from numpy.typing import NDArray

from ..fem.operator import Operator
from ..model.friction import Friction
from ..run.run import Run
from ..simulation.event import NEAR
from ..simulation.start import body_of, interface_of
from ..theory.creep.linearised import OSCILLATING, FrozenPatch, log_state_derivatives
from ..types import Array


def frozen_patch(
    operator: Operator,
    law: Friction,
    slip_rate: Array,
    state: Array,
    normal_force: Array,
    slowest: float,
) -> FrozenPatch:
    """Linearise the patch about given fields along the interface.

    Parameters
    ----------
    operator : Operator
        The static stiffness of the body or bodies (``s = 0``).
    law : Friction
        The friction law; its parameters may vary along the interface.
    slip_rate, state, normal_force : ndarray
        At the nodes (m/s, s, N/m; positive in compression), (n_x + 1,).
    slowest : float
        Slip rate (m/s) below which nodes count as stuck.

    Returns
    -------
    FrozenPatch
        Its coefficients at the slipping nodes.
    """
    grid = operator.body.grid
    slipping = slip_rate > slowest
    if not grid.periodic:
        slipping &= grid.x <= NEAR * grid.length
    nodes = np.flatnonzero(slipping[1:]) + 1  # node 0 is driven, or repeats another
    v, phi, force = slip_rate[nodes], state[nodes], normal_force[nodes]
    own_law = _at(law, nodes)
    f = own_law.coefficient(v, phi)
    f_v, f_phi = own_law.derivatives(v, phi)
    g_v, g_psi = log_state_derivatives(own_law, v, phi)
    stiffness, coupling = operator.tangent(nodes)
    by_force = (f_v * force)[:, None]
    return FrozenPatch(
        nodes=nodes,
        by_w=-(stiffness + f[:, None] * coupling) / by_force,
        by_log_state=-f_phi * phi / f_v,
        evolution_by_rate=g_v,
        evolution_by_log_state=g_psi,
    )


def _at(
    law: Friction,
    nodes: NDArray[np.intp],
) -> Friction:
    """The law with its parameters at some nodes."""
    own = copy.copy(law)
    for name, value in vars(law).items():
        if np.ndim(value):
            object.__setattr__(own, name, value[nodes])  # frozen, and checked for all nodes
    return own


class Freezer:
    """Linearises the patches of one run at given fields."""

    def __init__(
        self,
        run: Run,
        threshold: float,
    ) -> None:
        """Prepare the run's static operator and its law.

        Parameters
        ----------
        run : Run
        threshold : float
            Slip rate (m/s) below which nodes count as stuck.
        """
        body = body_of(run)
        self.run = run
        self.grid = body.grid
        self.threshold = threshold
        self.operator = Operator(body, 0.0)
        self._law = interface_of(run, body.grid).friction

    def frozen(
        self,
        slip_rate: Array,
        state: Array,
        normal_force: Array,
    ) -> FrozenPatch:
        """The patch about fields along the interface.

        Parameters
        ----------
        slip_rate, state, normal_force : ndarray
            At the nodes (m/s, s, N/m; positive in compression), (n_x + 1,).

        Returns
        -------
        FrozenPatch
            Its coefficients at the slipping nodes.
        """
        return frozen_patch(
            self.operator,
            self._law,
            slip_rate,
            state,
            normal_force,
            self.threshold,
        )

    def oscillating(
        self,
        patch: FrozenPatch,
        slip_rate: Array,
    ) -> complex:
        """The eigenvalue of the fastest growing oscillating mode.

        The frequency's scale is V/D; without an edge that moves at V it is v/D of the patch itself.

        Parameters
        ----------
        patch : FrozenPatch
            The patch.
        slip_rate : ndarray
            At the nodes (m/s), (n_x + 1,).

        Returns
        -------
        complex
            Lambda (1/s), or NaN without such a mode.
        """
        fault = self.run.fault
        rate_over_v = 1.0
        if fault.loading != "edge":
            rate_over_v = float(slip_rate.max()) / fault.velocity
        return patch.oscillating(rate_over_v * OSCILLATING / self.run.memory_time)
