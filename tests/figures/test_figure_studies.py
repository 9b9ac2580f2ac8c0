"""The figure of any study: its form by what is varied, its numbers, its labels."""

from dataclasses import asdict

import drawn_layout
import numpy as np
import pytest
import xarray as xr

from nucleation.run.names import parameters
from replication.figures import figure_studies


def table(theory, length):
    theory, length = np.asarray(theory, dtype=float), np.asarray(length, dtype=float)
    columns = {
        "length": length,
        "length_low": 0.9 * length,
        "length_high": 1.2 * length,
        "critical_length": theory,
    }
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


def draw(theory, length, **varied):
    entries = {name: asdict(parameters()[name]) for name in varied}
    return figure_studies.draw(table(theory, length), varied, entries, {})


def points(figure):
    return {tuple(p) for axes in figure.axes for line in axes.lines for p in line.get_xydata()}


def test_one_number_is_a_curve():
    heights, theory, length = [0.1, 0.01, 0.03], [0.9, 0.3, 0.5], [0.8, 0.2, 0.4]
    figure = draw(theory, length, height=heights)
    (axes,) = figure.axes
    assert axes.get_xlabel() == "Height $H$ (m)"
    curve = next(line for line in axes.lines if line.get_label() == "theory")
    np.testing.assert_array_equal(curve.get_xdata(), sorted(heights))
    np.testing.assert_array_equal(curve.get_ydata(), sorted(theory))
    assert set(zip(heights, length, strict=True)) < points(figure)
    bars = sorted(bar[:, 1].tolist() for bar in axes.collections[0].get_segments())
    np.testing.assert_allclose(bars, sorted([0.9 * x, 1.2 * x] for x in length))


@pytest.mark.parametrize(
    ("theory", "curves"),
    [([1, 2, 1.1, 2.1], {"theory, a", "theory, b"}), ([1, 2, 1, 2], {"theory"})],
)
def test_words_tell_curves_apart(theory, curves):
    figure = draw(theory, [0.8, 1.7, 0.9, 1.8], height=[1, 2, 1, 2], evolution=list("aabb"))
    labels = figure.axes[0].get_legend_handles_labels()[1]
    assert set(labels) == {"simulation, a", "simulation, b"} | curves


def test_theory_is_a_smooth_curve_where_it_is_given():
    x = np.linspace(1.0, 2.0, 81)
    given = {"height": [1.0, 2.0]}, {"height": asdict(parameters()["height"])}
    theory = {"": {"x": x, "length": np.sqrt(x)}}
    axes = figure_studies.draw(table([1, 1.4], [0.9, 1.3]), *given, theory).axes[0]
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), np.sqrt(x))


def test_two_numbers_on_a_grid_are_maps():
    x, y = np.meshgrid([0.01, 0.1, 1.0], [0.5, 1.0, 2.0])
    theory, length = np.arange(1.0, 10.0), np.array([0.5, 1, 2, 3, 4, 5, 6, 7, np.nan])
    figure = draw(theory, length, height=x.ravel().tolist(), zeta_over_a=y.ravel().tolist())
    left, right, *_ = figure.axes
    assert left.get_ylabel() == r"Weakening over direct effect $\zeta/a$"
    for axes, values in ((left, length), (right, length / theory)):
        image = axes.collections[0].get_array()
        np.testing.assert_allclose(image.filled(np.nan).ravel(), values)
    assert (1.0, 2.0) in points(figure)  # marked: no event
    figure.canvas.draw()


def test_two_values_of_a_second_number_are_two_curves():
    x, y = np.meshgrid([0.01, 0.1], [1.0, 2.0])
    figure = draw(
        [1, 2, 3, 4], [0.5, 1, 2, 3], height=x.ravel().tolist(), zeta_over_a=y.ravel().tolist()
    )
    (axes,) = figure.axes
    assert axes.get_xlabel() == "Height $H$ (m)"
    told = axes.get_legend_handles_labels()[1]
    assert {r"simulation, $\zeta/a=1$", r"theory, $\zeta/a=2$"} < set(told)


def test_three_numbers_are_points_about_equality():
    figure = draw(
        [1, 2, 3], [0.9, 1.6, np.nan], height=[1, 2, 3], n_x=[8, 9, 9], initial_state=[1, 1, 2]
    )
    axes, strip = figure.axes
    assert {(1.0, 0.9), (2.0, 1.6)} < points(figure)
    assert strip.get_xlabel() == "Theory's critical length $L_c$ (m)"
    assert axes.get_title("left") == "varied: height, elements along x, initial state"
    line = next(li for li in figure.axes[0].lines if li.get_label() == "equality")
    np.testing.assert_array_equal(line.get_xdata(), line.get_ydata())


def test_numbers_off_a_grid_and_single_runs_are_points():
    for figure in (
        draw([1, 2], [0.9, 1.6], height=[1, 2], initial_state=[1, 2]),
        draw([1.0], [0.9]),
    ):
        assert figure.axes[0].get_xlabel() == "Theory's critical length $L_c$ (m)"


def test_two_faults_never_share_a_marker():
    """Few faults of several numbers are told apart, and nine evolution laws."""
    varied = {"height": [0.004, 0.01, 0.01], "initial_state": [1, 1, 2], "n_x": [8, 9, 9]}
    axes = draw([1, 2, 3], [0.9, 1.6, 2.5], **varied).axes[0]
    labels = axes.get_legend_handles_labels()[1]
    assert "simulation, $H=0.004$ m, $\\phi_0=1$ s" in labels and len(labels) == 4
    axes = draw(range(1, 10), range(1, 10), height=[1] * 9, evolution=list("abcdefghi")).axes[0]
    looks = {(c[0].get_marker(), c[0].get_color()) for c in axes.containers}
    assert len(looks) == 9


def test_study_in_which_nothing_happens():
    axes, strip = draw([1, 2], [np.nan, np.nan], height=[1, 2]).axes
    assert axes.get_legend_handles_labels()[1] == ["theory"]
    assert [text.get_text() for text in strip.get_yticklabels()] == ["no event\n(2 of 2)"]


@pytest.mark.parametrize("numbers", [["height"], ["height", "n_x", "initial_state"]])
def test_runs_without_an_event_have_no_length(numbers):
    """They stood on the line of equality, or on the theory's curve."""
    values = {name: [1.0, 2.0, 4.0] for name in numbers}
    axes, strip = draw([1.0, 2.0, 3.0], [0.9, np.nan, 2.5], **values).axes
    curves = ("theory", "equality")
    shown = [line for line in axes.lines if line.get_label() not in curves]
    assert 2.0 not in np.concatenate([line.get_xdata() for line in shown])
    lost = np.concatenate([line.get_xdata() for line in strip.lines])
    np.testing.assert_array_equal(lost, [2.0])


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["curve", "map", "points"])
def test_nothing_is_cut_or_overlaps(kind):
    heights = np.geomspace(0.005, 0.1, 5)
    varied = {"height": heights.tolist()}
    if kind == "map":
        x, y = np.meshgrid(heights, [1.0, 2.0, 4.0])
        varied = {"height": x.ravel().tolist(), "normal_stress": (1e6 * y).ravel().tolist()}
    if kind == "points":
        varied |= {"n_x": [100, 200, 300, 400, 500], "initial_state": [1.0, 2.0, 3.0, 4.0, 5.0]}
    size = len(varied["height"])
    figure = draw(np.linspace(1, 2, size), np.linspace(0.9, 1.5, size), **varied)
    drawn_layout.require_legible(figure)
    for legend in figure.legends:  # no run is under it
        assert legend.get_window_extent().y1 <= figure.axes[-1].get_window_extent().y0
