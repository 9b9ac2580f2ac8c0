"""Numbers of the measured pages against the tables in results/reference."""

import re

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from docs.prose import says, span, table
from docs.samples import DOCS

from nucleation.lengths.in_use import LENGTHS
from nucleation.lengths.weakening_patch import DYNAMIC, ROOM, simulated
from replication.tables.weakening_patches import patch_outcomes_table


def line(*cells):
    return f"| {' | '.join(map(str, cells))} |"


# ---- docs/verification.md

REFINED = {"n_x": 800, "n_y": 32, "longest_step": 0.02, "tolerance": 2.5e-3}  # and the finest
KINDS = ("normal_load", "drive_velocity", "state", "strength")
PERTURBED = ["evolution", "initial_state", "height", "strength", "seed"]
ONSET, LENGTH = 3e-3, 5e-3  # what refinement may move onset and length by, or one element


def sequences(kind):
    """The runs of some kind, and their sequences of refinement with what is refined in each."""
    found = table("convergence")
    own = found[found["kind"] == kind]
    found = []
    for refined in REFINED:
        runs = own[own["refinement"] == refined]
        others = [name for name in REFINED if name != refined]
        found += [(refined, rows) for _, rows in runs.groupby(PERTURBED + others, dropna=False)]
    return own, found


def worst(runs):
    """The largest differences of some runs from their finest ones, and how many are too large."""
    if not runs:
        return ""
    apart = pd.DataFrame(runs)[[f"{n}_difference" for n in ("onset", "length", "elements")]]
    apart = apart.astype(float).abs()
    near = (apart["length_difference"] <= LENGTH) | (apart["elements_difference"] <= 1.0)
    missed = int((~(near & (apart["onset_difference"] <= ONSET))).sum())
    onset, length, _ = 100.0 * apart.max()
    missing = {0: "", 1: " (1 misses)"}.get(missed, f" ({missed} miss)")
    return f"{onset:.2f} / {length:.2f}{missing}"


def kind_rows():
    """One row for each kind: the worst of all faults, and how many of them miss the goal."""
    for kind in KINDS:
        own, found = sequences(kind)
        coarse = [rows.iloc[0] for refined, rows in found if refined == "n_x" and len(rows) > 2]
        # the run that is like the declared one: next to the finest along x
        along_x = [rows.iloc[-2] for refined, rows in found if refined == "n_x"]
        others = [rows.iloc[0] for refined, rows in found if refined != "n_x"]
        assert own.groupby(PERTURBED, dropna=False).ngroups == 12
        changes = map(worst, (coarse, along_x, others))
        yield line(f"`{kind}`", digit(own["strength"].iloc[0]), *changes)


def floor_rows():
    """One row for each mesh of the quiet runs: L/L_c at the drop, and the noise, by the steps."""
    found = table("drop").query("kind == 'none' and evolution == 'aging' and height == 0.02")
    found = found[found["role"] != "drop"]
    found = found.sort_values("longest_step", kind="stable")
    ratio = found["length"] / found["critical_length"]
    shown = pd.DataFrame(
        {
            "step": found["longest_step"].map("{:g}".format),
            "ratio": ratio.map("{:.3f}".format),
            "noise": found["floor_normal_load"].map(digit),
        }
    )
    for (n_x, n_y), rows in shown.groupby([found["n_x"], found["n_y"]]):
        yield line(f"{n_x} x {n_y}", *rows.agg(", ".join))


def digit(value):
    """A strength with one digit, 3e-5."""
    return "" if np.isnan(value) else f"{value:.0e}".replace("e-0", "e-")


# ---- docs/creeping_patch.md


def test_the_measured_stability_length():
    """Its range, what finer runs and the paper's mesh change, and where the force drops."""
    both = table("patch_stability")
    declared = both[both["study"] == "converged"]["stability_ratio"]
    changes = both[both["study"] == "paper"]["stability_change"].abs().max()
    finer = table("patch_convergence")["stability_change"].abs().max()
    says(
        "creeping_patch.md",
        f"**$L_s$ is {span(declared)} of $L_c$**",
        f"tolerances change $L_s$ by {100 * finer:.1f} % or less, and the paper's mesh by "
        f"{100 * changes:.1f} % or less",
    )


# ---- docs/drop.md, loadings.md and creeping_patch.md


def test_the_law_of_the_drop_reaches_as_far_as_it_is_said_to():
    found = table("drop").dropna(subset=["law_length"])
    found["ratio"] = found["law_length"] / found["length"]
    names = ["evolution", "height", "kind", "correlation_length", "strength"]
    means = found.groupby(names)["ratio"].mean().reset_index()
    weak = means[means["strength"] < 2e-4]["ratio"] - 1.0
    assert len(weak) >= 27 and weak.abs().max() < 0.021
    rms = 100.0 * np.sqrt(np.mean(weak**2))
    says("drop.md", f"({len(weak)} of them; {rms:.1f} % rms)")
    strong = means[np.isclose(means["strength"], 1e-3)]
    others = strong[(strong["kind"] != "normal_load") & (strong["correlation_length"] < 0.021)]
    smooth = others[~((others["kind"] == "strength") & (others["correlation_length"] > 0.015))]
    assert (smooth["ratio"] - 1.0).abs().max() < 0.015


def literature(name, *ratios, late=True):
    """Rows of the reference of one length and some a/b, at the largest slip rate or at all."""
    found = table("literature").dropna(subset=["difference"])
    found = found[(found["name"] == name) & found["a_over_b"].round(3).isin(ratios)]
    return found[np.isclose(found["read_at"], 1e3)] if late else found


def test_lengths_of_the_literature():
    """The sentences of docs/loadings.md below the figure."""
    fixed, ratios = "rubin_ampuero_localised", (0.1, 0.2, 0.3, 0.35)
    assert literature(fixed, *ratios)["difference"].between(0.0, 0.02).all()
    assert 0.14 < literature(fixed, *ratios, late=False)["difference"].max() < 0.15
    assert literature("thin_layer", 0.1, 0.3)["difference"].between(-0.0185, -0.015).all()
    (crack,) = (x for x in LENGTHS if x.key == "rubin_ampuero_crack")
    for a_over_b, percent in ((0.4, 5), (0.45, 17)):
        (difference,) = literature(fixed, a_over_b)["difference"]
        assert round(100 * difference) == percent
        assert re.search(rf"{percent} % for (a/b = )?{a_over_b}", crack.beyond)
    short = literature("rubin_ampuero_crack", 0.55)
    assert short["difference"].round(2).isin([0.08, 0.09]).all()
    for column, expected in (("width_at_half", 0.82), ("width_at_hundredth", 1.19)):
        ratio = (short[column] / short["formula_length"]).iloc[0]
        assert ratio == pytest.approx(expected, abs=5e-3)
    expanding = literature("rubin_ampuero_crack", 0.7, 0.9)
    away = expanding["far_state_ratio"] > 5.0
    assert expanding[~away]["difference"].abs().max() < 0.03
    (from_above,) = expanding[away].to_dict("records")
    assert from_above["far_state_ratio"] == pytest.approx(13.0, abs=1.0)
    assert from_above["difference"] + 1.0 == pytest.approx(0.78, abs=5e-3)
    for a_over_b, low, high in ((0.3, 3.7, 3.8), (0.7, 3.35, 3.95)):
        rows = literature("state_evolution", a_over_b, late=False)
        rows = rows[rows["n_x"] == rows["n_x"].max()]
        factor = (1.0 + rows["difference"]) * np.log(rows["read_at"] / rows["far_slip_rate"])
        assert factor.between(low, high + 0.005).all()


EXPLAINED = {
    "patch_theory-aging-H0.01-phi1-zeta_over_a0.5": "Weak weakening",
    "patch_theory-slip-H0.03-phi1-zeta_over_a10": "Steady creep",
    "pairs_weak-aging-H2-phi1-seed0-zeta_over_a1": "Blocks as high as long",
    "pairs_contrast-aging-H1-phi1-shear_modulus5167000000-seed0-"
    "second_shear_modulus3100000000-zeta_over_a1": "The stiffer body above",
}
"""Faults whose L_s is more than 3 % off, and the part of the page that says why."""


def patch_theory_errors():
    found = table("patch_theory").dropna(subset=["stability_length"])
    for name in ("front", "creep"):
        found[name] = 100.0 * (found[f"{name}_length"] / found["stability_length"] - 1.0)
    return found


def extent(values):
    """The least and the greatest of some numbers, to two digits after the point at most."""
    low, high = (f"{round(value, 2):g}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def patch_outcome_rows():
    """One row for each zeta/a: where slow slip ends and events begin, over the surroundings."""
    outcomes = pd.DataFrame(simulated())
    for varies in ("zeta", "a"):
        words = {"zeta": "another $b$", "a": "another $a$"}[varies]
        for ratio, rows in outcomes[outcomes["varies"] == varies].groupby("zeta_over_a"):
            names = ("strengthening", "slow_slip_up_to", "events_from")
            yield line(words, f"{ratio:g}", *(extent(rows[name]) for name in names))


def test_weakening_patches_creep_below_their_critical_width():
    found = table("weakening_patches")
    unstable = found["width_ratio"] > 1.0
    assert not unstable.all()
    assert set(found["outcome"][~unstable]) == {"creep"}
    assert "creep" not in set(found["outcome"][unstable])
    assert {"strain", "antiplane"} == set(found["plane"])
    says("creeping_patch.md", f"{len(found)} patches in the study `weakening_patches`")


def test_outcomes_in_the_library_are_those_of_the_reference():
    """The file that the library reads is made from the table of simulated patches."""
    frame = table("weakening_patches")
    made = patch_outcomes_table(xr.Dataset({name: ("run", frame[name]) for name in frame}))
    stated = pd.DataFrame(simulated())
    assert len(stated) == made.sizes["run"] >= 20
    for name in stated.columns[1:]:
        assert made[name].values == pytest.approx(stated[name].to_numpy(), rel=1e-6)
    assert list(made["varies"].values) == list(stated["varies"])
    assert frame["elements"].min() >= 3.0
    assert (frame["height"] / frame["width"]).min() >= ROOM
    dynamic = [frame["dynamic_rate"].min(), frame["dynamic_rate"].max()]
    assert dynamic == pytest.approx(DYNAMIC, rel=5e-3)


def test_limits_of_the_simulated_patches_are_stated():
    """Widths that one slip rate alone was simulated at, and the speed of events."""
    found = table("weakening_patches").round({"zeta_over_a": 3, "strengthening": 2})
    one_rate = 0
    for row in pd.DataFrame(simulated()).itertuples():
        same = found[(found["varies"] == row.varies) & (found["outcome"] == "event")]
        same = same[np.isclose(same["zeta_over_a"], row.zeta_over_a)]
        same = same[np.isclose(same["strengthening"], row.strengthening, atol=6e-3)]
        here = same[np.isclose(same["width_ratio"], row.events_from, rtol=2e-3)]
        assert 5e-11 in set(here["velocity"])
        one_rate += here["velocity"].nunique() == 1
    events = found[found["outcome"] == "event"]
    peaks = (events["fastest"] / events["dynamic_rate"]).sort_values(ascending=False)
    raised = (found["width_ratio"] / found["period_ratio"]).max()
    says(
        "creeping_patch.md",
        f"Of the {len(simulated())} widths from which events are stated, {one_rate} were simulated",
        f"So the {(found['outcome'] == 'undecided').sum()} patches that reach half the rate",
        f"Peaks of events are {peaks.iloc[-1]:.1f} to {peaks.iloc[0]:.0f} $v_d$",
        f"The period raises $W_c$ by {100 * (raised - 1):.1f} % at most",
    )


def test_theory_of_the_patch_is_met_within_three_percent_or_it_is_said_why():
    found = patch_theory_errors()
    page = (DOCS / "creeping_patch.md").read_text(encoding="utf-8")
    assert set(found["id"][found["front"].abs() > 3.0]) == EXPLAINED.keys()
    assert all(f"**{part}" in page for part in EXPLAINED.values())
    squares = np.sqrt((found[["front", "creep"]] ** 2).mean())
    largest = found[["front", "creep"]].abs().max()
    says(
        "creeping_patch.md",
        f"Against {len(found)} simulated faults",
        f"an error of {squares['front']:.1f} % (rms)",
        f"{largest['front']:.1f} % at worst",
        f"it is {squares['creep']:.1f} %, {largest['creep']:.1f} % at worst",
    )


TABLES = {"verification": (kind_rows, floor_rows), "creeping_patch": (patch_outcome_rows,)}


@pytest.mark.parametrize("page", TABLES)
def test_tables_are_those_of_the_reference(page):
    text = (DOCS / f"{page}.md").read_text(encoding="utf-8")
    for rows in TABLES[page]:
        stated = list(rows())
        assert len(stated) >= 3
        assert "|---|\n" + "\n".join(stated) + "\n\n" in text, rows.__name__
