"""The law of the drop, which is of the theory's patches, against the simulated drops."""

import numpy as np
import pandas as pd
import pytest
from configurations import CONFIG, papers

from nucleation.drop.delay import growth
from nucleation.drop.mode_history import followed, mode_history

RUNS = {run.id: run for run in papers().runs}
TABLE = pd.read_csv(CONFIG.parent / "results" / "reference" / "drop.csv")
TABLE = TABLE[(TABLE.strength > 0.0) & TABLE.id.isin(list(RUNS))]
KIND = ["evolution", "height", "kind", "strength", "correlation_length"]


def drops(table):
    """The law's drop for each kind of run, with means of the simulated and the table's."""
    histories, rows = {}, []
    for _, same in table.groupby(KIND):
        run, first = RUNS[same.id.iloc[0]], same.iloc[0]
        fault = first.evolution, first.height
        if fault not in histories:
            histories[fault] = mode_history(
                run.run.patches, run.critical_length, run.run.fault.initial_state
            )
        declared = run.run.perturbation
        drop = growth(histories[fault], declared).drop(declared.strength)
        rows.append((same.length.mean(), same.law_length.mean(), drop.length))
    return np.array(rows).T


def test_one_fault_under_each_kind():
    """Normal load, state and drive, 1e-5: sixteen seeds each, six of the drive."""
    known = TABLE[(TABLE.evolution == "aging") & (TABLE.height == 0.02) & (TABLE.strength == 1e-5)]
    simulated, tabulated, found = drops(known[known.kind != "strength"])
    assert simulated.size == 3
    assert found == pytest.approx(simulated, rel=0.01)
    assert found == pytest.approx(tabulated, rel=1e-6)


@pytest.mark.slow
def test_all_kinds_heights_and_laws():
    simulated, tabulated, found = drops(TABLE[TABLE.strength < 2e-4])
    off = 100.0 * (found / simulated - 1.0)
    assert np.sqrt(np.mean(off**2)) < 0.8 and np.abs(off).max() < 2.1
    assert found == pytest.approx(tabulated, rel=1e-6)


def test_a_mode_is_followed_until_its_rate_jumps():
    """To another mode, or where it leaves its oscillation behind."""
    length = np.linspace(0.8, 1.2, 9)
    pair = 40.0 * (length - 1.0) + 1j * np.sqrt(np.maximum(100.0 - 4e3 * (length - 1.0) ** 2, 0.0))
    alone = np.where(pair.imag > 0.0, pair, np.nan)
    assert followed(length, alone, 1.01).tolist() == [1, 2, 3, 4, 5, 6]
    with_another = np.where(pair.imag > 0.0, pair, -4e4 + 300j)
    assert followed(length, with_another, 1.01).tolist() == [1, 2, 3, 4, 5, 6]
    assert followed(length, np.full(9, np.nan + 0j), 1.01).size == 0
