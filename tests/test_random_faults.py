"""Random faults over the declared ranges: each question has an answer, or says why it has none."""

import math
import warnings
from collections import Counter

import numpy as np
import pytest
from asked import (
    critical_length,
    expected_drop,
    stability_length,
)

from nucleation.api import Fault, NoLength, ParameterError, Run
from nucleation.model.own_fault import own_law
from nucleation.theory.creep import slow_slip
from nucleation.theory.creep.lengths import LONGEST, stability_length_of
from nucleation.theory.creep.patches import Patches
from nucleation.theory.pair import LayerPair

SEED, NUMBER, QUICK = 34, 200, 12
LONGEST_SPECIMEN = 1e7  # m
MOST = Counter(wavenumbers=2_500_000, patches=150, steps=25_000)
"""Largest cost of the answers about a fault: wavenumbers of the bodies' stiffness, creeping patches
that are solved, and steps of slow slip; about two seconds where all are needed."""


@pytest.fixture
def cost(monkeypatch):
    """How much is computed, by the names of MOST."""
    counted = Counter()

    def count(owner, name, kind, amount):
        function = getattr(owner, name)

        def counting(*args, **options):
            counted[kind] += amount(*args)
            return function(*args, **options)

        monkeypatch.setattr(owner, name, counting)

    count(LayerPair, "transfer_functions", "wavenumbers", lambda _, k: np.size(k))
    count(Patches, "creep", "patches", lambda *_: 1)
    count(slow_slip, "_step", "steps", lambda *_: 1)
    return counted


def log_uniform(random, low, high):
    return float(np.exp(random.uniform(np.log(low), np.log(high))))


def random_fault(number):
    """A fault of the theory, and the loading of its patch."""
    random = np.random.default_rng([SEED, number])
    fault = {
        "shear_modulus": log_uniform(random, 1e7, 1e12),
        "poisson_ratio": random.uniform(-0.2, 0.49),
        "normal_stress": log_uniform(random, 1e3, 1e9),
        "a": log_uniform(random, 1e-4, 0.05),
        "slip_distance": log_uniform(random, 1e-8, 0.1),
        "friction": random.uniform(0.15, 0.9),
        "velocity": log_uniform(random, 1e-12, 1e-2),
        "plane": str(random.choice(["strain", "stress", "antiplane"])),
    }
    fault["zeta"] = fault["a"] * log_uniform(random, 0.01, 1000.0)
    if fault["a"] + fault["zeta"] > 1.0:
        fault["zeta"] = 1.0 - fault["a"]
    elastic = fault["shear_modulus"] * fault["slip_distance"]
    elastic /= fault["zeta"] * fault["normal_stress"]
    height = elastic * log_uniform(random, 1e-4, 1e2)
    fault["height"] = math.inf if random.random() < 0.2 else height
    body = random.choice(["same", "rigid", "other"])
    if body == "rigid":
        fault["second_shear_modulus"] = math.inf
    if body == "other":
        fault["second_shear_modulus"] = fault["shear_modulus"] * log_uniform(random, 0.03, 30.0)
        fault["second_poisson_ratio"] = random.uniform(0.0, 0.49)
        fault["second_height"] = fault["height"] * log_uniform(random, 0.1, 10.0)
    return fault, str(random.choice(["edge", "remote"]))


def quick(numbers):
    return [n if n < QUICK else pytest.param(n, marks=pytest.mark.slow) for n in numbers]


@pytest.mark.parametrize("number", quick(range(NUMBER)))
def test_theory_answers(cost, number):
    fault, loading = random_fault(number)
    with warnings.catch_warnings(), np.errstate(all="raise"):
        warnings.simplefilter("error", RuntimeWarning)
        warnings.simplefilter("ignore", UserWarning)
        own = Fault(**fault, loading=loading)
        critical, stable = float(own.critical_length()), float(own.stability_length())
        assert float(own.critical_mode().length) == pytest.approx(critical, nan_ok=True)
        assert math.isnan(stable) or 0.05 * critical < stable < 1.2 * LONGEST * critical
        found = own.lengths("none")
        assert found["critical_length"].value == pytest.approx(critical, nan_ok=True)
        assert found["stability_length"].value == pytest.approx(stable, nan_ok=True)
        for answer in found.values():
            assert answer.exists == (answer.status == "value") == (answer.reason == "")
        assert found["homogeneous_sliding"].value > 0.0
        if critical < LONGEST_SPECIMEN:
            ends = np.array(own.specimen("slip_distance", critical).intervals).ravel()
            assert np.isclose(ends, fault["slip_distance"], rtol=1e-5).any() or not ends.size
    assert cost <= MOST


def run_of(fault, law, evolution):
    """The same fault in blocks, and the full law with its constants."""
    kept = {name: value for name, value in fault.items() if not name.endswith("far_side")}
    base = own_law(fault["velocity"], fault["slip_distance"], evolution, law)
    blocks = Fault(**kept, far_side="free", evolution=evolution, friction_law=base)
    length = 6.0 * float(critical_length(**fault))
    return Run(blocks, block_length=length, perturbation="normal_load", strength=1e-5)


@pytest.mark.parametrize("number", quick(range(NUMBER)))
def test_the_drop_answers(cost, number):
    """With the law's L_s, which is that of constant a and b where v0 is far below V."""
    fault, _ = random_fault(number)
    law = ("dieterich_ruina", "product")[number % 2]
    evolution = ("aging", "slip")[number // 2 % 2]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        critical = float(critical_length(**fault))
        if not (math.isfinite(critical) and math.isfinite(fault["height"])):
            return
        try:
            run = run_of(fault, law, evolution)
        except ParameterError as refused:
            assert any(word in str(refused) for word in ("friction law", "is not allowed"))
            return
        cost.clear()
        try:
            with np.errstate(all="raise"):
                found = expected_drop(run)
        except NoLength as none:
            assert str(none)
            return
    assert cost <= MOST
    assert found.stability_length == pytest.approx(
        stability_length_of(run.patches, critical), rel=1e-6, nan_ok=True
    )
    assert np.isfinite(found.law.length) or found.doubt
    if law == "dieterich_ruina" and math.isfinite(found.stability_length):
        constant = float(stability_length(**fault))
        # where slip changes the normal stress, the law's f counts, which changes along the patch
        coupled = fault["plane"] != "antiplane" and "second_shear_modulus" in fault
        expected = pytest.approx(constant, rel=2e-2 if coupled else 2e-3)
        assert found.stability_length == expected
