"""Nothing is lost: faults, each at a random moment that a seed fixes.

A third of them; in CI each once (CI=true make test), and longer in make torture.
"""

import os

import pytest
from every import FAULTS
from harness import make_reference
from registry import CLEAR_ERROR, RECOVERED, disturb

SEED = os.environ.get("FAULT_SEED", "1")
LONG = {
    "flipped_entry_elsewhere", "truncated_entry_elsewhere", "clock_set_back_during_the_run",
    "closed_terminal", "sigkill_batch", "sigkill_snakemake_of_a_batch",
}  # fmt: skip
"""Left to make torture; workflow/test_stores.py damages a store, test_batches.py kills a batch."""
EACH = [name for name in FAULTS if name not in LONG]
TESTED = EACH if "CI" in os.environ else EACH[::3]


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    return make_reference(tmp_path_factory.mktemp("faults"))


@pytest.mark.parametrize("name", TESTED)
def test_fault(name, reference, tmp_path):
    assert disturb(name, reference, tmp_path / name, f"{SEED} {name}") in (RECOVERED, CLEAR_ERROR)


def test_there_are_many_faults_of_all_kinds():
    assert set(FAULTS) >= LONG and len(EACH) >= 25
    assert len({FAULTS[name][0] for name in EACH}) >= 10
