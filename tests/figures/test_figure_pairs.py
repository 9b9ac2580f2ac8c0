"""Figures of two deformable bodies, from a made-up table."""

import numpy as np
import pytest
import xarray as xr

from nucleation.figures.beyond import figure_2_simulated, figure_pairs
from nucleation.theory.closed_forms import bimaterial_length_ratio


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
        "role": study, "far_side": side, "height": height, "second_height": height,
        "f_beta": f_beta, "zeta_over_a": weakening, "theory_length": theory,
        "length": 0.7 * theory, "stability_length": 0.5 * theory,
        "length_ratio": 0.7 + 0.0 * theory, "stability_ratio": 0.5 + 0.0 * theory,
        "half_space_ratio": bimaterial_length_ratio(f_beta, weakening),
        "strength": np.full(height.size, 1e-5), "kind": np.full(height.size, "normal_load"),
    }  # fmt: skip
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


def test_identical_blocks_and_ratios(table):
    left, right = figure_pairs.draw(table).axes
    np.testing.assert_allclose(left.lines[1].get_ydata(), 0.28)
    np.testing.assert_allclose(left.lines[2].get_ydata(), 0.2)
    np.testing.assert_allclose(right.lines[0].get_ydata(), 0.7)
    assert right.lines[0].get_xdata().size == 3  # those of other friction are elsewhere


def test_figure_2_has_both_senses_in_units_without_contrast(table):
    left, right = figure_2_simulated.draw(table).axes[:2]
    points = [line for line in left.lines if line.get_linestyle() == "None"][:4]
    assert [line.get_marker() for line in points] == ["v", "^", "v", "^"]
    for line, weakening in zip(points, (10.0, 10.0, 1.0, 1.0), strict=True):
        expected = 0.7 * bimaterial_length_ratio(line.get_xdata(), weakening)
        np.testing.assert_allclose(line.get_ydata(), expected)
        assert sorted(line.get_xdata()) == pytest.approx([0.0, 0.1, 0.3])
    assert right.lines[1].get_ydata().max() < left.lines[1].get_ydata().max()
