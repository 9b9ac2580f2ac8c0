"""What runs compile of friction laws and state evolutions is what these say."""

import numpy as np
import pytest
from scipy.special import wrightomega

from nucleation.model.friction import EVOLUTIONS, LAWS, Friction
from nucleation.simulation import passes
from nucleation.simulation.interface import compiled_friction

RATES = np.array([-1e-5, 0.0, 1e-40, 1e-9, 1e-6, 1e-3, 1.0])
STATES = np.linspace(-12.0, 9.0, RATES.size)
STEP = 0.01  # s


def compiled(law):
    return compiled_friction(type(law).formula, law.evolution_law.implicit_log_state)


def at_end_of_step(law, rates):
    """State, friction coefficient and its total slope, compiled."""
    v0, distance = law.regularisation_slip_rate, law.slip_distance
    return compiled(law)(rates, STATES, STEP, v0, distance, law.constants)


@pytest.mark.parametrize("ends", [(-690, -30), (-30, -1), (-1, 2), (2, 100), (1e2, 1e6)])
def test_wright_omega_is_scipys(ends):
    z = np.linspace(*ends, 1001)
    np.testing.assert_allclose(passes.wright_omega(z), wrightomega(z), rtol=1e-14)


def test_wright_omega_of_what_has_none():
    """Far below, w = exp(z) vanishes; what is not finite ends the iteration and stays so."""
    assert 0.0 < passes.wright_omega(-1e6) < 1e-300
    assert np.isnan(passes.wright_omega(np.array([np.nan, 1.0]))[0])


@pytest.mark.parametrize("evolution", sorted(EVOLUTIONS))
@pytest.mark.parametrize("name", sorted(LAWS))
def test_friction_at_the_end_of_a_step(name, evolution):
    law = Friction(law=name, evolution=evolution)
    psi, coefficient, slope = at_end_of_step(law, RATES)
    rate = law.slip_speed(RATES) / law.slip_distance
    expected, _ = law.evolution_law.implicit_log_state(STATES, STEP, rate)
    np.testing.assert_allclose(psi, expected, rtol=1e-13)
    np.testing.assert_allclose(coefficient, law.coefficient(RATES, np.exp(psi)), rtol=1e-13)
    moving = np.abs(RATES) >= 1e-9
    ahead, behind = (at_end_of_step(law, RATES * (1.0 + h))[1] for h in (1e-6, -1e-6))
    by_difference = (ahead - behind)[moving] / (2e-6 * RATES[moving])
    np.testing.assert_allclose(slope[moving], by_difference, rtol=1e-5)


def test_compiled_functions_have_names_of_their_own():
    """Two of one name, kept by two processes, were one symbol in a third, which failed."""
    laws = [Friction(law=name, evolution=e) for name in LAWS for e in EVOLUTIONS]
    names = {compiled(law).py_func.__qualname__ for law in laws}
    assert len(names) == len(laws)
