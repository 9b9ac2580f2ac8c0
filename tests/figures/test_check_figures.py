"""The figure of refinement: every number is drawn, nothing is cut or overlaps."""

import drawn_layout
import numpy as np
import pytest
import xarray as xr

from replication.figures import figure_convergence


def dataset(rows):
    return xr.Dataset({name: ("run", [row[name] for row in rows]) for name in rows[0]})


def sequence(refined, values, height, **fixed):
    usual = {
        "n_x": 800, "n_y": 8, "longest_step": 0.1, "tolerance": 1e-2, "kind": "normal_load",
        "strength": 1e-5, "seed": 1, "evolution": "aging", "initial_state": 1.0,
        "fault": f"{height}{fixed.get('initial_state')}", "block_length": 6.0,
        "critical_length": 1.5,
    }  # fmt: skip
    for i, value in enumerate(values):
        error = 0.1 * 0.1**i if i + 1 < len(values) else 0.0
        yield {
            **usual, **fixed, refined: value, "refinement": refined, "height": height,
            "length_over_theory": 0.7 - error, "length_difference": -error,
            "onset_difference": error / 3.0,
        }  # fmt: skip


@pytest.fixture
def refinements():
    rows = []
    for height, law, age in ((0.005, "aging", 1.0), (0.02, "aging", 1.0), (0.1, "aging", 1.0),
                             (0.02, "slip", 1.0), (0.1, "aging", 1e3)):  # fmt: skip
        own = {"evolution": law, "initial_state": age}
        rows += sequence("n_x", [400, 800, 1600], height, **own)
        rows += sequence("n_y", [8, 16], height, **own)
        rows += sequence("longest_step", [0.1, 0.05, 0.02], height, **own)
        rows += sequence("tolerance", [1e-2, 2.5e-3], height, **own)
    rows += sequence("n_x", [400, 800, 1600], 0.02, kind="state", longest_step=0.05)
    quiet = {"kind": "none", "strength": 0.0, "seed": 0, "longest_step": 0.02}
    for height in (0.005, 0.02):
        rows += sequence("n_x", [400, 800, 1600], height, **quiet)
    rows += sequence("longest_step", [0.1, 0.04, 0.02], 0.02, **quiet)
    return dataset(rows)


@pytest.fixture
def convergence(refinements):
    return figure_convergence.draw(refinements)


@pytest.mark.slow
def test_text_is_legible_and_neither_overlaps_nor_is_cut(convergence):
    drawn_layout.require_legible(convergence)


def drawn_at(axes):
    """Places and values of the markers of an axes."""
    return sorted(
        (round(float(x), 2), float(y))
        for line in axes.get_lines()
        for x, y in line.get_xydata()
        if np.isfinite(y)
    )


@pytest.mark.parametrize(("panel", "name"), [(0, "onset_difference"), (1, "length_difference")])
def test_every_perturbed_run_but_the_finest_is_a_point_at_its_fault_or_kind(
    refinements, convergence, panel, name
):
    axes = convergence.axes[panel]
    labels = ["0.005", "0.02", "0.1", "0.1 older", "0.02 slip", "all, state"]
    words = [text.get_text() for text in axes.get_xticklabels()]
    assert panel == 0 or words == labels  # the upper panel has none of its own
    declared = refinements.isel(run=np.flatnonzero(refinements["kind"].values != "none"))
    points = drawn_at(axes)
    assert len(points) == np.count_nonzero(declared[name])
    for place, rows in enumerate(figure_convergence.places(declared).values()):
        own = 100.0 * np.abs(rows[name].values)
        near = [y for x, y in points if abs(x - place) < 0.5]
        np.testing.assert_allclose(sorted(near), sorted(own[own > 0.0]))


def test_runs_that_agree_are_drawn_at_the_edge(refinements):
    same = refinements.assign(onset_difference=0.0 * refinements["onset_difference"])
    axes = figure_convergence.draw(same).axes[0]
    assert {y for _, y in drawn_at(axes)} == {figure_convergence.LEAST}


@pytest.mark.parametrize(("panel", "refined"), [(2, "n_x"), (3, "longest_step")])
def test_quiet_runs_are_dashed_beside_perturbed_ones(refinements, convergence, panel, refined):
    axes = convergence.axes[panel]
    for dash, kind in (("--", "none"), ("-", "normal_load")):
        lines = [line for line in axes.get_lines() if line.get_linestyle() == dash]
        drawn = {tuple(point) for line in lines for point in line.get_xydata()}
        rows = refinements.to_dataframe()
        rows = rows[(rows["refinement"] == refined) & rows["height"].isin([0.005, 0.02])]
        rows = rows[rows["kind"].eq(kind) & rows["evolution"].eq("aging")]
        size = rows["n_x"] / 4.0 if refined == "n_x" else rows[refined]  # of elements, within L_c
        assert drawn == set(zip(size, rows["length_over_theory"], strict=True))
    if refined == "longest_step":
        assert axes.get_xlim()[0] > axes.get_xlim()[1]
