"""The numbers of docs/drop.md on weak weakening are those of the table of the reference."""

import re

import numpy as np
from docs.prose import page, table

SYSTEMS = {
    "rigid base, $H$ = 0.02 m": ("rigid", 0.02),
    "identical blocks, $H$ = 0.02 m": ("deformable", 0.02),
    "identical blocks, $H$ = 2.5 m": ("deformable", 2.5),
}
TEXT = page("drop.md")


def drops():
    """The simulated drops after slow slip, with their length over the expected one."""
    found = table("weakening")
    found = found[(found["study"] == "weakening") & np.isfinite(found["runaway_length"])]
    return found.assign(over_expected=found["length"] / found["expected_length"])


def test_lengths_of_each_realisation():
    rows = re.findall(
        r"\| ((?:rigid|identical)[^|]*\$H\$[^|]*) \|([^|]*)\|([^|]*)\|([^|]*)\|([^|]*)\|", TEXT
    )
    assert len(rows) == 3
    for name, *cells in rows:
        base, height = SYSTEMS[name]
        own = drops()[(drops()["below"] == base) & np.isclose(drops()["height"], height)]
        for weakening, cell in zip((0.3, 0.5, 0.8, 1.5), cells, strict=True):
            ratios = own[np.isclose(own["zeta_over_a"], weakening)]["ratio"].sort_values()
            assert ", ".join(f"{ratio:.2f}" for ratio in ratios) == cell.strip(), (name, weakening)


def test_the_range_about_the_runaway_length():
    """Thin blocks, and high ones; and the law of the drop alone."""
    thin = drops()["height"] < 0.1
    low, high = (drops()[thin]["over_expected"].agg(way) for way in ("min", "max"))
    assert f"from {1 - low:.0%} below to {high - 1:.0%} above".replace("%", " %") in TEXT
    low, high = (drops()[~thin]["over_expected"].agg(way) for way in ("min", "max"))
    assert f"from {1 - low:.0%} below to {high - 1:.0%} above".replace("%", " %") in TEXT
    short = 1.0 - (drops()["law_length"] / drops()["length"]).min()
    assert f"up to {short:.0%} short".replace("%", " %") in TEXT
