"""One row for each fault: its realisations beside the expected drop."""

import numpy as np
import xarray as xr
from asked import expected_drop

from nucleation.run.derived import ensemble
from nucleation.run.run import PAPER_RUN
from replication.tables.drops import EXPECTED, OTHER_FAULTS, gather_other_faults

FAULTS = [
    PAPER_RUN.replaced(perturbation="normal_load", strength=strength) for strength in (1e-4, 1e-5)
]
RUNS = [{"parameters": parameters.to_dict()} for parameters in FAULTS]


def drops(lengths):
    """The study's table: a list of lengths (m) for each fault."""
    digests = [ensemble(FAULTS[i]) for i, own in enumerate(lengths) for _ in own]
    count = len(digests)
    columns = {name: np.zeros(count) for name in OTHER_FAULTS if name not in EXPECTED}
    columns |= {"length": np.concatenate(lengths), "ensemble": np.array(digests)}
    columns["reached_length"] = np.nan_to_num(columns["length"], nan=0.9)
    columns |= {"zeta": np.full(count, 0.014), "a": np.full(count, 0.007)}
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


def test_each_fault_has_its_own_realisations():
    known = [expected_drop(parameters) for parameters in FAULTS]
    first = [known[0].low, known[0].high, 1.01 * known[0].high, 0.5]
    second = [1.001 * known[1].low, 0.999 * known[1].low]
    found = gather_other_faults(drops([first, second]), RUNS)
    assert found["realisations"].values.tolist() == [4, 2]
    assert found["inside"].values.tolist() == [2, 1]
    np.testing.assert_allclose(found["length"], [np.mean(first), np.mean(second)])
    np.testing.assert_allclose(found["expected_length"], [one.length for one in known])
    np.testing.assert_allclose(found["zeta_over_a"], 2.0)


def test_a_realisation_without_a_drop_is_outside():
    low, high = expected_drop(FAULTS[0]).low, expected_drop(FAULTS[0]).high
    found = gather_other_faults(drops([[0.5 * (low + high), np.nan]]), RUNS[:1])
    assert found["inside"].values.tolist() == [1]
    assert np.isnan(found["length"])
    assert found["reached_length"].values.tolist() == [0.9]
