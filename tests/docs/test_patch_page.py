"""Tables of docs/patch_stability.md against those in results/reference.

Their rows, to copy: ``PYTHONPATH=src python tests/docs/test_patch_page.py``.
"""

from pathlib import Path

import pandas as pd
import pytest

ROOT = Path(__file__).parents[2]
REFERENCE = ROOT / "results" / "reference"
FAULT = ["evolution", "height", "phi0"]


def percent(value, digits):
    return f"{100.0 * value:+.{digits}f} %"


def table(name):
    return pd.read_csv(REFERENCE / f"{name}.csv")


def value_rows():
    """L_s of each fault, what the paper's mesh changes, and what it is over the theory's length."""
    both = table("patch_stability").set_index(FAULT)
    paper, declared = (both[both["study"] == name] for name in ("paper", "converged"))
    for fault, row in paper.iterrows():
        fine = declared.loc[fault]
        cells = (
            *(fault[0], f"{fault[1]:g}", f"{fault[2]:g}", f"{fine['stability_length']:.4f}"),
            percent(row["stability_length"] / fine["stability_length"] - 1.0, 1).removesuffix(" %"),
            *(f"{fine['stability_ratio']:.3f}", f"{fine['stability_frequency']:.1f}"),
        )
        yield f"| {' | '.join(cells)} |"


def error_rows():
    """What refinement of the declared run, and the paper's mesh, change of L_s."""
    refined = table("patch_convergence")
    refined = refined[refined["study"] == "patch_convergence"]
    paper = table("patch_stability").query(
        "study == 'paper' and evolution == 'aging' and phi0 == 1"
    )
    base = table("patch_convergence").query("study == 'converged'").iloc[0]
    for height, rows in refined.groupby("height"):
        found = [
            rows[rows["n_x"] > base["n_x"]],
            rows[rows["n_y"] > base["n_y"]],
            rows[rows["tolerance"] < base["tolerance"]],
            paper[paper["height"] == height],
        ]
        changes = [own["stability_change"].iloc[0] for own in found]
        digits = (2, 2, 2, 1)
        cells = [f"{height:g}", *(percent(x, n) for x, n in zip(changes, digits, strict=True))]
        yield f"| {' | '.join(cells)} |"


TABLES = (value_rows, error_rows)


@pytest.mark.parametrize("rows", TABLES)
def test_page_states_the_reference(rows):
    page = (ROOT / "docs" / "patch_stability.md").read_text(encoding="utf-8")
    stated = list(rows())
    assert len(stated) >= 3
    assert "|---|\n" + "\n".join(stated) + "\n\n" in page


def test_frozen_patches_grow_as_twins_do():
    twins = table("twin_runs")
    apart = twins["twin_growth"] - twins["frozen_growth"]
    assert apart.min() > 0.05 and apart.max() < 0.25
    assert (twins["twin_frequency"] / twins["frozen_frequency"] - 1.0).abs().max() < 0.02


if __name__ == "__main__":
    for rows in TABLES:
        print("\n".join(rows()), end="\n\n")
