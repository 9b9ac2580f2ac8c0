"""Steps of the coupled problem: the start, statics, repetition and Newton's method."""

import dataclasses
import itertools

import numpy as np
import pytest

from benchmarks.nodal import nodal_values
from nucleation.fem.operator import Operator
from nucleation.run.run import PAPER_RUN
from nucleation.simulation import interface, passes, step
from nucleation.simulation.interface import NewtonFailure
from nucleation.simulation.run import instants
from nucleation.simulation.start import at_rest, composed


def small(law="aging", **mesh):
    mesh = {"n_x": 16, "n_y": 4, "grading": 2.0, "height": 0.02, "block_length": 0.4} | mesh
    return PAPER_RUN.replaced(evolution=law, normal_stress=2e5, velocity=1e-3, **mesh)


# growing steps, then many of 3e-5 s (D/V is 5e-4 s) while the first nodes break loose
LADDER = (*range(-92, -60, 4), *[-60] * 100)


def test_initial_force_is_that_of_uniaxial_strain():
    parameters = PAPER_RUN.replaced(height=0.01, block_length=0.4, n_x=60, n_y=8)
    _, report = at_rest(composed(parameters), parameters)
    nu = parameters.fault.poisson_ratio
    expected = -nu / (1 - nu) * parameters.fault.normal_stress * parameters.fault.height
    assert report.driving_force == pytest.approx(expected, rel=1e-9)


def test_start_in_uniform_shear_carries_it_at_every_node():
    shear = 5e4
    run = small().replaced(initial_stress="uniform_shear", initial_shear_stress=shear)
    dynamics = composed(run)
    state, report = at_rest(dynamics, run)
    forces = shear * dynamics.grid.nodal_lengths[1:]
    # the tangent leaves out couplings through the right edge below 1e-8
    np.testing.assert_allclose(report.interface.tangential[1:], -forces, rtol=3e-8)
    assert report.driving_force == pytest.approx(-forces.sum(), rel=1e-8)
    np.testing.assert_array_equal(state.past_w[0], report.interface.w)


def test_start_without_shear_is_uniaxial_stress():
    """The relaxed start: sigma_xx = sigma_xy = 0 everywhere, which bilinear elements hold."""
    parameters = small().replaced(initial_stress="uniform_shear")
    dynamics = composed(parameters)
    state, report = at_rest(dynamics, parameters)
    u_x, u_y = nodal_values(dynamics.body, state.motions[0].displacement)
    material, stress = parameters.upper.material, parameters.fault.normal_stress
    x, y = np.meshgrid(dynamics.grid.x, dynamics.grid.y)
    nu, scale = material.poisson_ratio, stress / (2.0 * material.shear_modulus)
    np.testing.assert_allclose(u_x, nu * scale * x, atol=1e-9 * scale)
    np.testing.assert_allclose(u_y, -(1.0 - nu) * scale * y, atol=1e-9 * scale)
    assert abs(report.driving_force) < 1e-8 * stress * parameters.fault.height
    carried = stress * dynamics.grid.nodal_lengths
    np.testing.assert_allclose(report.interface.normal, carried, rtol=1e-8)


def test_without_density_every_step_is_a_static_field():
    parameters = small().replaced(density=0.0)
    dynamics = composed(parameters)
    static = Operator(dynamics.body, 0.0)
    load = dynamics.body.far_load(parameters.fault.normal_stress)
    state, _ = at_rest(dynamics, parameters)
    for rung in LADDER[:40]:
        state, report = dynamics.advance(state, rung)
        expected = static.respond(load, report.interface.w)
        p, scale = report.interface.tangential[1:], np.abs(expected.tangential).max()
        np.testing.assert_allclose(p, expected.tangential, rtol=1e-7, atol=1e-7 * scale)
        np.testing.assert_allclose(report.interface.normal, expected.normal, rtol=1e-7)
        assert report.driving_force == report.interface.tangential.sum()
        assert state.motions[0].momentum == 0.0


def test_a_step_changes_nothing_and_repeats_exactly():
    dynamics = composed(small())
    state, _ = at_rest(dynamics, small())
    for rung in LADDER[:20]:
        state, _ = dynamics.advance(state, rung)
    before = state.motions[0].displacement.modes.copy()
    first, _ = dynamics.advance(state, -58)
    np.testing.assert_array_equal(before, state.motions[0].displacement.modes)
    again, _ = composed(small()).advance(state, -58)
    np.testing.assert_array_equal(first.past_slip_rates, again.past_slip_rates)
    np.testing.assert_array_equal(
        first.motions[0].displacement.modes, again.motions[0].displacement.modes
    )


def test_a_residual_that_is_undefined_at_one_node_is_a_failure():
    dynamics = composed(small())
    state, _ = at_rest(dynamics, small())
    states = state.past_log_states.copy()
    states[0, 9] = np.nan
    with pytest.raises(NewtonFailure, match="not finite"):
        dynamics.advance(dataclasses.replace(state, past_log_states=states), -80)


def test_first_step_from_rest_on_a_fine_mesh():
    """The singular corner breaks loose at once; Newton's method gets there from rest."""
    parameters = PAPER_RUN.replaced(height=0.005, block_length=1.0, n_x=3200, n_y=20)
    dynamics = composed(parameters)
    _, report = dynamics.advance(at_rest(dynamics, parameters)[0], -92)
    assert report.interface.iterations > 8


def test_friction_is_evaluated_where_slip_rates_change(monkeypatch):
    """On fewer nodes than there are, with the result of an evaluation on all."""
    evaluated, found = [], []
    of_law = interface.compiled_friction

    def compiled(*functions):
        def counted(v, *others):
            evaluated[-1] += v.size
            return of_law(*functions)(v, *others)

        return counted

    monkeypatch.setattr(interface, "compiled_friction", compiled)
    for unchanged in (interface.UNCHANGED, -1.0):
        monkeypatch.setattr(interface, "UNCHANGED", unchanged)
        evaluated.append(0)
        *_, last = itertools.islice(instants(small(n_x=64)), 200)
        found.append(last.report.interface)
    assert evaluated[0] < 0.8 * evaluated[1]
    for name in ("slip_rate", "log_state", "tangential", "normal"):
        some, every = (getattr(one, name) for one in found)
        np.testing.assert_allclose(some, every, rtol=1e-7, err_msg=name)


@pytest.mark.parametrize(
    ("slow", "fastest", "length"),
    [
        (1e-2 * 1e-3, 1e-3, 1e9),  # of the imposed velocity, while the patch creeps
        (1e-3 * 1.0, 1.0, 1e9),  # of the fastest slip rate, in the event
        (1e-2 * 5e-7 / 1e-6, 1e-3, 1e-6),  # slips by a hundredth of D within a short step
    ],
)
def test_slower_slip_rates_need_no_relative_accuracy(slow, fastest, length):
    """Where a slip rate begins to be slow, its relative error counts by 1/sqrt(2)."""
    dynamics = composed(small())
    state, report = at_rest(dynamics, small())
    rates = np.full_like(report.interface.slip_rate, slow)
    rates[0] = fastest
    least = max(step.SLOW * 1e-3, step.SLIGHT_SLIP * 5e-7 / length)
    states, w, one, none = state.past_log_states, state.past_w, np.ones(1), 0.0 * rates
    scaled, guess, _, scale, *_ = passes.predicted(
        rates[None], states, w, one, (1.0, 0.0, 0.0), 1.0, fastest, False, none, least
    )
    np.testing.assert_allclose(guess, rates, rtol=1e-12)
    changed = rates * (1.0 + 1e-6)
    changed[0] = fastest
    error = passes.largest_change(changed, scaled, scale)
    assert error == pytest.approx(1e-6 / np.sqrt(2.0), rel=0.05)
