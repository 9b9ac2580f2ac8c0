"""What holds to round-off: discrete balance at every step, and rigid motion.

That the separable solver equals the assembled matrix for any load, inertia and interface
displacement, that D is symmetric, and that uniform strain is exact is in tests/fem/test_block.py;
that Newton's method converges quadratically in tests/simulation/test_step.py.
"""

import numpy as np
import pytest
from fem.assembled_problem import AssembledBlock

from benchmarks.manufactured.orders import MATERIAL
from nucleation.fem.body import Body
from nucleation.fem.grid import Grid
from nucleation.fem.operator import Operator
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.start import at_rest, composed

VELOCITY = 1e-3  # m/s; a patch forms within some steps
# growing steps, then many of 3e-5 s, some of them shorter, while the first nodes break loose
LADDER = (*range(-92, -60, 4), *[-60, -60, -62, -61] * 25)
ROUND_OFF = 2e-12  # of forces, over the largest: accelerations are differences of displacements


def sliding_block(law, grading):
    return PAPER_RUN.replaced(
        height=0.02,
        block_length=0.4,
        n_x=16,
        n_y=4,
        grading=grading,
        evolution=law,
        normal_stress=2e5,
        velocity=VELOCITY,
    )


def slope_at_the_newest(times, values):
    """Derivative at times[0] of the polynomial through the values, newest first."""
    powers = (np.array(times) - times[0])[:, None] ** np.arange(len(times))
    weights = np.linalg.solve(powers.T, np.eye(len(times))[1])
    return np.tensordot(weights, np.array(values), axes=1)


@pytest.mark.slow
@pytest.mark.parametrize("grading", [1.0, 3.0])
@pytest.mark.parametrize("law", ["aging", "slip"])
def test_every_step_obeys_the_assembled_equation_of_motion(law, grading):
    """``K u + M a`` is balanced in the bulk and is the reported force on every driven node.

    So the driving force, which the solver takes from the balance of the interface and of the
    momentum, is the reaction of the driven edge, through the whole run.
    """
    parameters = sliding_block(law, grading)
    dynamics = composed(parameters)
    block = AssembledBlock(dynamics.grid, parameters.upper.material)
    top = block.top_load(parameters.fault.normal_stress)
    state, report = at_rest(dynamics, parameters)

    def assembled(field):
        out = np.empty_like(top)
        out[block.x], out[block.y] = dynamics.body.nodal_values(field)
        return out

    times, velocities = [state.time], [assembled(state.velocity)]
    worst = dict.fromkeys(("bulk", "tangential", "normal", "driving force"), 0.0)
    inertia = 0.0
    for rung in LADDER:
        state, report = dynamics.advance(state, rung)
        times, velocities = [state.time, *times[:2]], [assembled(state.velocity), *velocities[:2]]
        # BDF2 differentiates the parabola through three values, the first step a line
        acceleration = slope_at_the_newest(times, velocities)
        force = block.stiffness @ assembled(state.displacement) + block.mass @ acceleration - top
        interface, scale = report.interface, np.abs(force).max()
        inertia = max(inertia, np.abs(block.mass @ acceleration).max() / scale)
        # the driven edge has its own reaction and, at its foot, friction beside it
        edge = force[block.x[:, 0]].sum() - interface.tangential[0]
        for name, found, expected in (
            ("bulk", force[block.free], 0.0),
            ("tangential", force[block.x[0, 1:]], interface.tangential[1:]),
            ("normal", force[block.y[0]], interface.normal),
            ("driving force", -edge, report.driving_force),
        ):
            worst[name] = max(worst[name], np.abs(found - expected).max() / scale)
    assert np.count_nonzero(interface.slip_rate > 0.01 * VELOCITY) >= 3  # a patch has formed
    assert inertia > 1e-3  # so a part missing from it would be seen
    assert max(worst.values()) < ROUND_OFF


@pytest.mark.parametrize("grading", [1.0, 3.0])
def test_rigid_motion_needs_no_force(grading):
    """Translations and an infinitesimal rotation, by the assembled matrix and by the solver."""
    grid = Grid(0.7, 0.2, 9, 5, grading)
    block = AssembledBlock(grid, MATERIAL)
    x, y = np.meshgrid(grid.x, grid.y)
    for u_x, u_y in ((1.0, 0.0), (0.0, 1.0), (-y, x)):
        u = np.zeros(block.stiffness.shape[0])
        u[block.x], u[block.y] = u_x, u_y
        assert np.abs(block.stiffness @ u).max() < 1e-14 * np.abs(block.stiffness).max()
    # the period of a long block, held at its interface alone
    operator = Operator(Body((Grid(0.7, 0.2, 9, 5, grading, periodic=True), MATERIAL)), 0.0)
    tangential, normal = operator.apply(np.ones(grid.n_x))
    assert np.abs(tangential).max() < 1e-13 * operator.diagonal.max()
    assert np.abs(normal).max() < 1e-13 * operator.diagonal.max()
