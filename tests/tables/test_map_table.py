"""The map of lengths: rows of a table on their places of a grid, and what is drawn of them."""

import itertools

import numpy as np
import pytest
import xarray as xr
from figures import drawn_layout

from nucleation.datasets.variables import DatasetError
from replication.figures import figure_weakening
from replication.tables.ratios import AXES, MAP, map_files


def lengths(missing=()):
    """A table of a map of 24 runs without some of them, in an order of no meaning."""
    places = itertools.product([0.01, 0.1, 1.0], [1.0, 3.0], [1e-5, 1e-3], [1, 2])
    rows = [place for place in places if place not in missing]
    rows = [rows[i] for i in np.random.default_rng(3).permutation(len(rows))]
    height, weakening, strength, seed = map(np.array, zip(*rows, strict=True))
    theory = height**0.5 / weakening
    columns = {
        "height": height, "strength": strength, "seed": seed.astype(int), "critical_length": theory,
        "a": np.full(len(rows), 0.0068), "zeta": 0.0068 * weakening,
        "length": theory * (0.6 + 0.01 * seed + 10.0 * strength), "stability_length": theory * 0.5,
    }  # fmt: skip
    others = {name: np.zeros(len(rows)) for name in MAP if name not in columns}
    return xr.Dataset({name: ("run", values) for name, values in (others | columns).items()})


def test_every_run_is_in_its_place():
    grid = map_files(lengths())[".nc"]
    assert tuple(grid["length"].dims) == AXES
    at = {"height": 0.1, "zeta_over_a": 3.0}
    theory = 0.1**0.5 / 3.0
    assert float(grid["critical_length"].sel(at)) == pytest.approx(theory)
    found = grid["length"].sel(at | {"strength": 1e-3, "seed": 2})
    assert float(found) == pytest.approx(theory * 0.63)
    ratio = grid["length_ratio"].mean("seed", skipna=False)
    np.testing.assert_allclose(ratio.sel(strength=1e-5), 0.6151)
    np.testing.assert_allclose(grid["stability_ratio"], 0.5)


def test_runs_that_differ_in_something_else_are_refused():
    """One overwrote the other: a second material is on none of the axes."""
    twice = xr.concat([lengths(), lengths().isel(run=[3])], dim="run")
    with pytest.raises(DatasetError, match="differ in more than height, zeta_over_a"):
        map_files(twice)


def test_a_missing_run_is_a_gap_and_not_passed_over():
    grid = map_files(lengths(missing=[(0.1, 3.0, 1e-5, 2)]))[".nc"]
    ratio = grid["length_ratio"].mean("seed", skipna=False).sel(strength=1e-5)
    assert np.isnan(ratio.sel(height=0.1, zeta_over_a=3.0))
    assert int(np.isnan(ratio).sum()) == 1


def test_figure_shows_the_ratios():
    figure = figure_weakening.draw_map(map_files(lengths())[".nc"])
    stable, quiet, noisy = figure.axes[:3]
    for axes, value in ((stable, 0.5), (quiet, 0.6151), (noisy, 0.625)):
        (image,) = axes.collections[:1]
        np.testing.assert_allclose(image.get_array(), value, atol=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("shape", [(1, 2), (2, 1), (2, 2), (3, 2)])
def test_small_grids_are_legible(shape):
    """Cells are centred on their values, and no texts collide."""
    heights, weakenings = shape
    grid = map_files(lengths())[".nc"].isel(height=slice(heights), zeta_over_a=slice(weakenings))
    figure = figure_weakening.draw_map(grid)
    drawn_layout.require_legible(figure)
    for axes in figure.axes[:3]:
        left, right = axes.get_xlim()
        assert left < grid["height"].values.min() and right > grid["height"].values.max()
