"""Antiplane shear: K = mu k tanh kH or mu k coth kH, half for two bodies alike, no coupling."""

import math

import numpy as np
import pytest
from asked import (
    critical_length,
    expected_drop,
    lengths_in_use,
    spectrum,
    stability_length,
    transfer_functions,
)
from scipy.optimize import brentq
from thin_limit import thin_limit

from benchmarks.assembled import assemble
from nucleation.api import Fault, Material, ParameterError, extract, simulate
from nucleation.fem.grid import Grid
from nucleation.fem.operator import Operator
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.start import body_of
from nucleation.theory.creep.lengths import stability_length_of

BP1 = {
    "shear_modulus": 32.04e9,
    "poisson_ratio": 0.25,
    "normal_stress": 50e6,
    "a": 0.010,
    "b": 0.015,
    "slip_distance": 8e-3,
    "plane": "antiplane",
}
"""The benchmark problem 1 of Erickson et al. (2020), at the depth where a is 0.010."""

PMMA = {
    "shear_modulus": 3.1e9,
    "poisson_ratio": 1.0 / 3.0,
    "normal_stress": 1e6,
    "a": 0.0068,
    "zeta": 0.016,
    "slip_distance": 5e-7,
    "plane": "antiplane",
}
RIGID = {"second_shear_modulus": math.inf}


def crossing(stiffness, fault):
    """2 pi/k where a stiffness (Pa/m) falls to friction's ``zeta sigma0/D``."""
    zeta = fault.get("zeta", fault.get("b", 0.0) - fault["a"])
    rate = zeta * fault["normal_stress"] / fault["slip_distance"]
    k = brentq(lambda k: stiffness(k) - rate, 1e-9, 1e6, xtol=1e-300, rtol=1e-14)
    return 2.0 * math.pi / k


def test_of_both_marginal_frequencies_the_positive_one_is_given():
    """Round-off chose between them where the bodies differ."""
    weakening = {"b": 0.01 * (1.0 + np.linspace(0.1, 30.0, 500))}
    fault = Fault(**BP1 | RIGID | weakening, friction=0.6, velocity=1e-6)
    assert (fault.critical_mode().angular_frequency > 0.0).all()


def test_lengths_of_the_benchmark():
    """Half-spaces: pi mu D/(zeta sigma0); layers of 200 m, free and held."""
    half = math.pi * 32.04e9 * 8e-3 / (0.005 * 50e6)
    assert critical_length(**BP1) == pytest.approx(half, rel=1e-12)
    assert half == pytest.approx(3221, abs=1)
    mu = BP1["shear_modulus"]
    free = crossing(lambda k: 0.5 * mu * k * np.tanh(200.0 * k), BP1)
    assert critical_length(**BP1, height=200.0) == pytest.approx(free, rel=1e-9)
    assert free == pytest.approx(1880, abs=2)
    held = {"far_side": "clamped"}
    deep = crossing(lambda k: 0.5 * mu * k / np.tanh(1e3 * k), BP1)
    assert critical_length(**BP1, **held, height=1e3) == pytest.approx(deep, rel=1e-9)
    assert np.isnan(critical_length(**BP1, **held, height=512.0))
    assert np.isfinite(critical_length(**BP1, **held, height=513.5))


def test_two_bodies_in_series():
    """Unlike bodies: 1/K is the sum of both; friction is not asked for, as nothing couples."""
    second = {"second_shear_modulus": 1e10, "second_height": 0.03}

    def stiffness(k):
        both = 3.1e9 * k * np.tanh(0.02 * k), 1e10 * k * np.tanh(0.03 * k)
        return 1.0 / (1.0 / both[0] + 1.0 / both[1])

    expected = crossing(stiffness, PMMA)
    assert critical_length(**PMMA, height=0.02, **second) == pytest.approx(expected, rel=1e-9)
    with_friction = critical_length(**PMMA, height=0.02, **second, friction=0.6)
    assert with_friction == pytest.approx(expected, rel=1e-9)


def test_rates_do_not_depend_on_what_does_not_matter():
    others = [
        spectrum(
            20.0, **{**PMMA, "poisson_ratio": nu}, **RIGID, friction=f, velocity=1e-5, height=1.0
        )
        for nu, f in ((0.0, 0.1), (0.45, 0.9))
    ]
    np.testing.assert_array_equal(*others)
    g1, g2 = transfer_functions(np.array([5.0, -5.0]), **PMMA, **RIGID, height=0.1, friction=0.6)
    np.testing.assert_allclose(g1, [np.tanh(0.5), -np.tanh(0.5)], rtol=1e-12)
    assert not np.any(g2)


def test_thin_patches_are_those_of_the_plane_problem():
    ratio = stability_length(**PMMA, **RIGID, height=1e-4) / critical_length(
        **PMMA, **RIGID, height=1e-4
    )
    limit = thin_limit(PMMA["zeta"] / PMMA["a"])[0]
    assert ratio == pytest.approx(limit, rel=5e-3)


def test_lengths_in_use_have_mu_for_the_plane_modulus():
    found = lengths_in_use(**BP1)
    nucleation_length = math.pi * 32.04e9 * 8e-3 / (0.005 * 50e6)
    assert float(found["homogeneous_sliding"]) == pytest.approx(nucleation_length)
    thin = lengths_in_use(**PMMA, **RIGID, height=1e-4)
    exact = float(critical_length(**PMMA, **RIGID, height=1e-4))
    assert float(thin["thin_limit"]) == pytest.approx(exact, rel=1e-3)
    two = lengths_in_use(**PMMA, second_shear_modulus=9.3e9)
    exact = float(critical_length(**PMMA, second_shear_modulus=9.3e9))
    assert float(two["homogeneous_sliding_two_materials"]) == pytest.approx(exact)


def test_rollers_are_refused():
    with pytest.raises(
        ParameterError, match="far_side = 'roller' is not allowed with plane = anti"
    ):
        Fault(**PMMA, far_side="roller")


def test_uniform_shear_has_the_energy_of_a_scalar_field():
    """Gradients along x and y cost ``mu/2`` times their squares, and do not couple to u_y."""
    grid = Grid(0.3, 0.2, 4, 3)
    stiffness, _ = assemble(grid, Material(2e9, 0.0, plane="antiplane"))
    x, y = (positions.ravel() for positions in np.meshgrid(grid.x, grid.y))
    moved = np.column_stack([3.0 * x + 2.0 * y, 0.0 * x]).ravel()
    assert moved @ stiffness @ moved == pytest.approx(2e9 * 13.0 * 0.06, rel=1e-12)
    assert not np.any((stiffness @ moved)[1::2])


def test_condensed_stiffness_converges_to_the_theory():
    """Second order in h, to mu k tanh kH; slip does not change the normal stress."""
    errors, k, height = [], 2.0 * np.pi / 0.4, 0.1
    for n in (20, 40, 80):
        parameters = PAPER_RUN.replaced(
            plane="antiplane",
            height=height,
            block_length=0.4,
            n_x=2 * n + 1,
            n_y=n,
            loading="remote",
            stress_rate=1.0,
        )
        body = body_of(parameters)
        tangential, normal = Operator(body, 0.0).tangent(np.arange(1, 2 * n + 2))
        slip = np.cos(k * body.grid.dx * np.arange(2 * n + 1))
        force = slip @ tangential @ slip / body.grid.dx / (slip @ slip)
        errors.append(force / (3.1e9 * k * np.tanh(k * height)) - 1.0)
        assert not np.any(normal)
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(orders, 2.0, atol=0.1)


RUN = PAPER_RUN.replaced(
    plane="antiplane",
    height=0.02,
    block_length=0.8,
    n_x=320,
    n_y=8,
    end_time=60.0,
    time_after_event=0.1,
    perturbation="normal_load",
    strength=1e-4,
)


@pytest.mark.slow
def test_a_patch_nucleates_where_the_law_of_the_drop_says():
    critical = RUN.critical_length
    found = expected_drop(RUN)
    assert found.stability_length == stability_length_of(RUN.patches, critical)
    measured = float(extract(simulate(RUN))["length"])
    assert measured == pytest.approx(found.law.length, rel=0.04)
    assert 0.6 * critical < measured < 0.7 * critical
