"""Faults that share their ratios share one problem, which is solved once and without units."""

import math

import numpy as np
import pytest
import xarray as xr
from asked import ROCK

from nucleation.answers import drop
from nucleation.api import Fault, Friction
from nucleation.theory import weakening_patch
from nucleation.theory.creep import lengths, runaway
from nucleation.theory.creep.patches import Patches
from nucleation.theory.evaluation import single_system

STRESSES = np.linspace(10e6, 100e6, 200)
LAYERS = {"height": 0.1, "second_height": 0.3, "second_shear_modulus": 12e9, "friction": 0.6}


def with_units(unit_of_length, unit_of_stress, of_friction=1.0, **own):
    """ROCK, or layers, in other units of length, of elastic stress, and of a and b."""
    given = ROCK | own
    factors = {
        "shear_modulus": unit_of_stress,
        "second_shear_modulus": unit_of_stress,
        "normal_stress": unit_of_stress / of_friction,
        "slip_distance": unit_of_length,
        "height": unit_of_length,
        "second_height": unit_of_length,
        "a": of_friction,
        "b": of_friction,
    }
    return Fault(**{name: value * factors.get(name, 1.0) for name, value in given.items()})


@pytest.fixture
def solved(monkeypatch):
    """How often each problem's solver was called, by its name."""
    calls = []
    solvers = [
        (lengths, "stability_point"),
        (runaway, "runaway_point"),
        (weakening_patch, "smallest_width"),
    ]
    for module, name in solvers:
        own = getattr(module, name)

        def counted(*given, own=own, name=name):
            calls.append(name)
            return own(*given)

        monkeypatch.setattr(module, name, counted)
    runaway._of_constants.cache_clear()
    runaway.runaway_of.cache_clear()
    return calls


@pytest.mark.parametrize("bodies", [{}, LAYERS], ids=["half-spaces", "layers"])
def test_faults_that_differ_by_units_alone_are_solved_once(solved, bodies):
    units = np.linspace(0.1, 7.3, 500)
    found = with_units(units, units[::-1], 1.0 + 0.1 * units, **bodies).stability_length()
    assert solved == ["stability_point"]
    one = with_units(1.0, 1.0, **bodies).stability_length()
    np.testing.assert_allclose(found, units * one, rtol=1e-12)


def test_each_other_ratio_is_solved_by_itself(solved):
    found = Fault(**{**ROCK, "b": 0.01 + np.repeat([0.002, 0.005, 0.02], 5)}).stability_length()
    assert len(solved) == 3 and np.unique(found).size == 3


@pytest.mark.parametrize("bodies", [{}, LAYERS], ids=["half-spaces", "layers"])
@pytest.mark.parametrize("loading", ["edge", "remote"])
def test_the_shared_problem_has_the_length_of_the_fault_itself(bodies, loading):
    fault = Fault(**ROCK | bodies, loading=loading)
    patches = Patches(single_system(fault), loading=loading)
    length, _ = lengths.stability_point(patches, float(fault.critical_length()))
    assert fault.stability_length() == pytest.approx(length, rel=1e-9)


def test_a_fault_in_an_array_has_its_own_answer():
    """No answer depends on which fault of an array was the first."""
    zeta = np.linspace(0.002, 0.02, 7)
    rock = {name: value for name, value in ROCK.items() if name != "b"}
    together = Fault(**rock | LAYERS, zeta=zeta).stability_length()
    alone = [Fault(**rock | LAYERS, zeta=of).stability_length() for of in zeta]
    assert together.tolist() == [float(length) for length in alone]


def test_without_a_change_of_normal_stress_friction_does_not_matter(solved):
    Fault(**ROCK, friction=np.linspace(0.0, 0.9, 20)).stability_length()
    assert len(solved) == 1
    Fault(**ROCK | LAYERS | {"friction": np.array([0.3, 0.6])}).stability_length()
    assert len(solved) == 3


@pytest.mark.slow
def test_last_bits_do_not_change_the_runaway_length(solved):
    """Slow slip is chaotic: they changed it by a hundredth."""
    moduli = 30e9 * (1.0 + 2.0**-52 * np.arange(6))
    rock = ROCK | {"b": 0.025, "height": 0.02, "shear_modulus": moduli}
    found = Fault(**rock).runaway_length()
    assert solved.count("runaway_point") == 1
    np.testing.assert_allclose(found, found[0], rtol=1e-12)


def test_the_smallest_patch_that_nucleates_is_searched_once(solved):
    zeta = xr.DataArray([-0.005, -0.01], dims="zeta")
    stress = xr.DataArray(STRESSES, dims="stress")
    fault = Fault(**ROCK | {"normal_stress": stress})
    found = fault.weakening_patch_length(zeta)
    assert len(solved) == 2
    scaled = (found * stress).transpose("stress", "zeta").values
    np.testing.assert_allclose(scaled, scaled[[0]].repeat(STRESSES.size, axis=0), rtol=1e-12)


@pytest.fixture
def drops(monkeypatch):
    """How often L was computed under a perturbation."""
    calls, own = [], drop._Known.under
    monkeypatch.setattr(drop._Known, "under", lambda *given: calls.append(1) or own(*given))
    return calls


WITH_LAW = ROCK | {"height": 0.02, "b": 0.04, "friction": 0.6, "velocity": 1e-6}


def test_lengths_of_many_faults_are_those_of_one(drops):
    """With the words: they name lengths in metres."""
    stresses = np.linspace(20e6, 50e6, 25)
    heights = 0.02 * 50e6 / stresses
    many = Fault(**WITH_LAW | {"normal_stress": stresses, "height": heights}).lengths()
    assert len(drops) == 1
    one = Fault(**WITH_LAW).lengths()
    for key, answer in many.items():
        for field, own in zip(answer, one[key], strict=True):
            of_last = np.ravel(field)[-1]
            if isinstance(own, str):
                assert of_last == own, key
            else:
                np.testing.assert_allclose(of_last, own, rtol=1e-9)
    basis = many["drop_length"].basis
    assert "with other noise it is" in basis[0] and basis[0] != basis[-1]
    value = many["drop_length"].value
    np.testing.assert_allclose(value * stresses, value[0] * stresses[0], rtol=1e-12)


def test_a_law_of_its_own_scales_with_velocity_and_slip_distance(drops):
    speeds = np.geomspace(1e-9, 1e-3, 7)
    found = Fault(**WITH_LAW | {"velocity": speeds}).lengths()["drop_length"].value
    assert len(drops) == 1 and np.unique(found).size == 1


def test_a_given_law_has_scales_that_do_not_follow(drops):
    law = Friction(law="dieterich_ruina", slip_distance=5e-6)
    speeds = np.array([1e-6, 1e-5, 1e-5])
    given = WITH_LAW | {"velocity": speeds, "friction_law": law}
    found = Fault(**given).lengths()["drop_length"].value
    assert len(drops) == 2 and found[0] != found[1] == found[2]


@pytest.mark.parametrize("kind", ["strength", "state"])
def test_roughness_has_a_length_in_metres(drops, kind):
    distances = WITH_LAW["slip_distance"] * np.array([1.0, 2.0])
    given = WITH_LAW | {"slip_distance": distances, "height": WITH_LAW["height"] * np.array([1, 2])}
    found = Fault(**given).lengths(kind, correlation_length=0.01)["drop_length"].value
    assert len(drops) == 2
    assert not math.isclose(found[1], 2.0 * found[0], rel_tol=1e-6)
