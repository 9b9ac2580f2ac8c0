"""Energy balance of two blocks through a whole event, with the books of one block's test."""

import numpy as np
import pytest
from fem.assembled_pair import AssembledPair
from verification.test_energy import Accountant, event_is_over

from nucleation.fem.bodies import body_of
from nucleation.model.parameters import Parameters
from nucleation.simulation.run import run

pytestmark = pytest.mark.slow


class PairAccountant(Accountant):
    """The works and energies of both blocks, by assembled matrices."""

    def __init__(self, parameters):
        super().__init__(parameters)
        self.body = body_of(parameters)
        below = parameters.below
        assembled = AssembledPair(
            (self.body.grid, parameters.material), (self.body.lower.grid, below.material),
            below.bottom,
        )  # fmt: skip
        self.stiffness, self.mass = assembled.stiffness, assembled.mass
        self.x, self.y = assembled.x, assembled.y
        self.below_x, self.below_y = assembled.below_x, assembled.below_y
        self.loaded_below = below.bottom == "free"

    def top(self, time):
        return self.at_rest

    def vector(self, field, uniform):
        out = np.empty(self.stiffness.shape[0])
        w_x, out[self.y] = self.body.nodal_values(field)
        out[self.x] = w_x + uniform
        out[self.below_x], out[self.below_y] = self.body.nodal_values_below(field)
        return out

    def add(self, ledger, step, old, new):
        super().add(ledger, step, old, new)
        du = new[0] - old[0]
        # friction acts on the lower block as well, and so may the load
        friction = 0.5 * (old[3].interface.tangential + new[3].interface.tangential)
        ledger.friction += friction @ du[self.below_x[0]]
        if self.loaded_below:
            ledger.top -= 0.5 * (old[4] + new[4]) @ du[self.below_y[-1]]


@pytest.mark.parametrize(("bottom", "thick"), [("free", 10.0), ("clamped", 1.0)])
def test_energy_balance_of_two_blocks(bottom, thick):
    """Ten times as thin, blocks that nothing holds bend by a thousand times the slip: 3e-9."""
    parameters = Parameters().replaced(
        {"height": 0.005 * thick, "length": 0.6, "n_x": 40, "n_y": 4, "grading": 2.0,
         "longest_step": 0.2, "second_body": "deformable", "second_bottom": bottom,
         "second_shear_modulus": 6.2e9, "second_density": 2400.0,
         "second_height": 0.008 * thick, "second_n_y": 5}
    )  # fmt: skip
    books = PairAccountant(parameters).books(run(parameters), event_is_over)
    print(f"\n{bottom}: residual {books.residual / books.friction:.1e}", books)
    assert books.fastest > 1e-2
    assert abs(books.residual) < 1e-11 * books.friction
    assert books.most_kinetic > 1e6 * abs(books.residual)
    assert 0.0 < books.scheme < 3e-4 * books.friction
    assert abs(books.friction_by_rates / books.friction - 1.0) < 2e-3
