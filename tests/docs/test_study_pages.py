"""docs/convergence.md and docs/sensitivity.md against the tables in results/reference.

Their rows, to copy: ``PYTHONPATH=src python tests/test_study_pages.py``.
"""

import csv
import itertools
import math
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
REFERENCE = ROOT / "results" / "reference"
REFINED = ("n_x", "n_y", "longest_step", "tolerance")


def table(name):
    with open(REFERENCE / f"{name}.csv", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def signed(text, unit, digits):
    """A change in print, empty if there is none; no sign for what rounds to zero."""
    value = float(text or "nan") * unit
    rounded = round(value, digits)
    return "" if math.isnan(value) else f"{rounded + 0.0:+.{digits}f}" if rounded else "0"


def same(row):
    """What the rows of one sequence have in common."""
    return row["refinement"], [row[n] for n in ("height", *REFINED) if n != row["refinement"]]


def convergence_rows():
    """One row for each sequence of refinement: its lengths, and the last changes."""
    for (refined, _), group in itertools.groupby(table("convergence"), key=same):
        rows = list(group)
        last = rows[-1]
        order = float(last["observed_order"] or "nan")
        cells = (
            f"`{refined}`",
            f"{float(last['height']):g}",
            "" if refined == "n_x" else last["n_x"],
            "" if refined == "longest_step" else last["longest_step"],
            ", ".join(f"{float(row[refined]):g}" for row in rows),
            ", ".join(f"{float(row['length_over_theory']):.3f}" for row in rows),
            ", ".join(f"{float(row['onset_time_high']):.2f}" for row in rows),
            signed(last["length_change"], 100.0, 2),
            signed(last["drop_time_change"], 1.0, 4),
            "" if math.isnan(order) else f"{order:.1f}",
        )
        yield f"| {' | '.join(cells)} |"


def sensitivity_rows():
    """One row for each variation: changes of L_c and of L_c over the theory's, by height."""
    rows = table("sensitivity")
    heights = sorted({row["height"] for row in rows}, key=float)
    for variation in dict.fromkeys(row["variation"] for row in rows):
        if variation == "base":
            continue
        cells = [f"`{variation}`"]
        for height in heights:
            found = [r for r in rows if (r["variation"], r["height"]) == (variation, height)]
            for name in ("length_change", "ratio_change", "onset_change"):
                cells.append(signed(found[0][name], 100.0, 1) if found else "")
        yield f"| {' | '.join(cells)} |"


PAGES = {"convergence": convergence_rows, "sensitivity": sensitivity_rows}


@pytest.mark.parametrize("name", PAGES)
def test_page_states_the_reference(name):
    lines = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8").splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("|---"))
    stated = itertools.takewhile(lambda line: line.startswith("|"), lines[start + 1 :])
    assert list(stated) == list(PAGES[name]())


def test_last_refinement_of_the_finest_runs_moves_the_length_by_less_than_one_percent():
    """At the steps of the study `converged`, at half of them for H = 0.005 m."""
    seen = set()
    for (refined, _), group in itertools.groupby(table("convergence"), key=same):
        last = list(group)[-1]
        step = "0.01" if float(last["height"]) == 0.005 else "0.02"
        if refined == "n_x" and last["longest_step"] == step:
            assert abs(float(last["length_change"])) < 0.01, last["id"]
            seen.add(float(last["height"]))
    assert seen == {0.005, 0.02, 0.1}


if __name__ == "__main__":
    for rows in PAGES.values():
        print("\n".join(rows()), end="\n\n")
