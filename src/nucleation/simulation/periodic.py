"""Homogeneous sliding of a periodic block: the step and the interface of the simulation."""

from __future__ import annotations

import numpy as np

from ..fem.block import Field
from ..fem.periodic import (
    Array,
    PeriodicBlock,
    PeriodicOperator,
)
from ..model.parameters import Parameters
from ..stepping.ladder import rung_value
from .state import State
from .step import Dynamics


class PeriodicDynamics(Dynamics):
    """A period of a long block, driven at constant traction to slide homogeneously at V.

    ``geometry.length`` is the period. The reports' driving force has no meaning here.
    """

    def __init__(self, parameters: Parameters) -> None:
        super().__init__(parameters)
        self.body = PeriodicBlock(self.grid, parameters.material)
        law, sigma0 = parameters.friction, parameters.loading.normal_stress
        self._steady_log_state = float(np.log(law.steady_state(self.velocity)))
        self._load = self.body.top_load(sigma0, sigma0 * law.steady_coefficient(self.velocity))  # type: ignore[arg-type]

    def sliding_state(self, perturbation: Array) -> State:
        """Homogeneous steady sliding, with a perturbation of log(phi) at the period's nodes."""
        n = self.grid.n_x
        modes, _ = PeriodicOperator(self.body, 0.0).solve(
            self._load, np.zeros(n), np.zeros(self.grid.n_y + 1)
        )
        displacement = Field(modes, np.zeros(modes.shape[0]))
        log_state = self._steady_log_state + np.append(0.0, perturbation)
        rates = np.full(n + 1, self.velocity)
        return State.beginning(
            displacement, self.body.zero_field(), rates, log_state, np.zeros(n), 0.0
        )

    def _operator(self, rung: int) -> PeriodicOperator:
        if rung not in self._operators:
            self._operators[rung] = PeriodicOperator(self.body, 1.0 / rung_value(rung) ** 2)
        return self._operators[rung]  # type: ignore[return-value]
