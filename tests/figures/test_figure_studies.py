"""The figure of any study: what is varied, its numbers, its labels."""

from dataclasses import fields

import drawn_layout
import numpy as np
import pytest
import xarray as xr
from matplotlib.mathtext import MathTextParser

from nucleation.fault.parameters import parameters
from nucleation.model.quantities import Quantity
from nucleation.run.derived import drop_of_run
from nucleation.run.run import Run
from replication.configuration.load import configure
from replication.configuration.studies import theory_curves
from replication.figures import figure_studies


def declared(name):
    """The declaration of a parameter, as the rule of the figure has it."""
    return {field.name: getattr(parameters()[name], field.name) for field in fields(Quantity)}


def table(theory, length):
    length = np.asarray(length, dtype=float)
    columns = {"length": length, "length_low": 0.9 * length, "length_high": 1.2 * length}
    columns["critical_length"] = np.asarray(theory, dtype=float)
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


def draw(theory, length, **varied):
    entries = {name: declared(name) for name in varied}
    return figure_studies.draw(table(theory, length), varied, entries, [])


def points(figure):
    return {tuple(p) for axes in figure.axes for line in axes.lines for p in line.get_xydata()}


def test_one_number_is_a_curve():
    heights, theory, length = [0.1, 0.01, 0.03], [0.9, 0.3, 0.5], [0.8, 0.2, 0.4]
    figure = draw(theory, length, height=heights)
    (axes,) = figure.axes
    assert axes.get_xlabel() == "Height $H$ (m)"
    curve = next(line for line in axes.lines if line.get_linewidth() == 1.0)
    np.testing.assert_array_equal(curve.get_xdata(), sorted(heights))
    np.testing.assert_array_equal(curve.get_ydata(), sorted(theory))
    assert set(zip(heights, length, strict=True)) < points(figure)
    bars = sorted(bar[:, 1].tolist() for bar in axes.collections[0].get_segments())
    np.testing.assert_allclose(bars, sorted([0.9 * x, 1.2 * x] for x in length))


def test_kinds_have_their_mark_and_curve():
    """Equal curves are seen, as their dashes differ; a study without numbers is over L_c."""
    for varied in ({"height": [1, 2, 1, 2]}, {}):
        kinds = {"evolution": list("aabb")}
        axes = draw([1, 2, 1, 2], [0.8, 1.7, 0.9, 1.8], **kinds, **varied).axes[0]
        labels = axes.get_legend_handles_labels()[1]
        assert list(dict.fromkeys(labels)) == ["$L_c$, theory", "simulation, a", "simulation, b"]
        first, second = (line for line in axes.lines if line.get_linewidth() == 1.0)
        assert first.get_linestyle() != second.get_linestyle()
        assert axes.get_xlabel()[:6] == ("Height" if "height" in varied else "Theory")


def along(values, **given):
    """The curve of a study over its heights, with runs at its two ends."""
    run = {"height": values, "n_x": 20, "n_y": 4, "end_time": 1.0, **given}
    made = configure({"studies": {"s": {"runs": [run]}}})
    (curve,) = theory_curves(list(made.runs), made)
    return {**curve, "between": [curve["between"][0], curve["between"][-1]]}


def lines(axes):
    """The theory's lines by their labels."""
    return {line.get_label(): line for line in axes.lines if line.get_linewidth() == 1.0}


@pytest.mark.slow
def test_lengths_of_theory_are_curves_of_their_own():
    """L_c is no prediction of L: the patch becomes unstable at L_s, and the force drops at L."""
    heights = [0.05, 0.1]
    given = {"height": heights}, {"height": declared("height")}
    curve = along(heights, perturbation="normal_load", strength=1e-4)
    axes = figure_studies.draw(table([0.7, 0.9], [0.5, 0.7]), *given, [curve]).axes[0]
    shown = lines(axes)
    critical = shown["$L_c$, theory"].get_xydata()
    np.testing.assert_allclose(critical.T, [curve["x"], curve["length"]])
    for end, parameters_of_end in zip((0, -1), curve["between"], strict=True):
        known = drop_of_run(Run.from_dict(parameters_of_end))
        stable = shown["$L_s$, theory"].get_ydata()[end]
        assert stable == pytest.approx(known.stability_length, rel=1e-3)
        assert shown["expected $L$ and its range"].get_ydata()[end] == known.length
        edges = axes.collections[0].get_paths()[0].vertices[:, 1]
        assert {known.low, known.high} < set(edges)


@pytest.mark.parametrize(
    "run",
    [
        {},
        {
            "perturbation": "state",
            "strength": 1e-4,
            "heterogeneity": "a",
            "change": 0.2,
            "n_x": 400,
        },
        {
            "perturbation": "state",
            "strength": 1e-4,
            "loading": "remote",
            "n_x": 401,
            "stress_rate": 1e4,
        },
    ],
    ids=["quiet", "varying along x", "under a remote load"],
)
def test_where_the_law_of_the_drop_does_not_apply_no_drop_is_expected(run):
    given = {"height": [0.05, 0.1]}, {"height": declared("height")}
    curve = along([0.05, 0.1], block_length=2.0, **run)
    axes = figure_studies.draw(table([0.7, 0.9], [0.5, 0.7]), *given, [curve]).axes[0]
    assert lines(axes).keys() == {"$L_c$, theory", "$L_s$, theory"}


def test_every_fault_is_drawn_where_many_numbers_vary():
    """More kinds than marks are named in the title; realisations of a fault share their mark."""
    many = list(range(1, 31))
    figure = draw(many, many, height=many, n_x=many, initial_state=many, seed=many)
    assert figure.axes[0].get_title("left") == "also varied: elements along x, initial state"
    assert set(zip(many, many, strict=True)) < points(figure)
    axes = draw([1, 1], [0.9, 0.8], seed=[1, 2]).axes[0]
    assert axes.get_legend_handles_labels()[1] == ["$L_c$, theory", "simulation"]


def test_two_faults_never_share_a_marker():
    """Few faults of several numbers are told apart, and nine evolution laws."""
    varied = {"height": [0.004, 0.01, 0.02], "initial_state": [1, 1, 2], "n_x": [8, 9, 9]}
    axes = draw([1, 2, 3], [0.9, 1.6, 2.5], **varied).axes[0]
    labels = axes.get_legend_handles_labels()[1]
    assert "simulation, $\\phi_0=1$ s, $N_x=8$" in labels and len(set(labels)) == 4
    axes = draw(range(1, 10), range(1, 10), height=[1] * 9, evolution=list("abcdefghi")).axes[0]
    looks = {(c[0].get_marker(), c[0].get_color()) for c in axes.containers}
    assert len(looks) == 9


@pytest.mark.parametrize("numbers", [["height"], ["height", "n_x", "initial_state"]])
def test_runs_without_an_event_are_crosses_at_the_edge(numbers):
    """They stood on the line of equality, or on the theory's curve."""
    values = {name: [1.0, 2.0, 4.0] for name in numbers}
    (axes,) = draw([1.0, 2.0, 3.0], [0.9, np.nan, 2.5], **values).axes
    assert 2.0 not in np.concatenate([c[0].get_xdata() for c in axes.containers])
    (lost,) = (line for line in axes.lines if line.get_marker() == "x")
    np.testing.assert_array_equal(lost.get_xdata(), [2.0])
    assert lost.get_label() == "no event (1 of 3)"
    labels = draw([1, 2], [np.nan, np.nan], height=[1, 2]).axes[0].get_legend_handles_labels()[1]
    assert labels == ["$L_c$, theory", "no event (2 of 2)"]


def test_every_symbol_can_be_typeset():
    found = {entry.symbol: figure_studies._symbol(entry) for entry in parameters().values()}
    for symbol in filter(None, found.values()):
        MathTextParser("path").parse(f"${symbol}$")
    assert (found["sigma0"], found["zeta/a"], found["L"]) == (r"\sigma_0", r"\zeta/a", "")


def test_large_and_small_values_are_powers_of_ten():
    """Mathematics makes a difference of 1e+06."""
    varied = {"height": [0.1, 0.2, 0.3], "normal_stress": [1e6, 1e6, 2.5e7]}
    labels = draw([1, 2, 3], [0.9, 1.6, 2.5], **varied).axes[0].get_legend_handles_labels()[1]
    assert r"simulation, $\sigma_0=10^{6}$ Pa" in labels
    assert r"simulation, $\sigma_0=2.5\times10^{7}$ Pa" in labels


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["curve", "grid", "points"])
def test_nothing_is_cut_or_overlaps(kind):
    varied = {"height": np.geomspace(0.005, 0.1, 5).tolist()}
    if kind == "points":
        varied |= {"n_x": [100, 200, 300, 400, 500], "initial_state": [1.0, 2.0, 3.0, 4.0, 5.0]}
    if kind == "grid":
        varied = {"height": [0.01, 0.1, 1.0, 9.0, 60.0] * 9}
        varied["zeta_over_a"] = np.repeat(np.arange(1, 10), 5).tolist()
    size = len(varied["height"])
    figure = draw(np.linspace(1, 2, size), np.linspace(0.9, 1.5, size), **varied)
    drawn_layout.require_legible(figure)
    for legend in figure.legends:  # no run is under it
        assert legend.get_window_extent().y1 <= figure.axes[0].get_window_extent().y0
