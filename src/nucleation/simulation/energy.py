"""Energies of a run since its start, and the works of its steps: they balance.

The work of the driven edge and of the far loads is what is stored as elastic and kinetic energy,
what friction dissipates, and the little that the time scheme does. Forces of a step act by the
trapezoidal rule.
"""

from collections.abc import Mapping

import numpy as np

from ..fem.factors import elastic_energy
from ..types import Array, Arrays
from .step import Dynamics, State, StepReport

NAMES = ("elastic_energy", "kinetic_energy", "work", "friction_work")


class Energy:
    """Adds up the works of one run's steps (J/m), and compares its energies."""

    def __init__(self, dynamics: Dynamics) -> None:
        self._body = dynamics.body
        self._drive = dynamics.drive
        self._works = np.zeros(2)  # of edge and loads, and of friction on the body
        self._start = np.empty(0)  # elastic and kinetic energy
        self._last: list[Array] = []  # forces (N/m) and ways (m), external and friction's

    def take(self, state: State, report: StepReport) -> None:
        """Take in the initial state or a step."""
        before = self._last
        self._state = state
        self._last = [self._external(state, report), self._friction(state, report)]
        if not before:
            self._start = self._stored(state)
        for i, (old, new) in enumerate(zip(before, self._last, strict=False)):
            self._works[i] += 0.5 * (old[0] + new[0]) @ (new[1] - old[1])

    def _external(self, state: State, report: StepReport) -> Array:
        """Forces on the driven edge and the far sides, and their ways."""
        load, field = self._drive.load(state.time), state.displacement
        moved = self._drive.at(state.time).displacement
        far = np.cumsum([layer.levels for layer in self._body.layers]) - 1
        modal = load.modes[far] * self._body.modes.norms
        forces = np.concatenate(([-report.driving_force], modal.ravel(), load.edge[far]))
        return np.array(
            [forces, np.concatenate(([moved], field.modes[far].ravel(), field.edge[far]))]
        )

    def _friction(self, state: State, report: StepReport) -> Array:
        """Forces of friction on the interface's nodes, and their ways."""
        moved = self._drive.at(state.time).displacement
        slip = moved + self._body.modes.on_all_nodes(report.interface.w, 0.0)
        return np.array([report.interface.tangential, slip])[:, self._body.grid.own]

    def _stored(self, state: State) -> Array:
        body, imposed = self._body, self._drive.at(state.time)
        parts = zip(body.layers, body.parts(state.displacement), strict=True)
        elastic = sum(elastic_energy(layer, part) for layer, part in parts)
        return np.array([elastic, body.kinetic_energy(state.velocity, imposed.velocity)])

    def since_start(self) -> dict[str, float]:
        """:data:`NAMES` (J/m) at the present step."""
        stored = self._stored(self._state) - self._start
        work, by_friction = self._works
        values = (*stored, work, -by_friction)
        return dict(zip(NAMES, map(float, values), strict=True))

    def to_arrays(self) -> Arrays:
        """What is not in the state, as plain arrays by name, to be stored; exact."""
        external, friction = self._last
        return {
            "energy_works": self._works.copy(),
            "energy_start": self._start,
            "energy_external": external,
            "energy_friction": friction,
        }

    def restore(self, arrays: Mapping[str, Array]) -> None:
        """The inverse of :meth:`to_arrays`, with the arrays of the state."""
        self._works = arrays["energy_works"].copy()
        self._start = arrays["energy_start"]
        self._last = [arrays["energy_external"], arrays["energy_friction"]]
        self._state = State.from_arrays(arrays)
