"""Nothing is lost: each fault once, at a random moment that a seed fixes (longer: make torture)."""

import os

import pytest
from harness import make_reference
from registry import CLEAR_ERROR, FAULTS, RECOVERED, disturb

SEED = os.environ.get("FAULT_SEED", "1")


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    return make_reference(tmp_path_factory.mktemp("faults"))


@pytest.mark.parametrize("name", FAULTS)
def test_fault(name, reference, tmp_path):
    assert disturb(name, reference, tmp_path / name, f"{SEED} {name}") in (RECOVERED, CLEAR_ERROR)


def test_there_are_many_faults_of_all_kinds():
    assert len(FAULTS) >= 25
    assert len({kind for kind, _ in FAULTS.values()}) >= 10
