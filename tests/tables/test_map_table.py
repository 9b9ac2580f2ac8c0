"""The map of lengths: rows of a table on their places of a grid, and what is drawn of them."""

import drawn_layout
import numpy as np
import pytest
import xarray as xr
from made_up_map import lengths

from nucleation.datasets.variables import DatasetError
from replication.figures import figure_map
from replication.tables.map import AXES, gather_map, mean_over_seeds, on_grid


def test_every_run_is_in_its_place():
    grid = on_grid(gather_map(lengths()))
    assert tuple(grid["length"].dims) == AXES
    at = {"height": 0.1, "zeta_over_a": 3.0}
    theory = 0.1**0.5 / 3.0
    assert float(grid["critical_length"].sel(at)) == pytest.approx(theory)
    found = grid["length"].sel(at | {"strength": 1e-3, "seed": 2})
    assert float(found) == pytest.approx(theory * 0.63)
    ratio = mean_over_seeds(grid, "length_ratio")
    np.testing.assert_allclose(ratio.sel(strength=1e-5), 0.6151)
    np.testing.assert_allclose(grid["stability_ratio"], 0.5)


def test_runs_that_differ_in_something_else_are_refused():
    """One overwrote the other: a second material is on none of the axes."""
    twice = xr.concat([gather_map(lengths()), gather_map(lengths()).isel(run=[3])], dim="run")
    with pytest.raises(DatasetError, match="differ in more than height, zeta_over_a"):
        on_grid(twice)


def test_a_missing_run_is_a_gap_and_not_passed_over():
    grid = on_grid(gather_map(lengths(missing=[(0.1, 3.0, 1e-5, 2)])))
    ratio = mean_over_seeds(grid, "length_ratio").sel(strength=1e-5)
    assert np.isnan(ratio.sel(height=0.1, zeta_over_a=3.0))
    assert int(np.isnan(ratio).sum()) == 1


def test_figure_shows_the_ratios_and_the_lengths():
    figure = figure_map.draw(on_grid(gather_map(lengths())))
    stable, quiet, noisy, slices = figure.axes[:4]
    for axes, value in ((stable, 0.5), (quiet, 0.6151), (noisy, 0.625)):
        (image,) = axes.collections[:1]
        np.testing.assert_allclose(image.get_array(), value, atol=1e-4)
    curves = [line.get_ydata() for line in slices.lines if len(line.get_xdata()) == 3]
    for i in range(0, len(curves), 3):
        theory, drop, stability = curves[i : i + 3]
        np.testing.assert_allclose(drop / theory, 0.6151, rtol=1e-4)
        np.testing.assert_allclose(stability / theory, 0.5)


def test_contours_are_smoothed_over_known_neighbours_only():
    """Scatter of one row is halved, a plane stays, and a gap takes no part."""
    scattered = np.array([[0.0], [0.0], [1.0], [0.0], [0.0]])
    np.testing.assert_allclose(figure_map._smoothed(scattered).T, [[0, 0.25, 0.5, 0.25, 0]])
    plane = np.arange(5.0)[:, None] * np.ones(3)
    np.testing.assert_allclose(figure_map._smoothed(plane)[1:-1], plane[1:-1])
    gap = np.array([[2.0], [2.0], [np.nan], [2.0]])
    np.testing.assert_allclose(figure_map._smoothed(gap).T, [[2, 2, np.nan, 2]])


@pytest.mark.slow
@pytest.mark.parametrize("shape", [(1, 2), (2, 1), (2, 2), (3, 2)])
def test_small_grids_are_legible(shape):
    """Cells are centred on their values, and no texts collide."""
    heights, weakenings = shape
    grid = on_grid(gather_map(lengths())).isel(height=slice(heights), zeta_over_a=slice(weakenings))
    figure = figure_map.draw(grid)
    drawn_layout.require_legible(figure)
    for axes in figure.axes[:3]:
        left, right = axes.get_xlim()
        assert left < grid["height"].values.min() and right > grid["height"].values.max()
