"""The law of the drop by theory alone, against the simulated drops and the law of quiet runs."""

import numpy as np
import pandas as pd
import pytest
from configurations import CONFIG

from nucleation.configuration.load import load
from nucleation.patch.delay import growth
from nucleation.patch.theory_history import theory_history

RUNS = {run.id: run for run in load(CONFIG / "config.yaml").runs}
TABLE = pd.read_csv(CONFIG.parent / "results" / "reference" / "drop.csv")
TABLE = TABLE[(TABLE.strength > 0.0) & TABLE.id.isin(list(RUNS))]
KIND = ["evolution", "height", "kind", "strength", "correlation_length"]


def drops(table):
    """The law's drop for each kind of run, with means of the simulated and the quiet run's."""
    histories, rows = {}, []
    for _, same in table.groupby(KIND):
        run, first = RUNS[same.id.iloc[0]], same.iloc[0]
        fault = first.evolution, first.height
        if fault not in histories:
            histories[fault] = theory_history(run.parameters, run.theory_length)
        declared = run.parameters.perturbation
        drop = growth(histories[fault], declared).drop(declared.strength)
        rows.append(
            (same.length.mean(), same.predicted_length.mean(), drop.length, drop.high - drop.low,
             (same.predicted_high - same.predicted_low).mean())
        )  # fmt: skip
    return np.array(rows).T


def test_one_fault_under_each_kind():
    """Normal load, state and drive, 1e-5: sixteen seeds each, two of the drive."""
    known = TABLE[(TABLE.evolution == "aging") & (TABLE.height == 0.02) & (TABLE.strength == 1e-5)]
    simulated, quiet, found, width, quiet_width = drops(known)
    assert simulated.size == 3
    assert found == pytest.approx(simulated, rel=0.01)
    assert found == pytest.approx(quiet, rel=0.01)
    assert width == pytest.approx(quiet_width, rel=0.03)


@pytest.mark.slow
def test_all_kinds_heights_and_laws():
    weak = TABLE[TABLE.strength < 2e-4]
    simulated, quiet, found, _, _ = drops(weak)
    off, before = (100.0 * (x / simulated - 1.0) for x in (found, quiet))
    assert np.sqrt(np.mean(off**2)) < 0.8 and np.abs(off).max() < 2.1
    assert np.sqrt(np.mean(off**2)) < np.sqrt(np.mean(before**2))


@pytest.mark.slow
def test_roughness_of_the_strength():
    """As the law of a quiet run has it."""
    rough = TABLE[TABLE.kind == "strength"]
    _, quiet, found, _, _ = drops(rough)
    assert found == pytest.approx(quiet, rel=0.015)
