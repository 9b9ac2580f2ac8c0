"""Every friction law and every evolution there is: derivatives, parity, steady state, constants.

A new law is tested here by its file alone.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

from nucleation.model.friction import EVOLUTIONS, LAWS, Friction, law_class
from nucleation.model.friction.constants import constants_of, full_law, with_constants
from nucleation.model.quantities import ParameterError, declarations

V = 1e-5
RATES = np.array([1e-13, 1e-9, 1e-7, 1e-5, 1e-3, 1.0])
STATES = np.array([1e-6, 3.3e-4, 0.05, 1.0, 500.0])


@pytest.fixture(params=list(LAWS))
def law(request) -> Friction:
    return Friction(law=request.param)


@pytest.fixture(params=list(EVOLUTIONS))
def evolution(request):
    return Friction(law="product", evolution=request.param).evolution_law


def difference(function, x, relative=1e-4):
    """Central difference quotient of a function at x, with its round-off."""
    high, low = function(x * (1 + relative)), function(x * (1 - relative))
    span = 2 * relative * x
    return (high - low) / span, 4 * np.finfo(float).eps * abs(high) / abs(span)


@pytest.mark.parametrize("v", [-1e-4, 3e-10, 1e-7, 1e-5, 0.1])
@pytest.mark.parametrize("phi", STATES)
def test_derivatives(law, v, phi):
    by_rate, by_state = law.derivatives(v, phi)
    numeric, error = difference(lambda x: law.coefficient(x, phi), v)
    assert by_rate == pytest.approx(numeric, rel=1e-6, abs=error)
    numeric, error = difference(lambda x: law.coefficient(v, x), phi)
    assert by_state == pytest.approx(numeric, rel=1e-6, abs=error)


@pytest.mark.parametrize("phi", STATES)
def test_derivatives_where_friction_begins(law, phi):
    """About the slip rate below which friction is linear; that is what it says it is."""
    scale = float(law.linear_below(np.log(phi)))
    for v in (0.1 * scale, scale, -3.0 * scale):
        numeric, error = difference(lambda x: law.coefficient(x, phi), v, 1e-5)
        assert law.derivatives(v, phi)[0] == pytest.approx(numeric, rel=1e-5, abs=error)
    half, whole = law.coefficient(np.array([0.05, 0.1]) * scale, phi)
    assert whole == pytest.approx(2.0 * half, rel=0.05)


def test_laws_in_asinh_are(law):
    if law.asinh_of_rate:
        v, phi = np.meshgrid(RATES, STATES)
        ratio = law.coefficient(v, phi) / np.arcsinh(v / law.linear_below(np.log(phi)))
        np.testing.assert_allclose(ratio, ratio[0, 0], rtol=1e-12)


def test_friction_opposes_slip_and_vanishes_at_rest(law):
    np.testing.assert_allclose(law.coefficient(-RATES, 1.0), -law.coefficient(RATES, 1.0))
    assert (law.coefficient(RATES, 1.0) > 0.0).all() and law.coefficient(0.0, 1.0) == 0.0
    by_rate, by_log_state = law.coefficient_and_slopes(0.0, np.log(STATES))[1:]
    assert np.isfinite(by_rate).all() and (by_rate > 0.0).all() and (by_log_state == 0.0).all()


def test_strength_grows_with_slip_rate_and_state(law):
    by_rate, by_state = law.derivatives(*np.meshgrid(RATES, STATES))
    assert (by_rate > 0.0).all() and (by_state > 0.0).all()


def measured(law: Friction, v: float) -> tuple[float, float, float]:
    """f, a and zeta by differences of the law's values, without its derivatives."""
    state = law.steady_state(v)
    a, _ = difference(lambda x: float(law.coefficient(x, state)), v)
    slope, _ = difference(lambda x: float(law.steady_coefficient(x)), v)
    return float(law.coefficient(v, state)), v * a, -v * slope


@pytest.mark.parametrize("velocity", [1e-7, 1e-5, 1e-2])
def test_expansion(law, velocity):
    assert law.expansion(velocity) == pytest.approx(measured(law, velocity), rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("factors", [(1.0, 1.0, 1.0), (1.2, 0.9, 0.7), (0.9, 1.3, 1.2)])
def test_constants_set_the_law(law, factors):
    wanted = tuple(x * y for x, y in zip(law.expansion(V), factors, strict=True))
    found = full_law(law, V, *wanted)
    assert measured(found, V) == pytest.approx(wanted, rel=2e-6, abs=1e-9)
    kept = set(declarations(type(law))) - set(law.set_by_expansion)
    assert all(getattr(found, name) == getattr(law, name) for name in kept)
    assert type(found) is type(law) and len(law.set_by_expansion) == 3


@pytest.mark.parametrize("wanted", [(0.41, 0.0068, 0.016), (0.6, 0.01, 0.002), (0.7, 0.015, 0.015)])
@pytest.mark.parametrize(("velocity", "v0"), [(1e-9, 1e-12), (V, 1e-12), (1e-2, 1e-12), (V, 5e-7)])
def test_constants_at_any_velocity(wanted, velocity, v0):
    plain = Friction(
        law="product", regularisation_slip_rate=v0, slip_rate_scale=1e-11, state_scale=1e-3
    )
    law = full_law(plain, velocity, *wanted)
    assert measured(law, velocity) == pytest.approx(wanted, rel=2e-6, abs=1e-9)


def test_weakening_is_given_alone_or_over_the_direct_effect():
    law = with_constants(Friction(law="product"), V, {"zeta": 0.004})
    assert measured(law, V)[1:] == pytest.approx(
        (constants_of(Friction(law="product"), V)["a"], 0.004)
    )
    both = with_constants(Friction(law="product"), V, {"zeta": 0.004, "a": 0.008})
    assert measured(both, V)[1:] == pytest.approx((0.008, 0.004), rel=2e-6)
    with pytest.raises(ParameterError, match=r"zeta_over_a is not .* with zeta"):
        with_constants(Friction(law="product"), V, {"zeta": 0.004, "zeta_over_a": 1.0})
    same = with_constants(Friction(law="product"), V, {"b": 0.012, "a": 0.008})
    assert constants_of(same, V) == pytest.approx(constants_of(both, V), rel=1e-12)


@pytest.mark.parametrize("bad", [(0.4, 0.3, 0.1), (0.4, -0.01, 0.1), (0.4, 0.01, -0.02)])
def test_no_law_is_said(law, bad):
    with pytest.raises(ParameterError, match=r"no friction law has f = 0\.4"):
        full_law(law, V, *bad)


def test_constants_and_what_they_set_are_not_given_together(law):
    for name in law.set_by_expansion:
        values = {"zeta_over_a": 1.0, name: 0.1}
        with pytest.raises(ParameterError, match=f"{name} is not allowed together with zeta"):
            with_constants(law, V, values)
    given = with_constants(law, V, {"zeta_over_a": 1.0})
    own = constants_of(law, V)
    a = own["a"]
    changed = own | {"zeta_over_a": 1.0, "zeta": a, "b": 2.0 * a}
    assert constants_of(given, V) == pytest.approx(changed, rel=1e-9)


def test_every_parameter_is_checked(law):
    for name, entry in declarations(law_class(law.law)).items():
        bad = "none" if entry.choices else float("nan")
        with pytest.raises(ParameterError) as caught:
            Friction(**{"law": law.law, name: bad})
        rule = entry.bounds
        for part in (f"{name} = {bad!r}", entry.description, rule):
            assert part in str(caught.value)
        if name != "law":
            assert f"(friction law {law.law})" in str(caught.value)


# -- evolutions ------------------------------------------------------------------------------------


def test_evolution_about_steady_state(evolution):
    """``g(1) = 0`` and ``g'(1) = -1``, on which the linear theory stands."""
    assert evolution.growth(1.0) == 0.0 and evolution.slope(1.0) == -1.0


@pytest.mark.parametrize("omega", [1e-3, 0.3, 1.0, 4.0, 1e3])
def test_evolution_slope(evolution, omega):
    numeric, error = difference(lambda x: float(evolution.growth(x)), omega)
    assert evolution.slope(omega) == pytest.approx(numeric, rel=1e-6, abs=error)


@pytest.mark.parametrize("step", [1e-7, 1e-3, 1.0])
def test_implicit_log_state(evolution, step):
    """The closed forms against bracketing, and their derivative against differences."""
    for history in (-12.0, -3.0, 0.0, 6.0):
        for rate in (2e-3, 0.5, 20.0, 1e5):

            def residual(psi, history=history, rate=rate):
                omega = np.exp(psi) * rate
                return psi - history - step * float(evolution.growth(omega)) * np.exp(-psi)

            expected = brentq(residual, -60, 60, xtol=1e-13, rtol=1e-14)
            psi, slope = evolution.implicit_log_state(np.array(history), step, np.array(rate))
            assert psi == pytest.approx(expected, rel=1e-10, abs=1e-10)
            near = [
                evolution.implicit_log_state(np.array(history), step, np.array(rate * (1 + e)))[0]
                for e in (1e-3, -1e-3)
            ]
            numeric = (near[0] - near[1]) / (2e-3 * rate)
            assert slope == pytest.approx(numeric, rel=1e-4, abs=2e-12 / rate)


@pytest.mark.parametrize("name", EVOLUTIONS)
def test_steady_state_is_where_the_state_rests(law, name):
    friction = law.changed({"evolution": name})
    rest = friction.state_rate(RATES, friction.steady_state(RATES))
    np.testing.assert_allclose(rest, 0.0, atol=1e-12)
