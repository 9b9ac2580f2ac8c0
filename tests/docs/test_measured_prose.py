"""Numbers in sentences of README, findings and drop.md against the tables in results/reference.

Each test writes the words of the page with the numbers of today's tables, and looks for them there.
"""

import functools
import re

import numpy as np
import pandas as pd
import xarray as xr
from docs.samples import DOCS, ROOT

from nucleation.api import critical_length, stability_length
from nucleation.patch.pairs import over_realisations
from nucleation.theory.creep.thin import thin_limit

REFERENCE = ROOT / "results" / "reference"
SHOWN = 0.005  # m


@functools.cache
def page(name):
    """The text of a page in one line."""
    path = ROOT / name if name == "README.md" else DOCS / name
    return " ".join(path.read_text(encoding="utf-8").split())


def says(name, *sentences):
    for sentence in sentences:
        assert sentence in page(name), sentence


@functools.cache
def table(name):
    found = pd.read_csv(REFERENCE / f"{name}.csv")
    if "theory_length" in found and "length" in found:
        found["ratio"] = found["length"] / found["theory_length"]
    return found


def span(values, digits=2):
    return f"{values.min():.{digits}f} to {values.max():.{digits}f}"


def of_study(study, **labels):
    """The rows of a study in the table of lengths."""
    found = table("lengths")
    found = found[found["study"] == study]
    for name, value in labels.items():
        found = found[found[name] == value]
    return found


def drops(kind, strength, height=None, evolution="aging"):
    """The runs of the study of the drop with one perturbation."""
    found = table("drop")
    found = found[(found["study"] == "drop") & (found["evolution"] == evolution)]
    found = found[(found["kind"] == kind) & np.isclose(found["strength"], strength, atol=0.0)]
    return found if height is None else found[np.isclose(found["height"], height)]


def quiet_on_fine_meshes():
    """Runs without a declared perturbation on elements finer than the paper's."""
    found = table("drop")
    fine = (found["study"] == "drop") | (found["n_x"] >= 800)
    return found[(found["kind"] == "none") & fine]


def over_theory(study):
    """L/L_c of the aging law at the nine heights, the mean of each fault's realisations."""
    own = of_study(study, evolution="aging", phi0=1.0)
    return own.groupby("height")["ratio"].mean()


def test_onset_and_length_of_the_paper():
    paper = of_study("paper", evolution="aging", height=SHOWN).iloc[0]
    declared = of_study("converged", evolution="aging", height=SHOWN)
    state = drops("state", 1e-5, SHOWN)["onset_time"]
    quiet = quiet_on_fine_meshes().query("height == @SHOWN and n_x == 1600").iloc[0]
    assert len(declared) == len(state) == 6
    assert declared["length"].min() > 0.155
    says(
        "findings.md",
        f"we find {paper['onset_time']:.2f} s and {paper['length']:.3f} m, under the declared load "
        f"{declared['onset_time'].mean():.2f} s ({span(declared['onset_time'])} s over six "
        f"realisations) and {declared['length'].mean():.3f} m "
        f"({span(declared['length'], 3)} m).",
        f"a state that fluctuates by 1e-5 gives {state.mean():.2f} s ({span(state)} s over six "
        f"realisations), a run without perturbation on a fine mesh {quiet['onset_time']:.1f} s and "
        f"{quiet['length']:.3f} m.",
        "at 0.01 V all realisations are longer than 0.155 m.",
    )
    says(
        "README.md",
        f"the force drops at {paper['onset_time']:.1f} s with a patch of {paper['length']:.3f} m "
        f"({paper['length_low']:.3f} to {paper['length_high']:.3f} m over the definitions",
        f"**{paper['length']:.3f} m** is the length of the patch",
        f"its theory predicts {paper['theory_length']:.3f} m",
    )


def test_agreement_with_the_theory():
    paper, declared = over_theory("paper"), over_theory("converged")
    own = 0.15 / of_study("paper", height=SHOWN)["theory_length"].iloc[0]
    apart = {name: max_ratio(found) for name, found in (("d", declared), ("p", paper))}
    assert (paper > 0.75).sum() == 2 and not (declared > 0.75).any()
    says(
        "findings.md",
        f"L/L_c is {span(paper)} on the paper's mesh and {span(declared)} under the declared load.",
        f"its own 0.15 m is {own:.2f} of its theory",
        "within 25 % are two of nine heights on the paper's mesh, and none under the declared load",
        f"within {100 * (apart['d'] - 1):.0f} % under the declared load (any two heights), within "
        f"{100 * (apart['p'] - 1):.0f} % on the paper's mesh",
    )
    says("article.md.in", f"a length {100.0 * (1.0 - own):.0f} % below it")
    says(
        "README.md",
        f"L/L_c is {span(paper)} on the paper's mesh, and {span(declared)} under a load that "
        "fluctuates by 1e-5",
        f"its own 0.15 m is {own:.2f} of its theory",
    )


def max_ratio(series):
    """The largest ratio of a later to an earlier one of some numbers."""
    values = series.to_numpy()
    return max(values[j] / values[i] for j in range(values.size) for i in range(j))


def test_lengths_without_a_declared_perturbation():
    quiet = quiet_on_fine_meshes()
    assert quiet["height"].min() == SHOWN and quiet["height"].max() == 0.1
    says(
        "findings.md",
        f"without a declared perturbation L/L_c is {span(quiet['ratio'])} there (single runs, "
        "H = 0.005 to 0.1 m)",
    )
    says("README.md", f"With nothing but the noise of a fine mesh it is {span(quiet['ratio'])}")


def test_lengths_over_the_strength_of_the_noise():
    strengths = (1e-7, 1e-5, 1e-3, 1e-2)
    for words, kind in (("load", "normal_load"), ("state", "state")):
        cells = [f"{drops(kind, eps, 0.02)['ratio'].mean():.2f}" for eps in strengths]
        quiet = table("drop").query("kind == 'none' and height == 0.02 and study == 'drop'")
        finest = quiet.sort_values("longest_step").iloc[0]["ratio"]
        says("findings.md", f"| {words} | {' | '.join(cells)} | {finest:.2f} |")
        assert {len(drops(kind, eps, 0.02)) for eps in strengths} == {6, 16}
    strong = drops("normal_load", 1e-2, 0.02)
    unstable = (strong["stability_length"] / strong["theory_length"]).iloc[0]
    says(
        "findings.md",
        f"it drops at {strong['ratio'].mean():.2f} of L_c ({span(strong['ratio'])} over six "
        f"realisations), where L_s is {unstable:.2f}.",
    )
    weaker = [drops("normal_load", eps).groupby("height")["ratio"].mean() for eps in (1e-3, 1e-5)]
    says(
        "README.md",
        f"law L is {span(pd.concat(weaker))} L_c with a load that fluctuates by 1e-3 to 1e-5, and "
        f"{strong['ratio'].mean():.2f} with 1e-2",
    )


def test_where_the_patch_becomes_unstable():
    stable = table("patch_stability")
    both = {study: rows["stability_ratio"] for study, rows in stable.groupby("study")}
    frequency = stable["stability_frequency"]
    changes = stable[stable["study"] == "paper"]["stability_change"].abs().max()
    finer = table("patch_convergence")["stability_change"].abs().max()
    says(
        "findings.md",
        f"L_s = {span(both['converged'])} of L_c, for all heights",
        f"change L_s by {100 * finer:.1f} % or less on the fine mesh, by {100 * changes:.1f} % or "
        "less on the paper's",
        f"frequency, {frequency.min():.0f} to {frequency.max():.0f} 1/s",
    )
    says("README.md", f"L_s = **{span(both['converged'])}** L_c")


def test_length_of_instability_over_the_weakening():
    thin = {ratio: thin_limit(ratio).length_ratio for ratio in (1e4, 2.288, 0.5, 0.3, 0.2, 0.1)}
    strong, papers, half, third, fifth, tenth = (f"{value:.2f}" for value in thin.values())
    spaces = [between_half_spaces(ratio) for ratio in (0.5, 0.3, 0.2, 0.1)]
    says(
        "findings.md",
        f"In a thin layer L_s/L_c is {strong} for strong weakening, {papers} for the paper's, "
        f"{half} for zeta/a = 0.5, {third} for 0.3, {fifth} for 0.2 and {tenth} for 0.1; between "
        f"half-spaces it is {spaces[0]:.2f}, {spaces[1]:.2f}, {spaces[2]:.2f} and {spaces[3]:.2f} "
        "for the last four",
        "within 25 % from zeta/a = 0.2 to 0.45",
    )
    says("README.md", "from zeta/a = 0.2 to 0.45 the whole wavelength is right within 25 %")
    right = [(thin_limit(ratio).length_ratio, between_half_spaces(ratio)) for ratio in (0.2, 0.45)]
    assert np.abs(np.array(right) - 1.0).max() < 0.25
    says("patch_theory.md", f"{thin[0.2]:.3f} for zeta/a = 0.2, {thin[0.5]:.3f} for 0.5")


def between_half_spaces(weakening, a=0.0068):
    """L_s/L_c of the paper's material between identical half-spaces."""
    fault = {
        "shear_modulus": 3.1e9, "poisson_ratio": 1 / 3, "friction": 0.41, "a": a,
        "b": a * (1.0 + weakening), "slip_distance": 5e-7, "normal_stress": 1e6,
    }  # fmt: skip
    return float(stability_length(**fault)) / float(critical_length(**fault))


def test_the_theory_of_the_patch_against_all_simulations():
    found = table("patch_theory").dropna(subset=["stability_length"])
    errors = (found["front_length"] / found["stability_length"] - 1.0).abs()
    same = found[np.isclose(found["zeta_over_a"], 2.288, atol=1e-3)]
    same = same[
        np.isclose(same["height"], 0.03) & same["study"].isin(["patch_theory", "converged"])
    ]
    ratios = same["stability_length"] / same["theory_length"]
    assert len(same) == 7
    says(
        "findings.md",
        f"within 3 % for {(errors < 0.03).sum()} of {errors.size} simulated faults and "
        f"{100 * errors.max():.1f} % at worst",
        f"from {span(ratios, 3)} for zeta/a = 2.29 and H = 0.03 m",
    )


def test_slow_slip_before_the_drop():
    """L_run as the table of drop.md has it, which tests/theory/creep/test_runaway.py computes."""
    rows = re.findall(r"\| (0\.\d) \| [\d.]+ \| ([\d.]+) \| [\d.]+ \|", page("drop.md"))
    lengths_of = dict(rows)
    stated = f"{lengths_of['0.3']} L_c for zeta/a = 0.3, {lengths_of['0.5']} for 0.5"
    says("findings.md", stated)


def test_the_map():
    found = table("map")
    quiet, noisy = (found[np.isclose(found["strength"], eps)] for eps in (1e-4, 1e-3))
    cells = quiet.groupby(["height", "zeta_over_a"])["stability_ratio"].mean().reset_index()
    strong = cells[(cells["zeta_over_a"] > 3.0) & (cells["height"] < 0.0852)]["stability_ratio"]
    thin = cells[cells["height"] == SHOWN]["stability_ratio"].max()
    thick = cells["stability_ratio"].max()
    furthest = 100.0 * (2.0 * strong - 1.0).abs().max()
    assert 7.0 < furthest < 8.0 and cells["height"][cells["height"] < 0.0852].max() > 0.085
    means = [
        rows[rows["height"] < 0.0454].groupby(["height", "zeta_over_a"])["length_ratio"].mean()
        for rows in (quiet, noisy)
    ]
    corners = [rows.query("height == 0.3 and zeta_over_a == 1.5") for rows in (quiet, noisy)]
    unstable = corners[0]["stability_ratio"].mean()
    scatter = [100.0 * pooled(rows) for rows in (quiet, noisy)]
    assert {len(rows) for rows in corners} == {3}
    says(
        "findings.md",
        f"**L_s is {span(found['stability_ratio'])} of L_c** for these zeta/a. It is within 8 % of "
        "one half for zeta/a above 3 up to H = 0.085 m, and rises to "
        f"{thin:.2f} for zeta/a = 1.5 in thin blocks and to {thick:.2f} in thick ones.",
        f"Up to H = 0.045 m, L/L_c is {span(means[0])} at 1e-4 and {span(means[1])} at 1e-3",
        f"L/L_c is {corners[0]['length_ratio'].mean():.2f} ({span(corners[0]['length_ratio'])}, "
        f"three realisations) at 1e-4 and {corners[1]['length_ratio'].mean():.2f} "
        f"({span(corners[1]['length_ratio'])}) at 1e-3, while the patch is unstable from "
        f"{unstable:.2f} on.",
        f"Realisations differ by {scatter[0]:.1f} % (1e-4) and {scatter[1]:.1f} % (1e-3) of L_c, "
        "pooled standard deviation.",
    )


def pooled(rows):
    """Standard deviation of L/L_c over the realisations of a fault, pooled over the faults."""
    deviations = rows.groupby(["height", "zeta_over_a"])["length_ratio"].std(ddof=1)
    return np.sqrt(np.mean(deviations**2))


@functools.cache
def pairs():
    """The pairs, one row for each fault, on the usual mesh."""
    frame = table("pairs")
    frame = frame[frame["n_x"] < 1600]
    runs = xr.Dataset({name: ("run", frame[name].to_numpy()) for name in frame})
    return over_realisations(runs).to_dataframe()


def test_half_spaces_as_eta():
    high = pairs().query("study == 'pairs_identical' and height == 0.5").iloc[0]
    eta = np.pi / (1.0 - high["poisson_ratio"])
    unstable, drop = eta * high["stability_ratio"], eta * high["length_ratio"]
    low, most = eta * high["length_ratio_low"], eta * high["length_ratio_high"]
    assert high["realisations"] == 6
    says(
        "findings.md",
        f"unstable at {high['stability_ratio']:.2f} of Eq. (6) and the force drops at "
        f"{high['length_ratio']:.2f} of it. As eta of Eq. (3) these are {unstable:.1f} and "
        f"{drop:.1f} ({low:.1f} to {most:.1f} over six realisations)",
    )
    says("README.md", f"unstable at {unstable:.1f} and the force drops at {drop:.1f} times")


def test_thin_pairs_and_held_layers():
    thin = pairs().query("height == 0.02 and study in ['pairs_identical', 'pairs_far_sides']")
    held = pairs().query("far_side == 'clamped' and f_beta == 0.0").sort_values("height")
    stable = [f"{value:.2f}" for value in held["stability_ratio"]]
    assert list(held["height"]) == [0.02, 0.05, 0.1, 0.2]
    says(
        "findings.md",
        f"L_s/L_c is {span(thin['stability_ratio'])} and L/L_c {span(thin['length_ratio'])} "
        f"(means), while L_c varies from {span(thin['theory_length'])} m",
        f"L_s/L_c = {', '.join(stable[:3])} and {stable[3]} for H = 0.02, 0.05, 0.1 and 0.2 m, and "
        f"L/L_c rises from {held['length_ratio'].iloc[0]:.2f} to "
        f"{held['length_ratio'].iloc[-1]:.2f}.",
    )


def test_weak_weakening_between_blocks_depends_on_their_height():
    weak = pairs()[np.isclose(pairs()["zeta_over_a"], 1.0)]
    alike = weak[np.isclose(weak["f_beta"], 0.0)].sort_values("height")
    assert list(alike["height"]) == [1.0, 2.0] and list(alike["realisations"]) == [6, 6]
    unstable = (weak["stability_ratio"] * weak["half_space_ratio"]).dropna()
    columns = alike[["length_ratio", "length_ratio_low", "length_ratio_high"]]
    (first, *ends), (second, *others) = columns.to_numpy()
    says(
        "findings.md",
        f"from {span(unstable, 1)} L_c^M on",
        f"the force drops at {first:.1f} L_c^M for H = 1 m ({ends[0]:.1f} to {ends[1]:.1f}, six "
        f"realisations) and {second:.1f} for 2 m ({others[0]:.1f} to {others[1]:.1f}, six).",
    )


def test_scales_of_different_half_spaces():
    """From the verdicts, which leave zeta/a = 1 out."""
    rows = pd.read_csv(REFERENCE / "claims_pairs.csv").set_index("id")
    modulus, contrast = (
        100.0 * (rows.loc[name, ["ours_low", "ours_high"]].astype(float) - 1.0).abs().max()
        for name in ("pairs-modulus", "pairs-contrast")
    )
    says(
        "findings.md",
        f"over M, is within {modulus:.0f} % of that of identical bodies, and their difference "
        f"grows as f beta, within {contrast:.0f} %.",
    )


def test_the_slip_law_ahead_of_the_front():
    row = pd.read_csv(REFERENCE / "claims.csv").set_index("id").loc["slip-law-approximation-ahead"]
    least, most = 100.0 * float(row["ours_low"]), 100.0 * float(row["on_papers_mesh"])
    assert "the state is 1.17 s in the place of 1.00 s" in row["reason"]
    says("findings.md", f"from 1.00 to 1.17 s, which adds {least:.1f} to {most:.1f} % to friction")
    inside = of_study("paper", evolution="slip")["state_rate_share_patch"].min()
    assert inside > 0.95


def test_the_laws_spread_is_that_of_sixteen_seeds():
    """Widths from 16 to 84 % over the realisations."""
    found = {}
    for kind in ("normal_load", "state"):
        for strength in (1e-5, 1e-3):
            own = drops(kind, strength, 0.02)
            low, high = np.quantile(own["length"], [0.16, 0.84])
            law = (own["predicted_high"] - own["predicted_low"]).iloc[0]
            found[kind, strength] = (high - low) / law
            assert len(own) == 16
    wide = found.pop(("normal_load", 1e-3))
    assert max(max(width, 1.0 / width) for width in found.values()) < 1.3
    says("drop.md", f"within a factor of 1.3, and for a load at 1e-3 {wide:.1f} times as wide")
