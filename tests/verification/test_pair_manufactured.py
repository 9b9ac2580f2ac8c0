"""Manufactured solutions of two blocks with friction between them: exact fields, orders in h."""

import dataclasses

import numpy as np
import pytest

from benchmarks.manufactured.dynamics import Manufactured, block_field
from benchmarks.manufactured.fields import Displacement, Loads, Term, power, sine
from benchmarks.manufactured.orders import FIELDS, MESH_RUNG, MESH_STEPS, SCALE, log_state, orders
from benchmarks.nodal import nodal_values
from nucleation.fem.grid import Field, Motion
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.start import body_of

pytestmark = pytest.mark.slow

QUADRATIC = power(1.0, -5e2, 7e5)
LIFT = {  # u_y on the interface, which both blocks share
    "exact": Term(0.5 * SCALE, power(0.3, 0.6), power(1.0), QUADRATIC),
    "mesh": Term(0.5 * SCALE, sine(2.4, 0.4), power(1.0), QUADRATIC),
}


def joined(*layers):
    modes, edges = zip(*((field.modes, field.edge) for field in layers), strict=True)
    return Field(np.concatenate(modes), np.concatenate(edges))


class ManufacturedPair(Manufactured):
    """The same loads on either block, friction between them; the lower one is held upside down.

    The contact's forces on the upper block are those of a single one: friction and normal force of
    its own stress, less the applied traction. The lower block is given what its own stress asks
    for beyond the opposite of those.
    """

    def body_of(self, run):
        """The pair, with nothing to take from its motion as a whole: these loads have momentum."""
        body = body_of(run)
        body.translations = ()
        return body

    def __init__(self, parameters, exact, below, log_state, lumped):
        super().__init__(parameters, exact, log_state, lumped)
        self.below, self.loads_below = below, Loads(self.body.layers[1].grid, below)

    def load(self, time):
        above, below = self.loads.nodal(time), self.loads_below.nodal(time)
        applied = self.applied_force(time)
        above[0, 0] += applied
        shear, normal = (-self.loads.along_x @ s for s in self.loads.interface_stress(time))
        own = [-self.loads.along_x @ s for s in self.loads_below.interface_stress(time)]
        below[0, 0] += own[0] + (shear - applied)
        below[1, 0] += own[1] - normal
        return joined(self.loads.field(above), self.loads_below.field(below))

    def nodal_exact_below(self, time, **orders):
        grid = self.body.layers[1].grid
        x, y = grid.x[None], grid.y[:, None]
        return np.array([self.below.value(c, x, y, time, **orders) for c in (0, 1)])

    def exact_w(self, time):
        x = self.grid.x[1:]
        return super().exact_w(time) - self.below.value(0, x, np.zeros_like(x), time)

    def exact_slip_rate(self, x, time, by_t=0):
        own = self.below.value(0, x, np.zeros_like(x), time, by_t=1 + by_t)
        return super().exact_slip_rate(x, time, by_t) - own

    def exact_motion(self, time):
        u, rate = (
            joined(
                block_field(self.body, self.nodal_exact(time, by_t=order)),
                block_field(self.body, self.nodal_exact_below(time, by_t=order)),
            )
            for order in (0, 1)
        )
        return Motion(u, rate, self.body.momentum_x(rate), np.zeros(1), np.zeros(1))

    def displacement_error_below(self, state):
        x, y = nodal_values(self.body, state.motions[0].displacement, 1)
        return self.loads_below.mean_over_area(
            np.array([x, -y]) - self.nodal_exact_below(state.time)
        )


def problem(name, law, rows):
    fields = FIELDS[name]
    parameters = PAPER_RUN.replaced(
        slip_distance=2e-6,
        evolution=law,
        velocity=fields.velocity,
        height=0.3,
        block_length=1.0,
        n_x=2 * rows,
        n_y=rows,
        grading=3.0,
    ).replaced(
        second_body="deformable",
        second_shear_modulus=7e9,
        second_density=2500.0,
        second_poisson_ratio=0.2,
        second_height=0.2,
        second_grading=1.0,
    )
    (w_x, u_y), material = fields.displacement.terms, fields.displacement.material
    lift = LIFT[name]
    above = Displacement((w_x, (*u_y, lift)), material)
    # the lower block: other fields in space, the same kind in time; upside down
    along = [dataclasses.replace(t, amplitude=-0.4 * t.amplitude, t=QUADRATIC) for t in w_x]
    across = [dataclasses.replace(t, amplitude=0.7 * t.amplitude) for t in u_y]
    down = dataclasses.replace(lift, amplitude=-lift.amplitude)
    below = Displacement((tuple(along), (*across, down)), parameters.below.material)
    return ManufacturedPair(parameters, above, below, log_state(fields, parameters), fields.lumped)


def errors(solved, *rungs):
    state, _ = solved.run(*rungs)
    return (
        solved.displacement_error(state) / SCALE,
        solved.displacement_error_below(state) / SCALE,
        solved.slip_rate_error(state) / solved.velocity,
        solved.log_state_error(state),
    )


@pytest.mark.parametrize("law", ["aging", "slip"])
def test_exact_for_bilinear_fields_quadratic_in_time(law):
    """Elements and time stepping are exact for these fields: only round-off is left."""
    found = errors(problem("exact", law, 5), *[-56] * 10)
    assert max(found) < 1e-10


def test_second_order_in_h():
    rungs = [MESH_RUNG] * MESH_STEPS
    found = np.array([errors(problem("mesh", "aging", rows), *rungs) for rows in (4, 8, 16)])
    np.testing.assert_allclose(orders(found)[-1], 2.0, atol=0.1)
    assert (found[-1] < (9e-3, 8e-3, 3.5e-2, 8e-3)).all()
