"""Nothing is lost: faults, each at a random moment that a seed fixes.

A third of them, none of the slowest; in CI each once (CI=true make test), and as many as wanted in
make torture.
"""

import os
import random

import damage
import kills
import pytest
from harness import FAULTS, disturb, make_reference

MODULES = (kills, damage)
"""Importing one enters its faults into the registry."""

SEED = os.environ.get("FAULT_SEED", "1")
COUNT = int(os.environ.get("FAULT_COUNT", "0"))  # make torture; FAULTS is set by any make
ONCE = list(FAULTS) if "CI" in os.environ else list(FAULTS)[1::3]
TESTED = random.Random(SEED).choices(list(FAULTS), k=COUNT) if COUNT else ONCE


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    return make_reference(tmp_path_factory.mktemp("faults"))


@pytest.mark.parametrize(("number", "name"), list(enumerate(TESTED)))
def test_fault(number, name, reference, tmp_path):
    disturb(name, reference, tmp_path / name, f"{SEED} {number} {name}")
