"""Energies of a run at some instants, and the works of its steps: they balance.

The work of the driven edge and of the loads is what is stored as elastic and kinetic energy, what
friction dissipates, and the little that the time scheme does. Forces of a step act by the
trapezoidal rule.
"""

from collections.abc import Mapping

import numpy as np

from ..types import Array, Arrays
from . import passes
from .interface import InterfaceSolution
from .step import Dynamics, State, StepReport

RATES = (3.0, 30.0, 300.0, 3000.0)  # energies when max v / V first exceeds these
COLUMNS = ("energy_time", "elastic_energy", "kinetic_energy", "work", "friction_work")


class Energy:
    """Collects the energies and works (J/m) of one run."""

    def __init__(self, dynamics: Dynamics) -> None:
        self._body = dynamics.body
        self._drive = dynamics.drive
        self._constant = dynamics.drive.load(0.0) is dynamics.drive.load(1.0)
        self._work = 0.0  # of the driven edge, and of loads that change
        self._friction = 0.0
        self._rows: list[tuple[float, ...]] = []  # of COLUMNS
        self._next_rate = 0
        self._last: tuple[State, StepReport] | None = None

    def take(
        self,
        state: State,
        report: StepReport,
        fastest: float,
    ) -> None:
        """Take in the initial state or a step, with the largest slip rate (m/s)."""
        if self._last is not None:
            self._add_works(*self._last, state, report)
        self._last = state, report
        exceeded = self._next_rate
        while exceeded < len(RATES) and fastest > RATES[exceeded] * self._drive.velocity:
            exceeded += 1
        if exceeded > self._next_rate or not self._rows:
            self._next_rate = exceeded
            self._rows.append(self._row(state, report))

    def _add_works(
        self,
        before: State,
        old: StepReport,
        state: State,
        new: StepReport,
    ) -> None:
        moved = new.imposed.displacement - old.imposed.displacement
        self._friction += passes.friction_work(
            new.interface.tangential,
            old.interface.tangential,
            new.interface.w,
            old.interface.w,
            moved,
            self._body.grid.periodic,
        )
        if self._drive.moves:
            self._work -= 0.5 * (old.driving_force + new.driving_force) * moved
        if not self._constant:
            fields = before.displacement, state.displacement
            self._work += self._body.far_work((old.load, new.load), fields)

    def _row(self, state: State, report: StepReport) -> tuple[float, ...]:
        work = self._work
        if self._constant:
            work += self._body.product(report.load, state.displacement)
        velocity = report.imposed.velocity if self._drive.moves else 0.0
        elastic = self._body.elastic_energy(state.displacement)
        kinetic = self._body.kinetic_energy(state.velocity, velocity)
        return state.time, elastic, kinetic, work, self._friction

    def columns(self) -> Arrays:
        """:data:`COLUMNS` from the start, at all instants; the last of them is the present one."""
        present = [] if self._last is None else [self._row(*self._last)]
        rows = np.array([*self._rows, *present])
        rows[:, 1:] -= rows[0, 1:]
        return dict(zip(COLUMNS, rows.T, strict=True))

    def to_arrays(self) -> Arrays:
        """What is not in the state, as plain arrays by name, to be stored; exact."""
        assert self._last is not None
        _, report = self._last
        sums = [self._work, self._friction, self._next_rate, report.driving_force]
        return {
            "energy_rows": np.array(self._rows),
            "energy_sums": np.array(sums),
            "energy_tangential": report.interface.tangential,
        }

    def restore(self, arrays: Mapping[str, Array]) -> None:
        """The inverse of :meth:`to_arrays`, with the arrays of the state."""
        self._rows = [tuple(row) for row in arrays["energy_rows"].tolist()]
        self._work, self._friction, exceeded, force = arrays["energy_sums"].tolist()
        self._next_rate = int(exceeded)
        state = State.from_arrays(arrays)
        rate, log_state, w = state.past_slip_rates[0], state.past_log_states[0], state.past_w[0]
        tangential = arrays["energy_tangential"]
        interface = InterfaceSolution(rate, log_state, tangential, np.empty(0), w, 0)
        at, load = self._drive.at(state.time), self._drive.load(state.time)
        self._last = state, StepReport(interface, force, 0.0, at, load)
