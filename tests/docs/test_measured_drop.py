"""Numbers of docs/drop.md on other faults and on weak weakening are those of the reference."""

import numpy as np
from docs.prose import page, table

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
