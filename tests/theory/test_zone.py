"""A layer of other stiffness beside the fault, against an integration across both layers."""

import math

import numpy as np
import pytest
from asked import ROCK, critical_length, spectrum, stability_length, transfer_functions
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm

from nucleation.api import Fault
from nucleation.model.quantities import ParameterError
from nucleation.theory.creep import response
from nucleation.theory.creep.lengths import stability_point
from nucleation.theory.pair import Layers

RIGID = {"second_shear_modulus": math.inf, "friction": 0.6}
KEPT = {"free": (0, 1), "velocity": (1, 2), "clamped": (2, 3), "roller": (0, 3)}
"""The components of (U, W, T, N) that are not zero on the far side."""


def across(mu, nu, height, k):
    """(U, W, T, N) at the near face from those at the far face, by the equations of elasticity."""
    lame = 2.0 * mu * nu / (1.0 - 2.0 * nu)
    compression = lame + 2.0 * mu
    rates = np.array(
        [
            [0.0, -k, 1.0 / mu, 0.0],
            [lame * k / compression, 0.0, 0.0, 1.0 / compression],
            [k**2 * (compression - lame**2 / compression), 0.0, 0.0, -k * lame / compression],
            [0.0, 0.0, k, 0.0],
        ]
    )
    return expm(-height * rates)


def integrated(layer, body, k):
    """The stiffness of both, over the body's modulus."""
    start = np.eye(4)[:, KEPT[body[3]]]
    near = across(*layer, k) @ across(*body[:3], k) @ start
    return -near[2:] @ np.linalg.inv(near[:2]) / (body[0] * k)


def zone_of(layer, body, antiplane=False):
    (mu, nu, thickness), (own_mu, own_nu, height, far_side) = layer, body
    arrays = [np.array([float(x)]) for x in (mu, nu, thickness, own_mu, own_nu, height)]
    zone = Layers(*arrays[:3], "free", antiplane)
    return Layers(*arrays[3:], far_side, antiplane, zone)


ratios = st.floats(-0.4, 0.49)
numbers = st.floats(0.01, 2.0)


@given(st.floats(0.05, 20.0), ratios, numbers, ratios, numbers, st.sampled_from(sorted(KEPT)))
def test_stiffness_is_that_of_both_layers(modulus, nu, thickness, own_nu, height, far_side):
    layer, body = (modulus, nu, thickness), (1.0, own_nu, height, far_side)
    found = zone_of(layer, body).stiffness(1.0)
    expected = integrated(layer, body, 1.0)
    size = np.abs(expected).max()
    entries = [[found.xx[0], -found.xy[0]], [-found.xy[0], found.yy[0]]]
    np.testing.assert_allclose(entries, expected, rtol=1e-8, atol=1e-9 * size)
    assert found.det[0] == pytest.approx(np.linalg.det(expected), rel=1e-7, abs=1e-9 * size**2)


@pytest.mark.parametrize("far_side", ["free", "clamped"])
@pytest.mark.parametrize("ratio", [0.1, 3.0])
def test_antiplane_layers(far_side, ratio):
    """mu_z k (s + r tanh kh)/(r + s tanh kh), s = tanh kH or coth kH, r = mu_z/mu."""
    k, h, height = 2.0, 0.3, 0.7
    s = math.tanh(k * height) if far_side == "free" else 1.0 / math.tanh(k * height)
    t = math.tanh(k * h)
    expected = ratio * (s + ratio * t) / (ratio + s * t)
    found = zone_of((ratio, 0.0, h), (1.0, 0.0, height, far_side), antiplane=True).stiffness(k)
    assert found.xx[0] == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("second", [{}, RIGID])
@pytest.mark.parametrize("plane", ["strain", "stress", "antiplane"])
def test_limits(second, plane):
    fault = ROCK | second | {"plane": plane, "height": 0.4}
    soft = {"zone_shear_modulus": 5e9}
    alone = critical_length(**fault)
    thin = critical_length(**fault, zone_thickness=1e-9, **soft)
    assert thin == pytest.approx(alone, rel=1e-6)
    same = critical_length(**fault, zone_thickness=0.1, zone_shear_modulus=30e9)
    assert same == pytest.approx(critical_length(**fault | {"height": 0.5}), rel=1e-12)
    thick = critical_length(**fault, zone_thickness=100.0, **soft)
    material = {"shear_modulus": 5e9, "height": math.inf}
    assert thick == pytest.approx(critical_length(**fault | material), rel=1e-9)


def test_a_gouge_between_rigid_walls_has_a_stiffness_of_its_own():
    """Long waves meet mu_z/h of the gouge in series with the rock, 2/(mu* k)."""
    k = 2.0 * math.pi / 50.0
    gouge = {"zone_thickness": 1e-3, "zone_shear_modulus": 1e8, "zone_poisson_ratio": 0.25}
    shear, _ = transfer_functions(k, shear_modulus=30e9, poisson_ratio=0.25, **gouge)
    rock = 30e9 / 0.75
    expected = 1.0 / (2.0 / (rock * k) + 2.0 * gouge["zone_thickness"] / 1e8)
    assert 30e9 * k * shear == pytest.approx(expected, rel=1e-3)


@settings(max_examples=40)
@given(
    st.floats(0.02, 30.0),
    st.floats(1e-3, 10.0),
    st.floats(0.02, 20.0),
    st.booleans(),
    st.floats(0.3, 5.0),
)
def test_nothing_grows_beyond_the_critical_wavenumber(contrast, thickness, height, rigid, ratio):
    """Against the growth rates on a fine grid of wavenumbers."""
    fault = (
        ROCK
        | (RIGID if rigid else {"friction": 0.6})
        | {
            "zone_shear_modulus": 30e9 * contrast,
            "zone_thickness": thickness,
            "height": height,
            "velocity": 1e-6,
            "zeta": ratio * 0.01,
        }
    )
    del fault["b"]
    critical = 2.0 * math.pi / float(critical_length(**fault))
    k = critical * np.geomspace(1e-3, 100.0, 4001)
    grows = spectrum(k, **fault)[0].real > 0.0
    assert not grows[k > critical * (1.0 + 1e-9)].any()
    near = spectrum(critical * np.array([1.0 - 1e-6, 1.0 + 1e-6]), **fault)[0].real
    assert near[0] > 0.0 > near[1]


@pytest.mark.parametrize("loading", ["edge", "remote"])
@pytest.mark.parametrize("height", [0.02, 0.4, math.inf])
def test_the_creeping_patch_with_a_zone_of_its_own_material(loading, height):
    fault = ROCK | RIGID | {"loading": loading}
    zone = {"zone_thickness": 0.01, "zone_shear_modulus": 30e9}
    found = stability_length(**fault, height=height, **zone)
    assert found == pytest.approx(stability_length(**fault, height=height + 0.01), rel=1e-5)


@pytest.mark.parametrize("modulus", [3e9, 90e9])
def test_the_creeping_patch_between_its_limits(modulus):
    """A thicker zone takes L_s from that of the body to that of the zone's material."""
    thickness = np.array([1e-6, 1e-3, 1e-2, 0.1, 1.0, 1000.0])
    found = stability_length(**ROCK, zone_thickness=thickness, zone_shear_modulus=modulus)
    ends = [stability_length(**ROCK | {"shear_modulus": mu}) for mu in (30e9, modulus)]
    assert found[[0, -1]] == pytest.approx(np.array(ends, dtype=float), rel=2e-3)
    steps = np.diff(found) * (ends[1] - ends[0])
    assert (steps > -1e-3 * found[0] * abs(ends[1] - ends[0])).all()


@pytest.mark.parametrize("loading", ["edge", "remote"])
@pytest.mark.parametrize("height", [0.05, math.inf])
@pytest.mark.parametrize("ratio", [-0.9, 0.1, 0.45])
def test_a_zone_that_vanishes_does_not_change_the_creeping_patch(ratio, height, loading):
    """Whatever its Poisson's ratio, which alone changed L_s by 3 %."""
    fault = ROCK | {"friction": 0.6, "height": height, "loading": loading}
    zone = {"zone_thickness": 1e-12, "zone_shear_modulus": 9e9, "zone_poisson_ratio": ratio}
    assert stability_length(**fault, **zone) == pytest.approx(stability_length(**fault), rel=1e-8)


@pytest.mark.parametrize("loading", ["edge", "remote"])
def test_a_zone_without_end_is_a_half_space(loading):
    """Its patch had no finite equations."""
    zone = {"zone_thickness": math.inf, "zone_shear_modulus": 9e9, "zone_poisson_ratio": 0.4}
    own = ROCK | {"shear_modulus": 9e9, "poisson_ratio": 0.4, "loading": loading}
    found = stability_length(**ROCK | {"loading": loading}, height=0.3, **zone)
    assert found == pytest.approx(stability_length(**own), rel=1e-9)


@pytest.fixture
def slimmer_zones():
    """Calling it, zones of a tenth of the least thickness are resolved; it is undone in the end."""
    with pytest.MonkeyPatch.context() as patch:

        def resolve():
            own = response._resolved

            def resolved(*given):
                with pytest.MonkeyPatch.context() as finer:
                    finer.setattr(response, "SLIMMEST", 10.0 * response.SLIMMEST)
                    return own(*given)

            patch.setattr(response, "REACHES", (*response.REACHES, 10.0 * response.SLIMMEST))
            patch.setattr(response, "_resolved", resolved)
            stability_point.cache_clear()

        yield resolve
    for cache in (stability_point, response._tables, response._bessel):
        cache.cache_clear()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("loading", "height", "ratio", "thickness", "modulus"),
    [
        ("edge", 0.01, 0.45, 1e-4, 1e9),
        ("edge", math.inf, 0.25, 1e-4, 1e9),
        ("edge", math.inf, 0.1, 1e-3, 90e9),
        ("remote", 0.01, 0.1, 1e-5, 10e9),
        ("remote", 0.1, 0.45, 1e-4, 30e9),
    ],
)
def test_the_range_of_a_slim_zone_has_the_length_of_a_resolved_one(
    slimmer_zones, loading, height, ratio, thickness, modulus
):
    """Its range was 1e-5 wide, and the length up to 9 % from the resolved one."""
    zone = {"zone_thickness": thickness, "zone_shear_modulus": modulus, "zone_poisson_ratio": ratio}
    fault = Fault(**ROCK, friction=0.6, height=height, loading=loading, **zone)
    answer = fault.lengths("none")["stability_length"]
    slimmer_zones()
    resolved = float(fault.stability_length())
    assert answer.low < resolved < answer.high
    assert abs(resolved / answer.value - 1.0) > 1e-4, "this zone is not slim"


def test_a_zone_is_whole():
    for given_alone in ({"zone_thickness": 0.1}, {"zone_shear_modulus": 1e9}):
        with pytest.raises(ParameterError, match="is missing: a zone has a thickness"):
            Fault(**ROCK, **given_alone)
    fault = Fault(
        **ROCK, velocity=1e-6, friction=0.6, height=1.0, zone_thickness=0.1, zone_shear_modulus=1e9
    )
    with pytest.raises(ParameterError, match="zone_thickness is not allowed: no simulation has"):
        fault.simulate()


def test_a_compliant_zone_in_the_benchmark():
    """BP1 with mu/4: the tanh of docs/conventions.md, solved for k by bisection."""
    mu, weak = 32.038e9, 32.038e9 / 4.0
    bp1 = ROCK | {"shear_modulus": mu, "slip_distance": 0.008, "plane": "antiplane"}
    critical = 0.005 * 50e6 / 0.008
    for thickness in (50.0, 200.0, 500.0):
        low, high = 1e-6, 1.0
        for _ in range(80):
            k = math.sqrt(low * high)
            t = math.tanh(k * thickness)
            stiffness = 0.5 * weak * k * (mu + weak * t) / (weak + mu * t)
            low, high = (k, high) if stiffness < critical else (low, k)
        zone = {"zone_thickness": thickness, "zone_shear_modulus": weak}
        assert critical_length(**bp1, **zone) == pytest.approx(2.0 * math.pi / k, rel=1e-9)
