"""The numbers of docs/drop.md on weak weakening are those of the table of the reference."""

import numpy as np
from docs.prose import page, table

TEXT = page("drop.md")


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
