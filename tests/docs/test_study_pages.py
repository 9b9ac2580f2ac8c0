"""docs/convergence.md and docs/sensitivity.md against the tables in results/reference.

Their rows, to copy: ``PYTHONPATH=src python tests/docs/test_study_pages.py``.
"""

import csv
import itertools
import math
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
REFERENCE = ROOT / "results" / "reference"
REFINED = ("n_x", "n_y", "longest_step", "tolerance")
KINDS = ("normal_load", "drive_velocity", "state", "strength")
MESH = ("height", "n_x", "n_y", "longest_step")
ONSET, LENGTH = 3e-3, 5e-3  # what refinement may move onset and length by, or one element


def table(name):
    with open(REFERENCE / f"{name}.csv", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def signed(text, unit, digits):
    """A change in print, empty if there is none; no sign for what rounds to zero."""
    value = float(text or "nan") * unit
    rounded = round(value, digits)
    return "" if math.isnan(value) else f"{rounded + 0.0:+.{digits}f}" if rounded else "0"


def number(row, name):
    return float(row[name] or "nan")


def fault(row):
    """What the sequences of one perturbed run have in common."""
    return tuple(row[name] for name in ("kind", "evolution", "phi0", "height", "strength", "seed"))


def sequences(kinds):
    """The sequences of refinement of runs of some kinds, by fault and by what is refined."""
    found = {}
    for row in table("convergence"):
        if row["kind"] in kinds:
            others = tuple(row[name] for name in REFINED if name != row["refinement"])
            found.setdefault((fault(row), row["refinement"], others), []).append(row)
    return found


def apart(row):
    """How far a run is from the finest of its sequence, in print: onset, length."""
    onset, length = (abs(100.0 * number(row, f"{n}_difference")) for n in ("onset", "length"))
    return f"{onset:.2f} / {length:.2f}" + ("" if meets(row) else " !")


def meets(row):
    """Whether a run is as near to the finest of its sequence as it is asked to be."""
    near = abs(number(row, "length_difference")) <= LENGTH
    near |= abs(number(row, "elements_difference")) <= 1.0
    return near and abs(number(row, "onset_difference")) <= ONSET


def judged(rows, refined):
    """The run of a sequence that is like the declared one: next to the finest along x."""
    return rows[-2] if refined == "n_x" else rows[0]


def kind_rows():
    """One row for each kind: the worst of all faults, and how many of them miss the goal."""
    for kind in KINDS:
        found = [(own, refined, rows) for (own, refined, _), rows in sequences([kind]).items()]
        cells = [f"`{kind}`", strength(found[0][0][4]), str(len({own for own, *_ in found}))]
        along_x = [rows for _, refined, rows in found if refined == "n_x"]
        cells += [_worst([rows[0] for rows in along_x if len(rows) > 2])]
        for name in REFINED:
            cells += [_worst([judged(rows, name) for _, refined, rows in found if refined == name])]
        yield f"| {' | '.join(cells)} |"


def _worst(runs):
    """The largest differences of some runs from their finest ones, and how many are too large."""
    if not runs:
        return ""
    onset, length = (
        max(abs(100.0 * number(row, f"{n}_difference")) for row in runs)
        for n in ("onset", "length")
    )
    missed = sum(not meets(row) for row in runs)
    return f"{onset:.2f} / {length:.2f}" + (f" ({missed} !)" if missed else "")


def floor_rows():
    """One row for each mesh, step and height of a quiet run: where it drops, and its noise."""
    rows = [
        row
        for row in table("floors")
        if row["evolution"] == "aging" and number(row, "height") > 0.01
    ]
    for row in sorted(rows, key=lambda row: [number(row, name) for name in MESH]):
        ratio = number(row, "length") / number(row, "theory_length")
        cells = (
            f"{number(row, 'height'):g}",
            f"{row['n_x']} x {row['n_y']}",
            f"{number(row, 'longest_step'):g}",
            f"{number(row, 'onset_time'):.2f}",
            f"{ratio:.3f}",
            *(strength(number(row, f"floor_{kind}")) for kind in ("normal_load", "state")),
        )
        yield f"| {' | '.join(cells)} |"


def strength(value):
    """A strength with one digit, 3e-5."""
    value = float(value)
    return "" if math.isnan(value) else f"{value:.0e}".replace("e-0", "e-")


def sensitivity_rows():
    """One row for each variation that changes anything: L_c, L_c over the theory's, by height."""
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
        if set(cells[1:]) != {"0"}:
            yield f"| {' | '.join(cells)} |"


PAGES = {
    ("convergence", 0): kind_rows,
    ("convergence", 1): floor_rows,
    ("sensitivity", 0): sensitivity_rows,
}
"""The tables of each page, by their order."""


@pytest.mark.parametrize(("name", "order"), PAGES)
def test_page_states_the_reference(name, order):
    lines = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8").splitlines()
    starts = [i for i, line in enumerate(lines) if line.startswith("|---")]
    stated = itertools.takewhile(lambda line: line.startswith("|"), lines[starts[order] + 1 :])
    assert list(stated) == list(PAGES[name, order]())


def test_all_declared_runs_are_refined_in_every_way():
    faults = {}
    for (own, refined, _), rows in sequences(["normal_load"]).items():
        faults.setdefault(own, set()).add(refined)
        finest = {"n_x": 800, "n_y": 32, "longest_step": 0.02, "tolerance": 2.5e-3}[refined]
        assert float(rows[-1][refined]) == finest
    assert len(faults) == 12
    assert all(refined == set(REFINED) for refined in faults.values())


if __name__ == "__main__":
    for rows in PAGES.values():
        print("\n".join(rows()), end="\n\n")
