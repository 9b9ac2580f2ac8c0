"""A made-up map of lengths over height and weakening, whose ratios to the theory are known."""

import numpy as np
import xarray as xr

from replication.tables.ratios import MAP

HEIGHTS, WEAKENINGS, STRENGTHS, SEEDS = [0.01, 0.1, 1.0], [1.0, 3.0], [1e-5, 1e-3], [1, 2]


def lengths(missing=()):
    """A table of a map of 24 runs without some of them, in an order of no meaning."""
    rows = [
        (h, w, e, s) for h in HEIGHTS for w in WEAKENINGS for e in STRENGTHS for s in SEEDS
        if (h, w, e, s) not in missing
    ]  # fmt: skip
    rows = [rows[i] for i in np.random.default_rng(3).permutation(len(rows))]
    height, weakening, strength, seed = map(np.array, zip(*rows, strict=True))
    theory = height**0.5 / weakening
    columns = {
        "height": height,
        "strength": strength,
        "seed": seed.astype(int),
        "a": np.full(len(rows), 0.0068),
        "zeta": 0.0068 * weakening,
        "critical_length": theory,
        "length": theory * (0.6 + 0.01 * seed + 10.0 * strength),
        "stability_length": theory * 0.5,
    }
    others = {name: np.zeros(len(rows)) for name in MAP if name not in columns}
    return xr.Dataset({name: ("run", values) for name, values in (others | columns).items()})
