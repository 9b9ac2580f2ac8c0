"""Figure 2 with simulations, from a made-up table."""

import numpy as np
import pytest
import xarray as xr

from nucleation.theory.closed_forms import bimaterial_length_ratio
from replication.figures import figure_2_simulated
from replication.figures.theory import looks


@pytest.fixture
def table():
    rows = []
    for height in (0.01, 0.1, 1.0):
        rows.append(("pairs_identical", "free", height, 0.0, 2.35, 0.4))
    for weakening in (1.0, 10.0):
        for contrast in (-0.3, -0.1, 0.0, 0.1, 0.3):
            rows.append(("figure_2_simulated", "free", 1.0, contrast, weakening, 0.3))
    study, side, height, f_beta, weakening, theory = map(np.array, zip(*rows, strict=True))
    columns = {
        "role": study, "study": study, "ensemble": np.arange(height.size).astype(str),
        "far_side": side, "height": height, "second_height": height,
        "f_beta": f_beta, "zeta_over_a": weakening, "critical_length": theory,
        "length": 0.7 * theory, "stability_length": 0.5 * theory,
        "length_ratio": 0.7 + 0.0 * theory, "stability_ratio": 0.5 + 0.0 * theory,
        "half_space_ratio": bimaterial_length_ratio(f_beta, weakening),
        "strength": np.full(height.size, 1e-5), "kind": np.full(height.size, "normal_load"),
        "n_x": np.full(height.size, 400), "seed": np.zeros(height.size),
        "id": np.arange(height.size).astype(str),
    }  # fmt: skip
    one = xr.Dataset({name: ("run", values) for name, values in columns.items()})
    other = one.assign(seed=one["seed"] + 1)  # a realisation that is a tenth longer
    other = other.assign({n: 8.0 / 7.0 * one[n] for n in ("length", "length_ratio")})
    return xr.concat([one, other], dim="run")


def test_colours_are_those_of_figure_2_and_runs_without_a_length_are_marked(table, theory):
    unknown = table["f_beta"].values == 0.1
    lost = table["stability_ratio"].where(~xr.DataArray(unknown, dims="run"))
    panels = figure_2_simulated.draw(table.assign(stability_ratio=lost), theory).axes[:2]
    papers = looks(theory["zeta_over_a"].values)
    for axes in panels:
        for weakening in (10.0, 1.0):
            label = rf"Eq. (9), $\zeta/a={weakening:g}$"
            curve = next(line for line in axes.lines if line.get_label() == label)
            assert curve.get_color() == papers[weakening]["color"]
    crosses = [line for line in panels[1].lines if line.get_marker() == "x"]
    assert [line.get_xdata().tolist() for line in crosses] == [[0.1], [0.1]]
    assert not [line for line in panels[0].lines if line.get_marker() == "x"]


def test_figure_2_has_both_senses_in_units_without_contrast(table, theory):
    left, right = figure_2_simulated.draw(table, theory).axes[:2]
    assert len(left.containers) == 2
    for panel, ratio in ((left, 0.75), (right, 0.5)):
        for (points, _, bars), weakening in zip(panel.containers, (10.0, 1.0), strict=True):
            x, y = points.get_data()
            np.testing.assert_allclose(x, (-0.3, -0.1, 0.0, 0.1, 0.3))
            unit = bimaterial_length_ratio(np.abs(x), weakening)
            np.testing.assert_allclose(y, ratio * unit)
            ends = np.array([bar[:, 1] for bar in bars[0].get_segments()])
            expected = (0.7, 0.8) if panel is left else (0.5, 0.5)
            np.testing.assert_allclose(ends, np.outer(unit, expected))
