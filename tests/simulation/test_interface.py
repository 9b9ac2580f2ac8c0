"""The interface's solution: a node's own balance, and how often Newton's method fails."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.optimize import brentq

from nucleation.api import Fault, Friction
from nucleation.model.friction.laws import dieterich_ruina
from nucleation.simulation.passes import LARGEST_ASINH, balanced_asinh

GRANITE = {
    "shear_modulus": 30e9,
    "poisson_ratio": 0.25,
    "normal_stress": 6e6,
    "slip_distance": 5e-7,
    "friction": 0.6,
    "velocity": 1e-5,
    "height": 0.05,
    "density": 2650.0,
}
decades = st.floats(-30.0, 30.0).map(lambda power: 10.0**power)


@example(size=10.0**-28.75, e=1e-21, c=1e-21, step=1e9)  # ended at half of a short bracket
@given(size=decades, e=decades, c=decades, step=st.just(0.0) | decades)
def test_a_node_alone_is_solved_to_the_end(size, e, c, step):
    """Six iterations left errors of a twentieth, which then stayed the same for ever."""

    def excess(z):
        return e * math.sinh(z) + c * (z + step * math.tanh(z)) - size

    high = min(size / c, math.asinh(size / e), LARGEST_ASINH)
    if excess(high) <= 0.0:
        expected = high  # round-off, or the largest that is searched
    else:
        expected = brentq(excess, 0.0, high, xtol=1e-300, rtol=1e-14, maxiter=2000)
    found = balanced_asinh(size, e, c, step)
    balanced = abs(excess(found)) < 1e-14 * size  # to round-off, where the sum hardly changes
    assert balanced or found == pytest.approx(expected, rel=1e-9, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("b", [0.012, 0.024])
@pytest.mark.parametrize("law", ["dieterich_ruina", "product"])
def test_few_steps_are_rejected(law, b):
    """A third of them was, by the Dieterich-Ruina law: Newton's method failed in eight steps."""
    scales = {"slip_rate_scale": 1e-7, "state_scale": 6.6e-3 * 0.05} if law == "product" else {}
    friction = Friction(law=law, slip_distance=5e-7, regularisation_slip_rate=1e-9, **scales)
    fault = Fault(**GRANITE, a=0.008, b=b, friction_law=friction)
    record = fault.simulate(n_x=60, n_y=4, end_time=10.0, block_length=1.5, progress=False)
    rejected, accepted = record.attrs["rejected_steps"], record.attrs["steps"]
    assert rejected < 0.03 * (accepted + rejected)


@pytest.mark.parametrize("ratio", [300.0, 651.0, 3e3, 3e4, 9e5])
def test_a_large_ratio_of_f_to_a_runs(ratio):
    """Above 650 the first step failed: f jumped at rest, and a stress within had no slip rate."""
    a = 0.4 / ratio
    pmma = GRANITE | {"shear_modulus": 3.1e9, "normal_stress": 1e6, "friction": 0.4}
    pmma |= {"height": 0.02, "second_shear_modulus": math.inf}
    fault = Fault(**pmma, a=a, b=a + 0.02)
    record = fault.simulate(n_x=16, n_y=2, end_time=1.0, block_length=1.5, progress=False)
    assert record.attrs["status"].startswith("completed")
    assert record.attrs["rejected_steps"] < 0.1 * record.attrs["steps"]


def test_the_largest_exponent_does_not_matter_where_the_interface_slips(monkeypatch):
    v = np.geomspace(1e-20, 1.0, 50)
    psi = np.log(1e-3)
    found = []
    for largest in (650.0, 100.0):
        monkeypatch.setattr(dieterich_ruina, "_LARGEST_EXPONENT", largest)
        law = Friction(law="dieterich_ruina", log_rate_coefficient=4e-4)
        found.append(np.array(law.coefficient_and_slopes(v, psi)))
    np.testing.assert_allclose(*found, rtol=1e-7)


@pytest.mark.parametrize("exponent", [10.0, 700.0, 3e4])
def test_friction_is_continuous_at_rest_and_has_its_slope(exponent):
    law = Friction(law="dieterich_ruina", log_rate_coefficient=0.41 / exponent)
    s = float(law.linear_below(0.0))
    v = s * np.array([-3.0, -1.0, -0.1, 0.0, 0.1, 1.0, 3.0])
    step = 1e-6 * s
    f, by_rate, _ = law.coefficient_and_slopes(v, np.zeros(v.size))
    after, before = (law.coefficient_and_slopes(v + d, np.zeros(v.size))[0] for d in (step, -step))
    np.testing.assert_allclose((after - before) / (2.0 * step), by_rate, rtol=1e-5)
    assert f[3] == 0.0 and (np.diff(f) > 0.0).all()
