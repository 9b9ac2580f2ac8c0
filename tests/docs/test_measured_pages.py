"""Numbers of the measured pages against the tables in results/reference.

Their rows, to copy: ``PYTHONPATH=src:tests python tests/docs/test_measured_pages.py``.
"""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from asked import critical_length, lengths_in_use
from docs.prose import says, span
from docs.samples import DOCS, ROOT

from nucleation.lengths.finite_patch import loaded_patch_factor
from nucleation.lengths.formulas import FINITE_PATCH
from nucleation.lengths.in_use import LENGTHS
from nucleation.lengths.patch_outcomes import DYNAMIC, ROOM, simulated
from replication.tables.ratios import pairs_over_realisations
from replication.tables.weakening_patches import patch_outcomes_table


def reference(name):
    return pd.read_csv(ROOT / "results" / "reference" / f"{name}.csv")


def line(*cells):
    return f"| {' | '.join(map(str, cells))} |"


# ---- docs/verification.md

REFINED = {"n_x": 800, "n_y": 32, "longest_step": 0.02, "tolerance": 2.5e-3}  # and the finest
KINDS = ("normal_load", "drive_velocity", "state", "strength")
PERTURBED = ["evolution", "initial_state", "height", "strength", "seed"]
ONSET, LENGTH = 3e-3, 5e-3  # what refinement may move onset and length by, or one element


def sequences(kind):
    """The runs of some kind, and their sequences of refinement with what is refined in each."""
    table = reference("convergence")
    own = table[table["kind"] == kind]
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
    table = reference("drop").query("kind == 'none' and evolution == 'aging' and height == 0.02")
    table = table[table["role"] != "drop"]
    table = table.sort_values("longest_step", kind="stable")
    ratio = table["length"] / table["critical_length"]
    shown = pd.DataFrame(
        {
            "step": table["longest_step"].map("{:g}".format),
            "ratio": ratio.map("{:.3f}".format),
            "noise": table["floor_normal_load"].map(digit),
        }
    )
    for (n_x, n_y), rows in shown.groupby([table["n_x"], table["n_y"]]):
        yield line(f"{n_x} x {n_y}", *rows.agg(", ".join))


def digit(value):
    """A strength with one digit, 3e-5."""
    return "" if np.isnan(value) else f"{value:.0e}".replace("e-0", "e-")


def test_all_declared_runs_are_refined_in_every_way():
    own, found = sequences("normal_load")
    assert all(rows.iloc[-1][refined] == REFINED[refined] for refined, rows in found)
    ways = own.groupby(PERTURBED, dropna=False)["refinement"].agg(set)
    assert len(ways) == 12 and all(names == set(REFINED) for names in ways)


# ---- docs/creeping_patch.md


def test_the_measured_stability_length():
    """Its range, what finer runs and the paper's mesh change, and where the force drops."""
    both = reference("patch_stability")
    declared = both[both["study"] == "converged"]["stability_ratio"]
    changes = both[both["study"] == "paper"]["stability_change"].abs().max()
    finer = reference("patch_convergence")["stability_change"].abs().max()
    says(
        "creeping_patch.md",
        f"**$L_s$ is {span(declared)} of $L_c$**",
        f"tolerances change $L_s$ by {100 * finer:.1f} % or less, and the paper's mesh by "
        f"{100 * changes:.1f} % or less",
    )


# ---- docs/drop.md, loadings.md and creeping_patch.md


def test_the_law_of_the_drop_reaches_as_far_as_it_is_said_to():
    table = reference("drop").dropna(subset=["law_length"])
    table["ratio"] = table["law_length"] / table["length"]
    names = ["evolution", "height", "kind", "correlation_length", "strength"]
    means = table.groupby(names)["ratio"].mean().reset_index()
    weak = means[means["strength"] < 2e-4]["ratio"] - 1.0
    assert len(weak) >= 27 and weak.abs().max() < 0.021
    rms = 100.0 * np.sqrt(np.mean(weak**2))
    says("drop.md", f"({len(weak)} of them; {rms:.1f} % rms)")
    strong = means[np.isclose(means["strength"], 1e-3)]
    others = strong[(strong["kind"] != "normal_load") & (strong["correlation_length"] < 0.021)]
    smooth = others[~((others["kind"] == "strength") & (others["correlation_length"] > 0.015))]
    assert (smooth["ratio"] - 1.0).abs().max() < 0.015


LITERATURE_ROWS = {
    "fixed": "rubin_ampuero_localised",
    "fixed, beyond its limit": "rubin_ampuero_localised",
    "thin layer": "thin_layer",
    "expanding": "rubin_ampuero_crack",
    "slip law, over $L_b$": "state_evolution",
}


def literature(length, ratio, late=True):
    """Rows of the reference of one length and a/b, at the largest slip rate or at all."""
    table = reference("literature").dropna(subset=["difference"])
    same = (table["name"] == LITERATURE_ROWS[length]) & np.isclose(table["a_over_b"], ratio)
    return table[same & (np.isclose(table["read_at"], 1e3) if late else True)]


def test_numbers_about_the_literature_s_lengths_are_those_of_the_reference():
    """The sentences of docs/loadings.md below the table."""
    fixed = pd.concat([literature("fixed", ratio) for ratio in (0.1, 0.2, 0.3, 0.35)])
    assert fixed["difference"].between(0.0, 0.02).all()
    early = pd.concat([literature("fixed", ratio, late=False) for ratio in (0.1, 0.2, 0.3, 0.35)])
    assert 0.14 < early["difference"].max() < 0.15
    thin = pd.concat([literature("thin layer", ratio) for ratio in (0.1, 0.3)])
    assert thin["difference"].between(-0.0185, -0.015).all()
    layer = ANY | {"poisson_ratio": 1 / 3, "shear_modulus": 3.1e9, "slip_distance": 5e-7}
    layer |= {"b": 0.029, "height": 0.005}  # b - a = 0.02
    own = critical_length(**layer, second_shear_modulus=np.inf, friction=0.4)
    assert lengths_in_use(**layer)["thin_limit"] / own - 1.0 == pytest.approx(0.02, abs=5e-3)
    for_55 = literature("expanding", 0.55)
    assert for_55["difference"].round(2).isin([0.08, 0.09]).all()
    for column, expected in (("width_at_half", 0.82), ("width_at_hundredth", 1.19)):
        assert (for_55[column] / for_55["formula_length"]).iloc[0] == pytest.approx(
            expected, abs=5e-3
        )
    for_7, for_9 = literature("expanding", 0.7), literature("expanding", 0.9)
    away = for_7["far_state_ratio"] > 5.0
    steady = pd.concat([for_7[~away], for_9])
    assert steady["difference"].abs().max() < 0.03
    apart = 1.0 - steady["finite_speed_length"] / steady["formula_length"]
    assert apart.iloc[:-1].between(0.015, 0.025).all() and apart.iloc[-1] == pytest.approx(
        0.08, abs=5e-3
    )
    (from_above,) = for_7[away].to_dict("records")
    assert from_above["far_state_ratio"] == pytest.approx(13.0, abs=1.0)
    assert from_above["difference"] + 1.0 == pytest.approx(0.78, abs=5e-3)
    ratio = from_above["simulated_length"] / from_above["finite_speed_length"]
    assert ratio == pytest.approx(1.17, abs=5e-3)
    for a_over_b, percent in ((0.4, 5), (0.45, 17)):
        (difference,) = literature("fixed, beyond its limit", a_over_b)["difference"]
        words = f"{percent} % for {'a/b = ' if a_over_b == 0.4 else ''}{a_over_b:g}"
        assert round(100 * difference) == percent
        (crack,) = (x for x in LENGTHS if x.key == "rubin_ampuero_crack")
        assert words in crack.beyond
    for a_over_b, low, high in ((0.3, 3.7, 3.8), (0.7, 3.35, 3.95)):
        rows = literature("slip law, over $L_b$", a_over_b, late=False)
        rows = rows[rows["n_x"] == rows["n_x"].max()]
        factor = (1.0 + rows["difference"]) * np.log(rows["read_at"] / rows["far_slip_rate"])
        assert factor.between(low, high + 0.005).all()


ANY = {
    "shear_modulus": 3e10,
    "poisson_ratio": 0.25,
    "normal_stress": 1e6,
    "slip_distance": 1e-6,
    "a": 0.009,
    "b": 0.02,
}


STUDIES = {
    r"`map`, all heights, $\zeta/a$ = 1.5 to 6": ["map"],
    r"`converged`, both laws, $\phi_0$ = 1 and 1000 s": ["converged"],
    "identical pairs, far sides, held layers": ["pairs_identical", "pairs_far_sides",
                                                "pairs_layers", "pairs_weak"],
    "`figure_2_simulated`, both senses": ["figure_2_simulated"],
    "`patch_theory`, below": ["patch_theory"],
}  # fmt: skip
EXPLAINED = {
    "patch_theory-aging-H0.01-phi1-zeta_over_a0.5": "Weak weakening",
    "patch_theory-slip-H0.03-phi1-zeta_over_a10": "Steady creep",
    "pairs_weak-aging-H2-phi1-seed0-zeta_over_a1": "Blocks as high as long",
    "figure_2_simulated-aging-H1-phi1-shear_modulus5167000000-seed0-"
    "second_shear_modulus3100000000-zeta_over_a1": "The stiffer body above",
}
"""Faults whose L_s is more than 3 % off, and the part of the page that says why."""


def patch_theory_errors():
    table = reference("patch_theory").dropna(subset=["stability_length"])
    for name in ("front", "creep"):
        table[name] = 100.0 * (table[f"{name}_length"] / table["stability_length"] - 1.0)
    return table


def patch_theory_rows():
    """One row for each group of studies: errors of both theories."""
    table = patch_theory_errors()
    for words, studies in STUDIES.items():
        rows = table[table["study"].isin(studies)]
        errors = [rows[name] for name in ("front", "creep")]
        cells = [f"{np.sqrt(np.mean(e**2)):.1f} %, {e[e.abs().idxmax()]:+.1f} %" for e in errors]
        yield line(words, len(rows), *cells)


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
    table = reference("weakening_patches")
    unstable = table["width_ratio"] > 1.0
    assert not unstable.all()
    assert set(table["outcome"][~unstable]) == {"creep"}
    assert "creep" not in set(table["outcome"][unstable])
    assert {"strain", "antiplane"} == set(table["plane"])
    says("creeping_patch.md", f"{len(table)} patches in the study `weakening_patches`")


def test_outcomes_in_the_library_are_those_of_the_reference():
    """The file that the library reads is made from the table of simulated patches."""
    frame = reference("weakening_patches")
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
    """Widths that one slip rate alone was simulated at, and peaks that no mesh resolves."""
    table = reference("weakening_patches").round({"zeta_over_a": 3, "strengthening": 2})
    one_rate = 0
    for row in pd.DataFrame(simulated()).itertuples():
        same = table[(table["varies"] == row.varies) & (table["outcome"] == "event")]
        same = same[np.isclose(same["zeta_over_a"], row.zeta_over_a)]
        same = same[np.isclose(same["strengthening"], row.strengthening, atol=6e-3)]
        here = same[np.isclose(same["width_ratio"], row.events_from, rtol=2e-3)]
        assert 5e-11 in set(here["velocity"])
        one_rate += here["velocity"].nunique() == 1
    events = table[table["outcome"] == "event"]
    peaks = (events["fastest"] / events["dynamic_rate"]).sort_values(ascending=False)
    assert peaks.iloc[0] > 3e4 and peaks.iloc[1] > 4e3
    says(
        "creeping_patch.md",
        f"Of the {len(simulated())} second widths {one_rate} were simulated at one $V$ only",
        f"{peaks.iloc[2]:.0f} $v_d$",
        f"all others are {peaks.iloc[-1]:.1f} to {peaks.iloc[3]:.0f} $v_d$",
    )


def test_theory_of_the_patch_is_met_within_three_percent_or_it_is_said_why():
    page = (DOCS / "creeping_patch.md").read_text(encoding="utf-8")
    table = patch_theory_errors()
    assert set(table["id"][table["front"].abs() > 3.0]) == EXPLAINED.keys()
    assert all(f"**{part}" in page for part in EXPLAINED.values())


# ---- docs/results.md


def faults():
    """The pairs of the reference, each the mean of its realisations, on the usual mesh."""
    frame = reference("pairs")
    table = pairs_over_realisations(xr.Dataset({n: ("run", frame[n].to_numpy()) for n in frame}))
    rows = table.to_dataframe()
    return rows[rows["n_x"] < 1600]


def test_identical_blocks():
    """The range of their lengths over the theory's."""
    own = faults().query("study == 'pairs_identical'").sort_values("height")
    lower, high = own["length_ratio"].iloc[:-1], own["length_ratio"].iloc[-1]
    assert own["height"].iloc[-2:].tolist() == [0.2, 0.5]
    says(
        "results.md",
        f"$L_s/L_c$ is {span(own['stability_ratio'])} for all heights. $L/L_c$ is {span(lower)} up "
        f"to $H = 0.2$ m, and {high:.2f} for 0.5 m.",
    )


def contrasts(weakening):
    """The pairs of Figure 2 with one zeta/a, by f beta."""
    own = faults().query("study == 'figure_2_simulated'")
    own = own[np.isclose(own["zeta_over_a"], weakening)]
    return own.assign(f_beta=own["f_beta"].round(2)).set_index("f_beta").sort_index()


def over_half_spaces(weakening):
    """Their lengths over L_c^M."""
    own = contrasts(weakening)
    return own.filter(like="_ratio").mul(own["half_space_ratio"], axis=0)


def test_lengths_of_both_senses_of_a_contrast():
    own = over_half_spaces(10)[["length_ratio", "stability_ratio"]]
    below, same, above = (own.loc[contrast].map("{:.2f}".format) for contrast in (0.38, 0.0, -0.38))
    says(
        "results.md",
        rf"For $\zeta/a = 10$, $L$ and $L_s$ are {same.iloc[0]} and {same.iloc[1]} between "
        f"identical bodies, grow to {below.iloc[0]} and {below.iloc[1]} with the stiffer body "
        rf"below ($f\beta = 0.38$), and fall to {above.iloc[0]} and {above.iloc[1]} with it above "
        r"($f\beta = -0.38$)",
    )


def test_strong_weakening_shortens_in_one_sense_and_lengthens_in_the_other():
    """Beyond the range of the realisations."""
    strong = over_half_spaces(10)
    assert strong.loc[-0.38, "length_ratio_high"] < strong.loc[0.0, "length_ratio_low"]
    for own in (strong, over_half_spaces(3)):
        assert own.loc[0.38, "length_ratio_low"] > own.loc[0.0, "length_ratio_high"]


def test_lengths_of_finite_patches_beside_simulated_ones_are_as_stated():
    same = faults()[np.isclose(faults()["f_beta"], 0.0)]
    high = {2.288: same[same["height"] == 0.5].iloc[0]}
    high |= {weakening: contrasts(weakening).loc[0.0] for weakening in (3.0, 10.0)}
    asperity, pinned = (
        [row["stability_ratio"] * np.pi / factor(weakening) for weakening, row in high.items()]
        for factor in (
            lambda weakening: FINITE_PATCH,
            lambda weakening: loaded_patch_factor(1.0 / (1.0 + weakening)),
        )
    )
    assert asperity == sorted(asperity, reverse=True) and pinned == sorted(pinned, reverse=True)
    says(
        "results.md",
        rf"$L_s$ is {asperity[-1]:.2f} ($\zeta/a = 10$) to {asperity[0]:.2f} ($\zeta/a = 2.3$) "
        f"times an asperity's length, and {pinned[-1]:.2f} to {pinned[0]:.2f} times a pinned "
        "patch's.",
    )


TABLES = {
    "verification": (kind_rows, floor_rows),
    "creeping_patch": (patch_theory_rows, patch_outcome_rows),
}


@pytest.mark.parametrize("page", TABLES)
def test_tables_are_those_of_the_reference(page):
    text = (DOCS / f"{page}.md").read_text(encoding="utf-8")
    for rows in TABLES[page]:
        stated = list(rows())
        assert len(stated) >= 3
        assert "|---|\n" + "\n".join(stated) + "\n\n" in text, rows.__name__


if __name__ == "__main__":
    for page in TABLES.values():
        for rows in page:
            print("\n".join(rows()), end="\n\n")
