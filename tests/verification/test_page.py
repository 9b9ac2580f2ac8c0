"""docs/verification.md against the reference set, and the reference set against today's code."""

import io
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nucleation.verification import orders

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "verification.md").read_text(encoding="utf-8")
CONVERGENCE, DISPERSION, PAIR_MODES = (
    pd.read_csv(ROOT / "results" / "reference" / f"{name}.csv")
    for name in ("verification", "dispersion", "pair_modes")
)


def rows(heading):
    """Cells of the rows of the page's first table below a heading, its head left out."""
    table = PAGE.split(f"# {heading}\n", 1)[1].partition("\n|")[2].partition("\n\n")[0]
    lines = table.strip("\n").split("\n")[2:]
    return [[cell.strip() for cell in line.strip("| ").split("|")] for line in lines]


def test_orders_on_the_finest_level_are_those_of_the_reference():
    names = [f"{name}_order" for name in orders.ERRORS]
    of_refinement = CONVERGENCE.groupby("refinement", sort=False)
    for cells, (_, own) in zip(rows("Orders of convergence"), of_refinement, strict=True):
        found = own.loc[own["spacing"] < 1.01 * own["spacing"].min(), names].stack().dropna()
        assert len(found) >= 6
        assert cells[-1] == f"{found.min():.2f} to {found.max():.2f}"


@pytest.mark.slow
def test_reference_orders_are_measured_today(convergence):
    """To two digits of the errors: they are no round-off."""
    now = pd.read_csv(io.StringIO(orders.convergence_csv(convergence)))
    names = ["problem", "refinement", *orders.ERRORS]
    pd.testing.assert_frame_equal(now[names], CONVERGENCE[names], rtol=5e-3, atol=0.0)


def test_bridge_is_that_of_the_reference():
    groups = DISPERSION.groupby("height", sort=False)
    for cells, (height, modes) in zip(rows("The bridge to the linear theory"), groups, strict=True):
        k, crossing = modes["mode_wavenumber"] * height, vanishing(modes)
        assert cells == [
            f"{height:g}",
            f"{k.min():.2f} to {k.max():.2f}",
            f"{100 * modes['disagreement'].max():.2f} %",
            f"{crossing:.4f}",
        ]
        assert crossing == pytest.approx(1.0, abs=2e-3)
        assert modes["disagreement"].max() < 3e-3  # 1 % is asked for


def vanishing(modes):
    """k / k_c where the faster mode's measured growth changes sign, by linear interpolation."""
    fastest = modes.groupby("wavenumber_over_critical")["measured_growth"].max()
    i = np.flatnonzero(np.diff(np.sign(fastest)))[0]
    return np.interp(0.0, -fastest.iloc[i : i + 2], fastest.index[i : i + 2])


def far_side(name):
    """A pair's far sides, and whether the stiffer layer is above."""
    words = name.split(", ")
    if words[0].startswith("half-spaces"):
        return ", ".join(words[:-1]), words[-1].endswith("above")
    return words[1], words[0].endswith("above")


def test_bridge_of_two_layers_is_that_of_the_reference():
    """All far sides with either layer the stiffer one, six wavenumbers each, both directions."""
    cells = {}
    for name, modes in PAIR_MODES.groupby("id", sort=False):
        assert len(modes) == 12
        k = modes["mode_wavenumber"] * modes["height"]
        ends = [f"{k.min():.2f}", f"{k.max():.2f}"]
        worst = modes.groupby("branch")["disagreement"].max()
        assert worst.max() < 5e-3  # 1 % is asked for
        errors = [f"{100 * error:.2f}" for error in worst]
        side, stiff_above = far_side(name)
        cells.setdefault(side, {})[stiff_above] = [
            " to ".join(dict.fromkeys(ends)),
            f"{', '.join(errors)} %",
        ]
    found = [[side, *both[True], *both[False]] for side, both in cells.items()]
    assert sorted(found) == sorted(rows("Two layers"))
