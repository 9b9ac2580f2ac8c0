"""The full friction law with given constants of the logarithmic law."""

import dataclasses

import pytest

from nucleation.model.friction.constants import constants, full_law, with_constants
from nucleation.model.friction.law import Friction
from nucleation.model.quantities import ParameterError

V = 1e-5


def measured(law: Friction, v: float) -> tuple[float, float, float]:
    """f, a and zeta by differences of the law's values, without its derivatives."""
    step = 1e-4
    fast, slow = v * (1 + step), v * (1 - step)
    state = float(law.steady_state(v))
    f = float(law.coefficient(v, state))
    a = float(law.coefficient(fast, state) - law.coefficient(slow, state)) / (2 * step)
    zeta = -float(law.steady_coefficient(fast) - law.steady_coefficient(slow)) / (2 * step)
    return f, a, zeta


@pytest.mark.parametrize("wanted", [(0.41, 0.0068, 0.016), (0.6, 0.01, 0.002), (0.7, 0.015, 0.015)])
@pytest.mark.parametrize("velocity", [1e-9, 1e-5, 1e-2])
def test_law_has_its_constants(wanted, velocity):
    plain = Friction(regularisation_slip_rate=1e-12, slip_rate_scale=1e-11, state_scale=1e-3)
    law = full_law(plain, velocity, *wanted)
    assert measured(law, velocity) == pytest.approx(wanted, rel=2e-6, abs=1e-9)
    kept = ("characteristic_slip_distance", "slip_rate_scale", "state_scale", "evolution")
    assert all(getattr(law, name) == getattr(plain, name) for name in kept)


def test_regularisation_is_taken_into_account():
    plain = Friction(regularisation_slip_rate=5e-7, evolution="slip")
    law = full_law(plain, V, 0.41, 0.01, 0.01)
    assert measured(law, V) == pytest.approx((0.41, 0.01, 0.01), rel=2e-6)
    assert law.evolution == "slip"


def test_own_constants_give_the_same_law():
    law = Friction()
    again = full_law(law, V, *law.expansion(V))
    values = [[v for v in dataclasses.astuple(x) if isinstance(v, float)] for x in (again, law)]
    assert values[0] == pytest.approx(values[1], rel=1e-12)


def test_constants_not_given_are_kept():
    law = with_constants(Friction(), V, {"zeta_over_a": 1.0, "height": 0.1})
    usual = constants(Friction(), V)
    a = usual["direct_effect"]
    changed = {"zeta_over_a": 1.0, "velocity_weakening": a, "evolution_effect": 2.0 * a}
    assert constants(law, V) == pytest.approx(usual | changed, rel=1e-12)
    assert with_constants(Friction(), V, {"height": 0.1}) == Friction()


def test_weakening_is_given_alone_or_over_the_direct_effect():
    law = with_constants(Friction(), V, {"velocity_weakening": 0.004})
    assert measured(law, V)[1:] == pytest.approx((constants(Friction(), V)["direct_effect"], 0.004))
    both = with_constants(Friction(), V, {"velocity_weakening": 0.004, "direct_effect": 0.008})
    assert measured(both, V)[1:] == pytest.approx((0.008, 0.004), rel=2e-6)
    with pytest.raises(ParameterError, match=r"zeta_over_a is not .* with velocity_weak"):
        with_constants(Friction(), V, {"velocity_weakening": 0.004, "zeta_over_a": 1.0})
    same = with_constants(Friction(), V, {"evolution_effect": 0.012, "direct_effect": 0.008})
    assert constants(same, V) == pytest.approx(constants(both, V), rel=1e-12)


@pytest.mark.parametrize("bad", [(0.4, 0.01, 0.2), (0.3, 0.2, 0.0), (0.4, 0.01, -0.02)])
def test_no_law_is_said(bad):
    with pytest.raises(ParameterError, match="no friction law has f ="):
        full_law(Friction(), V, *bad)
