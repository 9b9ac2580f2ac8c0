"""L_run by theory: the thin limit by an independent route, and what it must not depend on."""

import dataclasses
import math

import numpy as np
import pytest
from asked import critical_length, runaway_length, stability_length
from scipy.integrate import solve_ivp

from nucleation.api import Friction, Geometry, Parameters
from nucleation.theory.creep import runaway
from nucleation.theory.creep.patches import Patches

THIN = {
    "shear_modulus": 3.1e9, "poisson_ratio": 1.0 / 3.0, "normal_stress": 1e6, "a": 0.0068,
    "slip_distance": 5e-7, "second_shear_modulus": math.inf, "height": 1e-5, "friction": 0.0,
}  # fmt: skip


def over_critical(ratio, **changed):
    fault = THIN | {"zeta": ratio * 0.0068} | changed
    return float(runaway_length(**fault)) / float(critical_length(**{
        k: v for k, v in fault.items() if k != "evolution"
    }))  # fmt: skip


def runs_away_by_differences(ratio, length, nodes=60, duration=1500.0):
    """The thin strip by central differences: ``a v'/v + b phi'/phi = c (v - v_c)''``, v_c linear.

    `length` over L_c; with b phi'/phi of the aging law. ``(zeta/a) lambda = 4 pi^2`` at L_c.
    """
    y = (np.arange(nodes) + 1.0) / (nodes + 1.0)
    steady = y
    strength = ratio / (4.0 * np.pi**2 * length**2)  # stiffness over a
    second = (nodes + 1.0) ** 2 * (
        np.diag(np.full(nodes - 1, 1.0), -1)
        - 2.0 * np.eye(nodes)
        + np.diag(np.full(nodes - 1, 1.0), 1)
    )

    def rates(_, logs):
        v, log_state = np.exp(logs[:nodes]), logs[nodes:]
        aging = np.exp(-log_state) - v
        accelerating = strength * (second @ (v - steady)) - (1.0 + ratio) * aging
        return np.concatenate([accelerating, aging])

    def event(_, logs):
        return logs[:nodes].max() - math.log(300.0)

    event.terminal = True
    start = np.concatenate([np.log(steady), -np.log(steady)])
    start[nodes:] += 0.05 * np.sin(np.pi * y)
    found = solve_ivp(rates, (0.0, duration), start, "LSODA", rtol=1e-5, atol=1e-6, events=event)
    return bool(found.t_events[0].size)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "length"), [(0.2, 1.49), (0.3, 1.28), (0.5, 1.045), (0.8, 0.873)]
)
def test_thin_limit_by_two_routes(ratio, length):
    """Chebyshev modes of a layer, and finite differences of the strip."""
    found = over_critical(ratio)
    assert found == pytest.approx(length, rel=0.015)
    assert not runs_away_by_differences(ratio, 0.975 * found)
    assert runs_away_by_differences(ratio, 1.025 * found)


def test_energy_balance_of_the_strip():
    """1.8 to 1.95 times (1/pi) sqrt(b/zeta), where fracture and strain energy balance."""
    for ratio in (0.3, 0.8):
        balance = math.sqrt((1.0 + ratio) / ratio) / math.pi
        assert 1.75 < over_critical(ratio) / balance < 1.98


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("PERTURBATION", 0.02),
        ("DURATION", 3000.0),
        ("FAST", 1000.0),
        ("RELATIVE_TOLERANCE", 1e-7),
        ("ABSOLUTE_TOLERANCE", 1e-8),
        ("MODES", 32),
        ("LONGEST", 2.3),
    ],
)
def test_it_does_not_depend_on_how_it_is_found(monkeypatch, name, value):
    before = over_critical(0.5)
    monkeypatch.setattr(runaway, name, value)
    assert over_critical(0.5) == pytest.approx(before, rel=runaway.ERROR)


@pytest.mark.slow
def test_any_pair():
    """Longer than L_s; earlier by the slip law; NaN where nothing nucleates."""
    pair = {"second_shear_modulus": None, "friction": None, "height": 0.02}
    assert over_critical(0.5, **pair) == pytest.approx(1.05, rel=0.03)
    assert over_critical(0.5, evolution="slip") < over_critical(0.5)
    fault = THIN | {"zeta": [-0.001, 0.0034]} | pair
    found = runaway_length(**fault)
    assert np.isnan(found[0])
    assert found[1] > 1.2 * stability_length(**fault)[1]


@pytest.mark.slow
@pytest.mark.parametrize("evolution", ["aging", "slip"])
def test_a_law_with_far_scales_has_constant_a_and_b(evolution):
    law = Friction(law="dieterich_ruina", evolution=evolution, regularisation_slip_rate=1e-14)
    friction = law.with_expansion(1e-5, 0.41, 0.0068, 0.0034)
    parameters = Parameters(friction=friction, geometry=Geometry(height=0.02, length=4.0))
    own = Patches.of(parameters)
    constant = dataclasses.replace(own, law=None)
    found = runaway.runaway_point(own, 1.0)
    assert found == pytest.approx(runaway.runaway_point(constant, 1.0), rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(("ratio", "disturbed"), [(0.2, 1.12), (0.5, 0.91)])
def test_weak_perturbations_give_one_length_and_strong_ones_a_shorter_one(
    monkeypatch, ratio, disturbed
):
    """The limit cycle of slow slip attracts weak perturbations of it, and not strong ones."""
    lengths = {}
    for perturbation in (0.01, 0.05, 0.2):
        monkeypatch.setattr(runaway, "PERTURBATION", perturbation)
        lengths[perturbation] = over_critical(ratio)
    assert lengths[0.01] == pytest.approx(lengths[0.05], rel=0.015)
    assert lengths[0.2] == pytest.approx(disturbed, rel=0.015)
