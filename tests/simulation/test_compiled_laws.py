"""What runs compile of a friction law is what it says."""

import numpy as np
import pytest

from nucleation.model.friction.law import Friction
from nucleation.model.friction.registry import EVOLUTIONS, LAWS
from nucleation.simulation import compiled_laws

RATES = np.array([-1e-5, 0.0, 1e-40, 1e-9, 1e-6, 1e-3, 1.0])
STATES = np.linspace(-12.0, 9.0, RATES.size)


@pytest.mark.parametrize("name", sorted(LAWS))
def test_formula(name):
    law = Friction(law=name)
    compiled = compiled_laws.formula(law)(RATES, STATES, law.constants)
    for one, other in zip(compiled, law.coefficient_and_slopes(RATES, STATES), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-14)


@pytest.mark.parametrize("name", sorted(EVOLUTIONS))
def test_implicit_log_state(name):
    law = Friction(evolution=name)
    arguments = (STATES, 0.01, law.slip_speed(RATES) / law.characteristic_slip_distance)
    compiled = compiled_laws.implicit_log_state(law)(*arguments)
    plain = law.evolution_law.implicit_log_state(*arguments)
    for one, other in zip(compiled, plain, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-13)
