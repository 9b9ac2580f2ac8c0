"""Numbers of docs/findings.md and docs/drop.md against the tables in results/reference.

Rows of docs/drop.md, to copy: ``PYTHONPATH=src python tests/docs/test_measured_pages.py``.
"""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nucleation.theory.finite_patch import loaded_patch_factor
from nucleation.theory.literature import FINITE_PATCH

ROOT = Path(__file__).parents[2]
REFERENCE = ROOT / "results" / "reference"
FINDINGS = (ROOT / "docs" / "findings.md").read_text(encoding="utf-8")
KINDS = ("normal_load", "state", "drive_velocity", "strength")
FEWEST = 5  # realisations of which a spread is compared with the law's


def drop_rows():
    """One row for each fault, kind and strength: measured, and what the law says."""
    table = pd.read_csv(REFERENCE / "drop.csv").dropna(subset=["predicted_length"])
    table["order"] = table["kind"].map(KINDS.index)
    names = ["law", "height", "order", "correlation_length", "strength"]
    for (law, height, order, scale, strength), rows in table.groupby(names):
        theory, ratio = rows["theory_length"].iloc[0], rows["length"] / rows["theory_length"]
        law_says, low, high, line = (
            rows[name].iloc[0] / theory
            for name in ("predicted_length", "predicted_low", "predicted_high",
                         "closed_form_length")
        )  # fmt: skip
        spread = ratio.std(ddof=1)
        kind = f"`{KINDS[order]}`" + (f", {scale:g} m" if KINDS[order] == "strength" else "")
        cells = (
            law, f"{height:g}", kind, f"1e{np.log10(strength):.0f}", str(len(rows)),
            f"{ratio.mean():.3f}", f"{spread:.3f}" if len(rows) > 1 else "", f"{law_says:.3f}",
            f"{low:.3f}-{high:.3f}",
            f"{2.0 * spread / (high - low):.1f}" if len(rows) >= FEWEST else "", f"{line:.3f}",
            f"{100.0 * (law_says / ratio.mean() - 1.0):+.1f} %",
        )  # fmt: skip
        yield re.sub(r"  +", "  ", f"| {' | '.join(cells)} |")


def test_rows_of_the_drop_are_those_of_the_reference():
    page = (ROOT / "docs" / "drop.md").read_text(encoding="utf-8")
    rows = list(drop_rows())
    assert len(rows) > 40
    assert "\n".join(rows) in page


def test_the_law_of_the_drop_reaches_as_far_as_it_is_said_to():
    table = pd.read_csv(REFERENCE / "drop.csv").dropna(subset=["predicted_length"])
    table["ratio"] = table["predicted_length"] / table["length"]
    names = ["law", "height", "kind", "correlation_length", "strength"]
    means = table.groupby(names)["ratio"].mean().reset_index()
    weak = means[means["strength"] < 2e-4]
    assert len(weak) >= 27 and (weak["ratio"] - 1.0).abs().max() < 0.025
    strong = means[np.isclose(means["strength"], 1e-3)]
    others = strong[(strong["kind"] != "normal_load") & (strong["correlation_length"] < 0.021)]
    smooth = others[~((others["kind"] == "strength") & (others["correlation_length"] > 0.015))]
    assert (smooth["ratio"] - 1.0).abs().max() < 0.028


def printed(row, digits):
    """Numbers of a row of a table in the findings."""
    (line,) = re.findall(rf"^\| {re.escape(row)} \|(.*)\|$", FINDINGS, re.M)
    return [f"{float(cell):.{digits}f}" for cell in line.split("|")]


@pytest.mark.parametrize(
    ("row", "column", "digits"),
    [("theory, free far sides (m)", "theory_length", 4), ("L_s/L_c", "stability_ratio", 2),
     ("L/L_c at the drop", "length_ratio", 2)],
)  # fmt: skip
def test_identical_blocks_are_those_of_the_reference(row, column, digits):
    pairs = pd.read_csv(REFERENCE / "pairs.csv")
    own = pairs[pairs["study"] == "pairs_identical"].sort_values("height")
    for said, value in zip(printed(row, digits), own[column], strict=True):
        assert float(said) == pytest.approx(value, abs=0.51 * 10.0**-digits)


def ratios(zeta_over_a, sign, column):
    """Lengths over L_c^M of Figure 2's simulated pairs, from no contrast to the largest."""
    pairs = pd.read_csv(REFERENCE / "pairs.csv")
    own = pairs[(pairs["study"] == "figure_2_simulated")
                & np.isclose(pairs["zeta_over_a"], zeta_over_a)]  # fmt: skip
    own = own[own["f_beta"] * sign >= -1e-9].sort_values("f_beta", key=abs)
    return (own[column] * own["half_space_ratio"]).tolist()


def test_senses_of_the_contrast_are_those_of_the_reference():
    said = {
        (10.0, -1, "length_ratio"): (0.62, 0.54), (3.0, -1, "length_ratio"): (0.67, 0.65),
        (10.0, 1, "length_ratio"): (0.62, 0.87), (3.0, 1, "length_ratio"): (0.67, 0.88),
        (10.0, 1, "stability_ratio"): (0.46, 0.68), (3.0, 1, "stability_ratio"): (0.50, 0.67),
        (1.0, 1, "length_ratio"): (1.19, 2.39), (1.0, -1, "length_ratio"): (1.19, 1.18),
    }  # fmt: skip
    for case, ends in said.items():
        found = ratios(*case)
        assert len(found) == 5
        assert (found[0], found[-1]) == pytest.approx(ends, abs=0.0051), case
        assert all(f"{end:.2f}" in FINDINGS for end in ends)


def test_lengths_of_finite_patches_beside_simulated_ones_are_as_stated():
    pairs = pd.read_csv(REFERENCE / "pairs.csv")
    same = pairs[np.isclose(pairs["f_beta"], 0.0)]
    high = {2.288: same[same["height"] == 0.5].iloc[0]}
    for weakening in (3.0, 10.0):
        own = same[(same["study"] == "figure_2_simulated")
                   & np.isclose(same["zeta_over_a"], weakening)]  # fmt: skip
        (high[weakening],) = (row for _, row in own.iterrows())
    said = {2.288: (1.44, 1.39), 3.0: (1.35, 1.32), 10.0: (1.25, 1.24)}
    for weakening, row in high.items():
        factors = FINITE_PATCH, loaded_patch_factor(1.0 / (1.0 + weakening))
        found = [row["stability_ratio"] * np.pi / factor for factor in factors]
        assert found == pytest.approx(said[weakening], abs=0.0051)
        assert all(f"{value:.2f}" in FINDINGS for value in said[weakening])


def test_mean_lengths_of_both_senses_are_as_stated():
    """Over M, and over those of identical bodies, for weak and for stronger weakening."""
    means = {}
    for weakening in (1.0, 3.0, 10.0):
        senses = [np.array(ratios(weakening, sign, "length_ratio")) for sign in (1, -1)]
        means[weakening] = (senses[0] + senses[1])[1:] / (2.0 * senses[0][0])
    strong = np.concatenate([means[3.0], means[10.0]])
    assert (strong.min(), strong.max()) == pytest.approx((0.99, 1.14), abs=0.0051)
    assert means[1.0].max() == pytest.approx(1.50, abs=0.0051)
    assert "0.99 to 1.14" in FINDINGS and "up to 1.50" in FINDINGS


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
    assert table["stability_length"].isna().sum() == 67
    assert noisy["stability_length"].isna().sum() == 67


if __name__ == "__main__":
    print("\n".join(drop_rows()))
