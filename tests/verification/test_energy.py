"""Energy balance through a whole event, on a coarse block.

With the nodal forces F of the drive, of friction and of sigma0 on the top, and over one step

    W = 1/2 (F_n + F_n+1) . (u_n+1 - u_n),    E = 1/2 u K u + 1/2 v M v,

    W_drive + W_top = (E_n+1 - E_n) + friction's dissipation + the scheme's own dissipation,
    scheme's own = 1/2 (a_n + a_n+1) . M (u_n+1 - u_n) - 1/2 [v M v]_n^n+1 .

This holds exactly if every force and field of a step belongs to one equation of motion: what is
left is Newton's tolerance. K and M are assembled from quadrature, not the solver's matrices. The
scheme's dissipation is that of BDF2 in the inertial term and must vanish with the tolerance.
"""

import dataclasses

import numpy as np
import pytest
from verification.verification_page import rows

from nucleation.fem.assembled import assemble, unknown
from nucleation.model.friction.law import Friction
from nucleation.model.parameters import Geometry, Mesh, Parameters, Stepping
from nucleation.model.perturbation import KINDS, Perturbation
from nucleation.simulation.composition import composed
from nucleation.simulation.run import run
from nucleation.stepping.bdf import Formula, beta_of_step

pytestmark = pytest.mark.slow


def coarse(law, tolerance, perturbation=Perturbation()):
    return Parameters(
        geometry=Geometry(height=0.005, length=0.6),
        mesh=Mesh(n_x=40, n_y=4, grading=2.0),
        friction=Friction(evolution=law),
        stepping=Stepping(tolerance=tolerance, longest_step=0.2),
        perturbation=perturbation,
    )


@dataclasses.dataclass
class Ledger:
    """Sums over the steps so far (J/m)."""

    drive: float = 0.0
    top: float = 0.0
    friction: float = 0.0
    friction_by_rates: float = 0.0  # the same from the slip rates, by the trapezoidal rule
    scheme: float = 0.0
    elastic: float = 0.0  # change since the start
    kinetic: float = 0.0
    most_kinetic: float = 0.0
    fastest: float = 0.0
    steps: int = 0

    @property
    def residual(self):
        stored = self.elastic + self.kinetic
        return self.drive + self.top - stored - self.friction - self.scheme


class Accountant:
    """Energies, forces and works from the nodal values of successive states."""

    def __init__(self, parameters):
        dynamics = composed(parameters)
        self.body, self.grid, self.drive = dynamics.body, dynamics.grid, dynamics.drive
        grid = self.grid
        self.stiffness, self.mass = assemble(grid, parameters.material)
        i, j = np.meshgrid(np.arange(grid.n_x + 1), np.arange(grid.n_y + 1))
        self.x, self.y = unknown(grid, i, j, 0), unknown(grid, i, j, 1)
        self.at_rest = -parameters.loading.normal_stress * grid.nodal_lengths
        self.steady_load = self.body.top_load(parameters.loading.normal_stress)

    def top(self, time):
        """Nodal forces (N/m) on the top, all in the steady one's proportion."""
        return self.at_rest * (self.drive.load(time).edge[-1] / self.steady_load.edge[-1])

    def vector(self, field, uniform):
        out = np.empty(self.stiffness.shape[0])
        w_x, out[self.y] = self.body.nodal_values(field)
        out[self.x] = w_x + uniform
        return out

    def books(self, instants, until):
        """The ledger of the works and energies up to the time at which `until` is true."""
        ledger, before = Ledger(), None
        for instant in instants:
            state, report = instant.state, instant.report
            imposed = self.drive.at(state.time)
            u = self.vector(state.displacement, imposed.displacement)
            v = self.vector(state.velocity, imposed.velocity)
            # of w_t by the scheme, to which the edge's own U'' comes
            relative = self.vector(state.velocity, 0.0)
            a = np.zeros_like(v)
            if before is not None:
                a = self.acceleration(state, relative, before)
            a[self.x] += imposed.acceleration
            if before is None:
                start = 0.5 * u @ self.stiffness @ u, 0.5 * v @ self.mass @ v
            else:
                self.add(ledger, state.last_step, before, (u, v, a, report, self.top(state.time)))
            ledger.elastic = 0.5 * u @ self.stiffness @ u - start[0]
            ledger.kinetic = 0.5 * v @ self.mass @ v - start[1]
            ledger.most_kinetic = max(ledger.most_kinetic, ledger.kinetic)
            ledger.fastest = max(ledger.fastest, report.interface.slip_rate.max())
            ledger.steps += 1
            if until(state, ledger, report):
                return ledger
            earlier = None if before is None else before[5]
            before = (u, v, a, report, self.top(state.time), relative, earlier, state.last_step)
        raise AssertionError("the run ended before its event")

    def acceleration(self, state, v, before):
        past, earlier, previous_step = before[5:]
        step = state.last_step
        if earlier is None:
            return (v - past) / step
        f = Formula.bdf2(beta_of_step(step, previous_step), previous_step)
        return (v - f.from_past(np.array([past, earlier]))) / f.beta

    def add(self, ledger, step, old, new):
        du = new[0] - old[0]
        drive = -0.5 * (old[3].driving_force + new[3].driving_force)
        friction = 0.5 * (old[3].interface.tangential + new[3].interface.tangential)
        ledger.drive += drive * du[self.x[0, 0]]
        ledger.friction -= friction @ du[self.x[0]]
        powers = [o.interface.tangential @ o.interface.slip_rate for o in (old[3], new[3])]
        ledger.friction_by_rates -= 0.5 * step * sum(powers)
        ledger.top += 0.5 * (old[4] + new[4]) @ du[self.y[-1]]
        kinetic = [0.5 * q[1] @ self.mass @ q[1] for q in (old, new)]
        ledger.scheme += 0.5 * (old[2] + new[2]) @ self.mass @ du - (kinetic[1] - kinetic[0])


def event_is_over(state, ledger, report):
    """The slip rate was above 1 cm/s and is below 10 V again."""
    return ledger.fastest > 1e-2 and report.interface.slip_rate.max() < 1e-4


def event(law, tolerance, perturbation=Perturbation()):
    parameters = coarse(law, tolerance, perturbation)
    return Accountant(parameters).books(run(parameters), event_is_over)


TOLERANCES = (1e-1, 1e-2, 1e-3)


@pytest.mark.parametrize("law", ["aging", "slip"])
def test_energy_balance_through_an_event(law):
    ledgers = [event(law, tolerance) for tolerance in TOLERANCES]
    print(f"\nenergy (J/m), {law} law")
    for tolerance, books in zip(TOLERANCES, ledgers, strict=True):
        print(f"  tolerance {tolerance:g}: residual {books.residual / books.friction:.1e}", books)
    for books in ledgers:
        assert books.fastest > 1e-2
        assert abs(books.residual) < 1e-11 * books.friction
        assert books.most_kinetic > 1e6 * abs(books.residual)  # so inertia is seen, too
        assert 0.0 < books.scheme < 3e-4 * books.friction
    stated = [row[1:] for row in rows("Energy") if row[0] == law]
    for tolerance, books, row in zip(TOLERANCES, ledgers, stated, strict=True):
        # which steps are rejected hangs on the last bits, and the scheme's dissipation on the steps
        assert [float(cell) for cell in row] == [
            tolerance,
            pytest.approx(books.friction, rel=2e-3),
            pytest.approx(books.scheme / books.friction, rel=0.2),
        ]
    shares = [books.scheme / books.friction for books in ledgers]
    assert shares[1] < 0.5 * shares[0]
    assert shares[2] < 0.5 * shares[1]
    assert shares[2] < 5e-5
    mismatch = [abs(books.friction_by_rates / books.friction - 1) for books in ledgers]
    print("  friction by slip rates, relative difference:", *(f"{m:.1e}" for m in mismatch))
    assert mismatch[2] < 0.3 * mismatch[0]
    assert mismatch[2] < 5e-4


@pytest.mark.parametrize("kind", KINDS[1:])
def test_energy_balance_of_perturbed_loads(kind):
    declared = Perturbation(kind=kind, strength=0.01, correlation_time=0.5, seed=1)
    books = event("aging", 1e-2, declared)
    assert books.fastest > 1e-2
    assert abs(books.residual) < 1e-11 * books.friction
    assert abs(books.friction_by_rates / books.friction - 1) < 2e-3
