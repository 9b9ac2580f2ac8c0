"""Both friction laws against their formulas and the paper's numbers; laws are files.

What holds for every law is in test_laws.py.
"""

import math

import numpy as np
import pytest

import nucleation.model.friction.laws as laws
from nucleation.datasets import code
from nucleation.model.friction import LAWS, Friction, law_class, module, plugins
from nucleation.model.friction.constants import full_law
from nucleation.model.quantities import ParameterError
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.checkpoints import SIMULATION
from replication.tables.curves import logarithmic_friction

LAW = Friction(law="product")
RATES = np.array([1e-13, 1e-9, 1e-7, 1e-5, 1e-3, 1.0])
STATES = np.array([1e-6, 3.3e-4, 0.05, 1.0, 500.0])


def written_out(v, phi):
    """Eq. (S-f) with Table S1, typed in once more."""
    aging = 1 + 0.075 * np.log(1 + phi / 3.3e-4)
    return aging * ((5 / 18) / np.sqrt(1 + (1e-9 / v) ** 2) + 0.005 * np.log(1 + v / 1e-7))


def test_coefficient_is_the_papers():
    v, phi = np.meshgrid(RATES, STATES)
    np.testing.assert_allclose(LAW.coefficient(v, phi), written_out(v, phi), rtol=1e-12)


def test_state_rate_is_the_papers():
    v, phi = np.meshgrid(RATES, STATES)
    omega = phi * np.sqrt(v**2 + 1e-18) / 5e-7
    for evolution, expected in (("aging", 1 - omega), ("slip", -omega * np.log(omega))):
        found = Friction(law="product", evolution=evolution).state_rate(v, phi)
        np.testing.assert_allclose(found, expected)
    assert LAW.steady_state(0.0) == pytest.approx(500.0)  # D/v0


def test_expansion_gives_the_papers_numbers():
    """f0 = 0.414, a = 0.00682, zeta = 0.0156 (Text S2.1), from Table S1 alone."""
    f0, a, zeta = LAW.expansion(1e-5)
    assert round(f0, 3) == 0.414
    assert round(a, 5) == 0.00682
    assert round(zeta, 4) == 0.0156


def test_logarithmic_law_touches_the_full_one():
    """Value and first derivatives agree at the point of expansion (Eq. S-log)."""
    v, phi, h = 1e-5, 0.05, 1e-4
    assert logarithmic_friction(LAW, v, phi, v) == pytest.approx(LAW.coefficient(v, phi), rel=1e-9)
    for dv, dphi in ((h, 0.0), (0.0, h)):
        fast, slow = (v * (1 + dv), phi * (1 + dphi)), (v * (1 - dv), phi * (1 - dphi))
        full = LAW.coefficient(*fast) - LAW.coefficient(*slow)
        log = logarithmic_friction(LAW, *fast, v) - logarithmic_friction(LAW, *slow, v)
        assert log == pytest.approx(full, rel=1e-4)


V = 1e-5


def law(**values):
    return Friction(law="dieterich_ruina", **values)


def test_coefficient_is_the_formula():
    """With values of the SEAS benchmarks, typed in once more."""
    friction = law(
        reference_friction=0.6,
        reference_slip_rate=1e-6,
        log_rate_coefficient=0.010,
        log_state_coefficient=0.015,
        slip_distance=0.008,
    )
    v, phi = np.meshgrid(np.geomspace(1e-16, 10.0, 9), np.geomspace(1e-3, 1e9, 7))
    exponent = (0.6 + 0.015 * np.log(1e-6 * phi / 0.008)) / 0.010
    expected = 0.010 * np.arcsinh(v / 2e-6 * np.exp(exponent))
    np.testing.assert_allclose(friction.coefficient(v, phi), expected, rtol=1e-12)


def test_its_usual_values_are_the_main_texts():
    assert law().expansion(V) == pytest.approx((0.41, 0.0068, 0.016), rel=1e-7)


def test_expansion_where_the_state_is_regularised():
    """``zeta = b (V/w)^2 - a``: below v0 the state of steady sliding no longer depends on V."""
    friction = law(regularisation_slip_rate=V)
    f, a, zeta = friction.expansion(V)
    assert a == pytest.approx(0.0068) and zeta == pytest.approx(0.0228 / 2 - 0.0068)
    assert f == pytest.approx(0.41 - 0.0228 / 2 * math.log(2.0))
    again = full_law(friction, V, f, a, zeta)
    assert again.log_state_coefficient == pytest.approx(0.0228)


def test_constants_of_a_law_that_is_hardly_logarithmic():
    """For f = 3 a the hyperbolic tangent counts: a is not the law's own coefficient."""
    friction = full_law(law(), V, 0.03, 0.01, 0.002)
    assert friction.expansion(V) == pytest.approx((0.03, 0.01, 0.002), rel=1e-9)
    assert friction.log_rate_coefficient > 0.01 * 1.003


def test_what_no_double_can_hold_is_refused():
    with pytest.raises(ParameterError, match=r"log_rate_coefficient = 1e-07 .* 4.1e-07 or more"):
        law(log_rate_coefficient=1e-7)


@pytest.mark.parametrize("a", [1e-3, 1e-5])
def test_a_small_direct_effect_has_the_logarithm(a):
    """exp(f/a) overflows; a below f/300 was refused."""
    small = law(log_rate_coefficient=a)
    v, psi = np.array([-2e-5, 0.0, 1e-7, 2e-5]), np.log(3.0)
    f, by_rate, by_log_state = small.coefficient_and_slopes(v, psi)
    constants = small.reference_friction, small.reference_slip_rate, small.log_state_coefficient
    f0, rate, b = constants
    state = b * (psi + np.log(rate / small.slip_distance))
    expected = f0 + a * np.log(np.abs(v[[0, 2, 3]]) / rate) + state
    assert np.abs(f[[0, 2, 3]]) == pytest.approx(expected, rel=1e-12)
    assert f[0] == -f[3] and f[1] == 0.0
    assert by_rate[2] == pytest.approx(a / v[2], rel=1e-12)
    assert by_log_state[3] == pytest.approx(b)


def test_extreme_states_stay_finite():
    v = np.array([-1.0, -1e-300, 0.0, 1e-300, 1e-9, 1e3])
    for log_state in (-300.0, 0.0, 300.0):
        for values in law().coefficient_and_slopes(v, log_state):
            assert np.isfinite(values).all()


HOME = "nucleation.model.friction"


def test_each_class_bears_the_name_of_its_file():
    for name in LAWS:
        assert law_class(name)().law == name
        assert Friction(law=name) == law_class(name)()


def test_code_of_a_run_is_that_of_its_own_laws():
    """No law is reached by imports: the digest has those that are named beside, and no other."""
    packages = (f"{HOME}.laws.", f"{HOME}.evolutions.")
    plain = code.closure(SIMULATION)
    assert HOME in plain and not [name for name in plain if name.startswith(packages)]
    own = plugins(PAPER_RUN.law)
    whole = code.closure(SIMULATION, *map(code.Root, own))
    assert {name for name in whole if name.startswith(packages)} == set(own)


def test_another_law_keeps_what_all_share():
    friction = Friction(law="product", slip_distance=1e-6, evolution="slip", aging_coefficient=0.1)
    own = {"law": "dieterich_ruina", "log_state_coefficient": 0.02}
    assert friction.changed(own) == Friction(slip_distance=1e-6, evolution="slip", **own)
    assert friction.changed({"law": "product"}) == friction


def test_parameters_of_another_law_are_refused():
    words = r"= 0\.1, state_scale = 1\.0 is not .* dieterich_ruina has no such .* has law, evolu"
    with pytest.raises(ParameterError, match=words):
        Friction(law="dieterich_ruina", aging_coefficient=0.1, state_scale=1.0)
    with pytest.raises(ParameterError, match=r"friction_law = 'none'.*one of dieterich_ruina, pr"):
        Friction(law="none")
    for values in ({}, {"slip_distance": 1e-6}):  # no constants of the paper unasked
        with pytest.raises(ParameterError, match=r"missing: give law, .*paper's is product"):
            Friction(**values)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a = 1\ndef growth(:\n", "SyntaxError: .*odd.py, line 2"),
        ("a = 1\nb = 2\nc = d\n", "NameError: name 'd'"),
    ],
)
def test_a_file_that_can_not_be_loaded_is_named(text, said, tmp_path, monkeypatch):
    (tmp_path / "odd.py").write_text(text)
    monkeypatch.setattr(laws, "__path__", [*laws.__path__, str(tmp_path)])
    with pytest.raises(ParameterError, match=rf"laws/odd.py: the law odd can't be loaded: {said}"):
        module("laws", "odd")
