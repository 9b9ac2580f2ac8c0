"""Runs beside the finest of a sequence of refinement, and on the grid of the map."""

import itertools

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from figures import drawn_layout

from nucleation.datasets.variables import DatasetError
from replication.figures import figure_weakening
from replication.tables.ratios import AXES, MAP, REFINEMENT, map_files, refinement_table, sequences


def row(**values):
    usual = {
        "id": "run",
        "height": 0.02,
        "evolution": "aging",
        "initial_state": 1.0,
        "kind": "normal_load",
        "strength": 1e-5,
        "correlation_length": 0.0,
        "seed": 1,
        "n_x": 400,
        "n_y": 20,
        "grading": 20.0,
        "longest_step": 0.02,
        "tolerance": 1e-2,
        "length": 0.3,
        "fault": "f0.02",
        "critical_length": 0.5,
        "block_length": 2.0,
        "onset_time": 12.0,
        "steps": 100,
        "wall_seconds": 1.0,
    }
    return {**usual, **values}


def table(rows):
    return xr.Dataset({name: ("run", [r[name] for r in rows]) for name in rows[0]})


def test_sequences_differ_in_one_parameter_and_go_from_coarse_to_fine():
    rows = [
        row(n_x=n, height=h, fault=f"f{h}")
        for n, h in itertools.product((1600, 400, 800), (0.02, 0.1))
    ]
    rows += [row(longest_step=step) for step in (0.01, 0.04)] + [row(n_y=40, fault="other")]
    rows += [row(n_x=3200, tolerance=1e-3), row(n_x=3200, grading=5.0)]
    rows += [row(n_x=3200, kind="none"), row(n_x=3200, strength=1e-3), row(n_x=3200, seed=2)]
    rows += [row(n_x=3200, correlation_length=0.01), row(n_x=3200, block_length=4.0)]
    runs = pd.DataFrame(rows)
    found = sequences(runs, "n_x")
    assert [list(own["n_x"]) for own in found] == [[400, 800, 1600]] * 2
    assert [set(own["height"]) for own in found] == [{0.02}, {0.1}]
    (steps,) = sequences(runs, "longest_step")
    assert list(steps["longest_step"]) == [0.04, 0.02, 0.01]
    assert sequences(runs, "n_y") == sequences(runs, "tolerance") == []


def test_table_compares_with_the_finest_run():
    rows = [
        row(id=f"n{n}", n_x=n, length=0.3 + 10.0 / n, onset_time=12.0 - 100.0 / n)
        for n in (1600, 400, 800)
    ]
    found = refinement_table([table(rows)])
    assert tuple(found.data_vars) == tuple(REFINEMENT)
    assert list(found["id"].values) == ["n400", "n800", "n1600"]
    sizes = np.array([400.0, 800.0, 1600.0])
    length, onset = 0.3 + 10.0 / sizes, 12.0 - 100.0 / sizes
    np.testing.assert_allclose(found["length_difference"], length / length[-1] - 1.0)
    np.testing.assert_allclose(found["onset_difference"], onset / onset[-1] - 1.0)
    np.testing.assert_allclose(found["elements_difference"], (length - length[-1]) * sizes / 2.0)
    assert (found["refinement"] == "n_x").all()
    np.testing.assert_allclose(found["length_over_theory"], found["length"] / 0.5)


def lengths(missing=()):
    """A table of a map of 24 runs without some of them, in an order of no meaning."""
    places = itertools.product([0.01, 0.1, 1.0], [1.0, 3.0], [1e-5, 1e-3], [1, 2])
    rows = [place for place in places if place not in missing]
    rows = [rows[i] for i in np.random.default_rng(3).permutation(len(rows))]
    height, weakening, strength, seed = map(np.array, zip(*rows, strict=True))
    theory = height**0.5 / weakening
    columns = {
        "height": height,
        "strength": strength,
        "seed": seed.astype(int),
        "critical_length": theory,
        "a": np.full(len(rows), 0.0068),
        "zeta": 0.0068 * weakening,
        "length": theory * (0.6 + 0.01 * seed + 10.0 * strength),
        "stability_length": theory * 0.5,
    }
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
