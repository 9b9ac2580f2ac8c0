"""The committed reference set and the documents against what the code gives today."""

import csv
import re
from pathlib import Path

import numpy as np
import pytest
from configurations import papers
from reference_evidence import table as reference_table

from nucleation.extraction.extraction import extract
from nucleation.simulation.run import simulate
from replication.tables.lengths import over_realisations

ROOT = Path(__file__).parents[1]
REFERENCE = ROOT / "results" / "reference"
SETTINGS = papers()
RUNS = {run.id: run for run in SETTINGS.runs if SETTINGS.studies[run.study].table == "lengths"}


def table(name):
    with open(REFERENCE / name, encoding="utf-8") as stream:
        return {row["id"]: row for row in csv.DictReader(stream)}


LENGTHS = table("lengths.csv")
for own, row in table("measures.csv").items():
    LENGTHS[own] |= row


def test_reference_has_the_runs_of_the_configuration():
    assert set(LENGTHS) == set(RUNS)
    for identifier, run in RUNS.items():
        assert float(LENGTHS[identifier]["critical_length"]) == pytest.approx(
            run.critical_length, rel=1e-9
        )
        assert LENGTHS[identifier]["status"].startswith("completed")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "tolerance"),
    [("converged-aging-H0.02-phi1-seed1", 1e-3), ("paper-aging-H0.005-phi1", 2e-3)],
)
def test_fresh_simulation_gives_the_reference(name, tolerance):
    """Perturbed, the drop is one number on all machines; else round-off grows in the event."""
    parameters = RUNS[name].run.replaced(time_after_event=0.0)
    measured = extract(simulate(parameters))
    for column, value in measured.items():
        assert value == pytest.approx(float(LENGTHS[name][column]), rel=tolerance), column


def means():
    """The reference's lengths by fault, each the mean of its realisations."""
    faults = over_realisations(reference_table("lengths.csv"))
    rows = faults.to_dataframe().to_dict("records")
    return {re.sub(r"-seed\d+$", "", row["id"]): row for row in rows}


def results():
    return (ROOT / "docs" / "results.md").read_text(encoding="utf-8")


def cells(row):
    """The cells of a table's row, without its label."""
    return [cell.strip() for cell in row.strip("| ").split("|")][1:]


def test_results_state_the_reference():
    """Every number of the table of both series in docs/results.md is that of the reference set."""
    faults = means()
    table = results().partition("## The paper's set, twice")[2].partition("\n\n![")[0]
    heights, _, *series = [line for line in table.splitlines() if line.startswith("|")]
    aging = {name for name in faults if re.search(r"-aging-.*-phi1$", name)}
    stated = {}
    for study, row in zip(("paper", "converged"), series, strict=True):
        for height, ratio in zip(cells(heights), cells(row), strict=True):
            stated[f"{study}-aging-H{height}-phi1"] = ratio
    assert stated.keys() == aging
    for name, ratio in stated.items():
        row = faults[name]
        assert ratio == f"{float(row['length']) / float(row['critical_length']):.2f}", name


@pytest.mark.parametrize("study", ["paper", "converged"])
def test_variations_of_law_and_state_are_as_stated(study):
    """Slip law and initial_state = 1e3 s within 10 % of the aging law's length (Sect. 5)."""
    length = {name: float(row["length"]) for name, row in means().items()}
    pairs = [
        ("slip-H0.01-phi1", "aging-H0.01-phi1"),
        ("slip-H0.05-phi1", "aging-H0.05-phi1"),
        ("aging-H0.1-phi1000", "aging-H0.1-phi1"),
    ]
    changes = [
        100 * (length[f"{study}-{one}"] / length[f"{study}-{other}"] - 1) for one, other in pairs
    ]
    assert np.abs(changes).max() < 10.0
    which = {"paper": "the paper's mesh", "converged": "declared"}[study]
    one_line = " ".join(results().split())
    stated = re.search(rf"([-+0-9.]+), ([-+0-9.]+) and ([-+0-9.]+) % (?:on )?{which}", one_line)
    assert [f"{change:+.1f}" for change in changes] == list(stated.groups())
