"""Numbers of docs/findings.md, drop.md and patch_theory.md against the tables in results/reference.

Their rows, to copy: ``PYTHONPATH=src python tests/docs/test_measured_pages.py``.
"""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from nucleation.patch.pairs import over_realisations
from nucleation.theory.finite_patch import loaded_patch_factor
from nucleation.theory.literature import FINITE_PATCH

ROOT = Path(__file__).parents[2]
REFERENCE = ROOT / "results" / "reference"
FINDINGS = (ROOT / "docs" / "findings.md").read_text(encoding="utf-8")
CONTRASTS = (-0.38, -0.2, 0.0, 0.2, 0.38)


def test_the_law_of_the_drop_reaches_as_far_as_it_is_said_to():
    table = pd.read_csv(REFERENCE / "drop.csv").dropna(subset=["predicted_length"])
    table["ratio"] = table["predicted_length"] / table["length"]
    names = ["evolution", "height", "kind", "correlation_length", "strength"]
    means = table.groupby(names)["ratio"].mean().reset_index()
    weak = means[means["strength"] < 2e-4]
    assert len(weak) >= 27 and (weak["ratio"] - 1.0).abs().max() < 0.025
    strong = means[np.isclose(means["strength"], 1e-3)]
    others = strong[(strong["kind"] != "normal_load") & (strong["correlation_length"] < 0.021)]
    smooth = others[~((others["kind"] == "strength") & (others["correlation_length"] > 0.015))]
    assert (smooth["ratio"] - 1.0).abs().max() < 0.028


LITERATURE_ROWS = {
    "fixed": "rubin_ampuero_localised", "thin layer": "thin_layer",
    "expanding": "rubin_ampuero_crack", "slip law, over L_b": "state_evolution",
}  # fmt: skip


def test_lengths_of_the_literature_are_those_of_the_reference():
    """Of each a/b the first run is in the table, and all of 0.3 are within what the text says."""
    table = pd.read_csv(REFERENCE / "literature.csv").dropna(subset=["difference"])
    page = (ROOT / "docs" / "loading.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([a-z][^|]+) \| (0\.\d+) \| ([\d. |]+) \|$", page, re.MULTILINE)
    assert len(rows) == 10
    for length, ratio, values in rows:
        same = table[(table["name"] == LITERATURE_ROWS[length])
                     & np.isclose(table["a_over_b"], float(ratio))]  # fmt: skip
        first = same[same["id"] == same["id"].iloc[0]]["difference"] + 1.0
        assert [f"{value:.2f}" for value in first] == values.split(" | "), (length, ratio)
    fixed = table[(table["name"] == "rubin_ampuero_localised") & np.isclose(table["a_over_b"], 0.3)]
    late = fixed[fixed["read_at"] > 0.05]["difference"]
    assert len(late) == 7 and late.min() > 0.005 and late.max() < 0.035


STUDIES = {
    "`map`, all heights, zeta/a = 1.5 to 6": ["map"],
    "`converged`, both laws, phi0 = 1 and 1000 s": ["converged"],
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
    table = pd.read_csv(REFERENCE / "patch_theory.csv").dropna(subset=["stability_length"])
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
        yield f"| {' | '.join([words, str(len(rows)), *cells])} |"


def test_theory_of_the_patch_is_met_within_three_percent_or_it_is_said_why():
    page = (ROOT / "docs" / "patch_theory.md").read_text(encoding="utf-8")
    rows = list(patch_theory_rows())
    assert "\n".join(rows) in page
    table = patch_theory_errors()
    assert set(table["id"][table["front"].abs() > 3.0]) == EXPLAINED.keys()
    assert all(f"**{part}" in page for part in EXPLAINED.values())


def faults():
    """The pairs of the reference, each the mean of its realisations, on the usual mesh."""
    frame = pd.read_csv(REFERENCE / "pairs.csv")
    table = over_realisations(xr.Dataset({n: ("run", frame[n].to_numpy()) for n in frame}))
    rows = table.to_dataframe()
    return rows[rows["n_x"] < 1600]


def identical_rows():
    """The table of identical blocks in docs/findings.md."""
    own = faults().query("study == 'pairs_identical'").sort_values("height")
    yield "| theory, free far sides (m) |" + "".join(f" {v:.4f} |" for v in own["theory_length"])
    yield "| L_s/L_c |" + "".join(f" {v:.2f} |" for v in own["stability_ratio"])
    yield "| L/L_c at the drop |" + "".join(f" {v:.2f} |" for v in own["length_ratio"])
    ends = zip(own["length_ratio_low"], own["length_ratio_high"], strict=True)
    yield "| least to most |" + "".join(f" {low:.2f}-{high:.2f} |" for low, high in ends)


def contrasts(weakening):
    """The pairs of Figure 2 with one zeta/a, by f beta."""
    own = faults().query("study == 'figure_2_simulated'")
    own = own[np.isclose(own["zeta_over_a"], weakening)]
    return own.assign(f_beta=own["f_beta"].round(2)).set_index("f_beta").sort_index()


def contrast_rows():
    """The table of both senses of a contrast in docs/findings.md, lengths over L_c^M."""
    for weakening in (10, 3, 1):
        own = contrasts(weakening)
        values = {
            name: (own[name] * own["half_space_ratio"]).reindex(CONTRASTS)
            for name in ("length_ratio", "length_ratio_low", "length_ratio_high", "stability_ratio")
        }
        ends = zip(values["length_ratio_low"], values["length_ratio_high"], strict=True)
        for words, cells in (
            (f"{weakening} | L", [f"{v:.2f}" for v in values["length_ratio"]]),
            (" | least to most", [f"{low:.2f}-{high:.2f}" for low, high in ends]),
            (" | L_s", [f"{v:.2f}" for v in values["stability_ratio"]]),
        ):
            shown = ["–" if "nan" in cell else cell for cell in cells]
            yield re.sub(r"  +", " ", f"| {words} | {' | '.join(shown)} |")


@pytest.mark.parametrize("rows", [identical_rows, contrast_rows])
def test_tables_of_pairs_are_those_of_the_reference(rows):
    assert "\n".join(rows()) in FINDINGS


def test_strong_weakening_shortens_in_one_sense_and_lengthens_in_the_other():
    """Beyond the range of the realisations."""
    own = contrasts(10)
    own = own[["length_ratio", "length_ratio_low", "length_ratio_high"]].mul(
        own["half_space_ratio"], axis=0
    )
    assert own.loc[-0.38, "length_ratio_high"] < own.loc[0.0, "length_ratio_low"]
    for weakening in (3, 10):
        rows = contrasts(weakening)
        unit = rows["half_space_ratio"]
        least = (rows["length_ratio_low"] * unit).loc[0.38]
        assert least > (rows["length_ratio_high"] * unit).loc[0.0]


def test_lengths_of_finite_patches_beside_simulated_ones_are_as_stated():
    same = faults()[np.isclose(faults()["f_beta"], 0.0)]
    high = {2.288: same[same["height"] == 0.5].iloc[0]}
    high |= {weakening: contrasts(weakening).loc[0.0] for weakening in (3.0, 10.0)}
    said = {2.288: (1.44, 1.39), 3.0: (1.35, 1.32), 10.0: (1.25, 1.24)}
    for weakening, row in high.items():
        factors = FINITE_PATCH, loaded_patch_factor(1.0 / (1.0 + weakening))
        found = [row["stability_ratio"] * np.pi / factor for factor in factors]
        assert found == pytest.approx(said[weakening], abs=0.0051)
        assert all(f"{value:.2f}" in FINDINGS for value in said[weakening])


def test_the_map_is_what_the_findings_say():
    table = pd.read_csv(REFERENCE / "map.csv")
    assert len(table) == 1008 and table["length"].notna().all()
    quiet, noisy = (table[np.isclose(table["strength"], eps)] for eps in (1e-4, 1e-3))
    means = quiet.groupby(["height", "zeta_over_a"])[["stability_ratio", "length_ratio"]].mean()
    assert means["stability_ratio"].min() == pytest.approx(0.49, abs=0.01)
    assert means["stability_ratio"].max() == pytest.approx(0.65, abs=0.01)
    thin = means[means.index.get_level_values("height") < 0.061]["length_ratio"]
    assert (thin.min(), thin.max()) == pytest.approx((0.58, 0.77), abs=0.01)
    loud = noisy.groupby(["height", "zeta_over_a"])["length_ratio"].mean()
    loud = loud[loud.index.get_level_values("height") < 0.061]
    assert (loud.min(), loud.max()) == pytest.approx((0.55, 0.76), abs=0.01)
    corner = [table["height"].max(), table["zeta_over_a"].min()]
    assert means["length_ratio"].loc[*corner] == pytest.approx(1.0, abs=0.01)
    assert table["stability_length"].isna().sum() == 63
    assert noisy["stability_length"].isna().sum() == 63


if __name__ == "__main__":
    tables = (identical_rows, contrast_rows, patch_theory_rows)
    print(*(row for rows in tables for row in (*rows(), "")), sep="\n")
