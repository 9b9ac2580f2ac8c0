"""Numbers of docs/drop.md on other faults and on weak weakening are those of the reference."""

import numpy as np
import pytest
from docs.prose import page, table

from nucleation.drop.expected_drop import OF_STRONG, OF_STRONG_NOISE, OF_WEAK

TEXT = " ".join(page("drop.md").split())
TABLE = table("other_faults")
DROPPED = TABLE.dropna(subset=["length"])
OTHERS = TABLE[TABLE["length"].isna()].sort_values("zeta_over_a")


def test_the_faults():
    ratio = TABLE["zeta_over_a"]
    height = TABLE["height"] / TABLE["critical_length"]
    assert f"of 0.2 to {ratio.max():.1f}, both laws" in TEXT and round(ratio.min(), 1) == 0.2
    assert f"blocks from {height.min():.2f} to {height.max():.1f} $L_c$ high" in TEXT
    assert f"different bodies, {TABLE['realisations'].sum()} simulations" in TEXT
    assert len(TABLE) == 20
    assert len(TABLE.groupby(["friction_law", "evolution"])) == 4


def test_drops_are_in_the_expected_range():
    mean = DROPPED["length"]
    inside = (mean >= DROPPED["expected_low"]) & (mean <= DROPPED["expected_high"])
    assert f"In {inside.sum()} of the {len(DROPPED)} faults where the force drops" in TEXT
    errors = 100.0 * (mean / DROPPED["expected_length"] - 1.0)
    stated = f"{-errors.min():.0f} % below to {errors.max():.0f} % above the expected length"
    assert stated in TEXT
    single = f"{DROPPED['inside'].sum()} of {DROPPED['realisations'].sum()} are within the range"
    assert single in TEXT


def test_faults_without_a_drop_are_warned_of():
    critical = OTHERS["critical_length"]
    reached = (OTHERS["reached_length"] / critical).map("{:.2f}".format)
    expected = (OTHERS["expected_length"] / critical).map("{:.2f}".format)
    weak = OTHERS["zeta_over_a"].map("{:.2f}".format)
    assert f"$\\zeta/a$ of {' and '.join(weak)} the force does not drop" in TEXT
    assert f"up to {' and '.join(reached)} $L_c$ (expected: {' and '.join(expected)})" in TEXT
    assert (OTHERS["evolution"] == "slip").all() and OTHERS["doubt"].notna().all()


def drops():
    """The simulated drops after slow slip, with their length over the expected one."""
    found = table("weakening")
    found = found[(found["study"] == "weakening") & np.isfinite(found["runaway_length"])]
    return found.assign(over_expected=found["length"] / found["expected_length"])


def test_the_range_about_the_runaway_length():
    """Thin blocks, and high ones; and the law of the drop alone."""
    thin = drops()["height"] < 0.1
    low, high = (drops()[thin]["over_expected"].agg(way) for way in ("min", "max"))
    assert f"from {1 - low:.0%} below to {high - 1:.0%} above".replace("%", " %") in TEXT
    low, high = (drops()[~thin]["over_expected"].agg(way) for way in ("min", "max"))
    assert f"from {1 - low:.0%} below to {high - 1:.0%} above".replace("%", " %") in TEXT
    short = 1.0 - (drops()["law_length"] / drops()["length"]).min()
    assert f"up to {short:.0%} short".replace("%", " %") in TEXT


BLIND = table("blind")
NO_DOUBT = BLIND["doubt"].isna()
SECOND = BLIND["set"] == "second"
COUNTED = [  # the columns of the page: a set, and the range predicted before or today's
    (BLIND["set"] == "calibrate", "predicted_inside"),
    (BLIND["set"] == "calibrate", "inside"),
    (BLIND["set"] == "test", "predicted_inside"),
    (BLIND["set"] == "test", "inside"),
    (SECOND, "predicted_inside"),
]


@pytest.mark.parametrize(
    ("words", "kept"),
    [("all", NO_DOUBT | True), ("without a doubt", NO_DOUBT), ("with a doubt", ~NO_DOUBT)],
)
def test_coverage_of_the_blind_faults(words, kept):
    counted = [(BLIND[those & kept], inside) for those, inside in COUNTED]
    cells = [f"{own[inside].sum()} of {len(own)}" for own, inside in counted]
    assert f"| {words} | {' | '.join(cells)} |" in TEXT


def width(kind, kept):
    """The mean width of ranges over L, in per cent."""
    own = BLIND[kept]
    return 100.0 * ((own[f"{kind}_high"] - own[f"{kind}_low"]) / own[f"{kind}_length"]).mean()


def test_widths_of_the_ranges():
    stated = f"is {width('expected', ~SECOND):.0f} % of $L$, in place of "
    stated += f"{width('predicted', ~SECOND):.0f} %; without a doubt "
    assert stated + f"{width('expected', ~SECOND & NO_DOUBT):.0f} %" in TEXT
    assert f"Of {sum(~SECOND)} realisations {BLIND['predicted_inside'][~SECOND].sum()} were" in TEXT
    stated = f"In the second set it is {width('predicted', SECOND):.0f} %; without a doubt "
    assert stated + f"{width('predicted', SECOND & NO_DOUBT):.0f} %" in TEXT


def test_margins_of_the_ranges():
    margins = {
        "$\\zeta/a$ of 2 or more": OF_STRONG,
        "$\\zeta/a$ below 2": OF_WEAK,
        "$\\varepsilon_{\\mathrm{eff}}$ of 0.1 or more": OF_STRONG_NOISE,
    }
    for words, margin in margins.items():
        shown = " | ".join(f"{100 * part:g} %" for part in margin)
        assert f"| {words} | {shown} |" in TEXT


def test_drops_in_strong_noise():
    strong = BLIND["doubt"].str.contains("perturbation is strong", na=False)
    ratio = 100.0 * (BLIND["length"] / BLIND["expected_length"] - 1.0)[strong]
    assert f"up to {-ratio.min():.0f} % before and {ratio.max():.0f} % beyond" in TEXT
