"""The map of lengths in the page: ratios over height and weakening, to hover over and to slice."""

from typing import Any

import numpy as np
import xarray as xr

from ..figures.beyond.figure_map import RATIOS
from ..patch.map_table import mean_over_seeds


def in_page(grid: xr.Dataset | None) -> dict[str, Any] | None:
    """What the page reads of a map (:func:`nucleation.patch.map_table.on_grid`); None without one.

    Lengths in m, on [weakening][height]; None where there is none.
    """
    if grid is None:
        return None
    stability = mean_over_seeds(grid, "stability_length").isel(strength=0)
    fields = [{"label": "the patch turns unstable", "length": _rows(stability)}]
    drops = mean_over_seeds(grid, "length")
    for i, strength in enumerate(grid["strength"].values):
        label = f"the force drops, load fluctuating by {power(float(strength))}"
        fields.append({"label": label, "length": _rows(drops.isel(strength=i))})
    return {
        "height": grid["height"].values.tolist(),
        "weakening": grid["zeta_over_a"].values.tolist(),
        "seeds": int(grid.sizes["seed"]),
        "theory": _rows(grid["theory_length"]),
        "fields": fields,
        "ratios": list(RATIOS),
    }


def power(strength: float) -> str:
    """A strength with a power of ten, as it is written by hand: 10⁻⁵, 3 × 10⁻⁴."""
    digits, exponent = f"{strength:.1e}".split("e")
    power = "10" + str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return power if float(digits) == 1.0 else f"{float(digits):g} × {power}"


def _rows(values: xr.DataArray) -> list[list[float | None]]:
    """Values on [weakening][height], to five digits."""
    table = values.transpose("zeta_over_a", "height").values
    return [[float(f"{v:.5g}") if np.isfinite(v) else None for v in row] for row in table]
