"""Figure 3: theory, points with error bars, the inset's snapshots, and markers by law."""

import drawn_layout
import numpy as np
import pytest
import xarray as xr

from nucleation.pictures import style
from replication.figures import figure_3, figure_patch, laws

THICK = "paper-7"  # the run in the inset


@pytest.fixture
def axes(theory, lengths, thick):
    return figure_3.draw(theory, lengths, thick, THICK).axes[0]


def points(axes):
    """Containers of error bars by their legend."""
    return {c.get_label(): c for c in axes.containers}


@pytest.mark.parametrize(("label", "marker", "colour", "runs"), [
    ("FEM, aging law", "o", style.AGING, range(8)),
    ("FEM, slip law", "^", style.SLIP, (8, 9)),
    (r"FEM, aging law, $\phi(t\!=\!0)=10^{3}$ s", "s", style.OLD_AGE, (10,)),
])  # fmt: skip
def test_points_and_error_bars(axes, lengths, label, marker, colour, runs):
    expected = lengths.isel(run=list(runs))
    line, _, (bars,) = points(axes)[label]
    np.testing.assert_array_equal(line.get_xdata(), expected["height"])
    np.testing.assert_array_equal(line.get_ydata(), expected["length"])
    assert (line.get_marker(), line.get_color()) == (marker, colour)
    ends = np.array([segment[:, 1] for segment in bars.get_segments()])
    np.testing.assert_allclose(ends[:, 0], expected["length_low"], rtol=1e-12)
    np.testing.assert_allclose(ends[:, 1], expected["length_high"], rtol=1e-12)


def test_runs_without_a_length_and_unknown_studies_are_left_out(theory, lengths, thick, axes):
    assert len(points(axes)) == 3  # the run without a length has added none
    assert sum(len(c[0].get_xdata()) for c in points(axes).values()) == 11
    other = lengths.assign(role=("run", np.full(lengths.sizes["run"], "own")))
    drawn = figure_3.draw(theory, other, thick, THICK)
    assert not drawn.axes[0].containers


def test_all_points_lie_within_the_axes_and_outside_the_inset(axes, lengths):
    drawn_layout.boxes(axes.figure)
    (inset,) = axes.child_axes
    box = inset.get_tightbbox()
    usable = lengths.where(np.isfinite(lengths["length"]), drop=True)
    for name in ("length", "length_low"):
        inside = drawn_layout.points_inside(axes, usable["height"], usable[name], axes.bbox)
        assert inside == usable.sizes["run"]
        assert drawn_layout.points_inside(axes, usable["height"], usable[name], box) == 0


def test_inset_shows_the_slip_rate_from_creep_to_just_after_the_onset(axes, thick, thick_row):
    (inset,) = axes.child_axes
    onset = float(thick_row["onset_time"])
    creep, event = figure_3.choose_times(thick, onset)
    times = thick["time"].values
    np.testing.assert_allclose(times[creep] / onset, [0.25, 0.5, 0.75, 1.0], atol=0.01)
    assert (times[event] > onset).all() and (times[event] < onset + 0.01).all()
    largest = thick["slip_rate"].max("x").values[[creep[-1], *event]]
    assert (np.diff(largest) > 0).all() and largest[-1] > 100 * largest[0]
    curves = [line for line in inset.get_lines() if len(line.get_xdata()) > 2]
    assert len(curves) == creep.size + event.size == 6
    for line, i in zip(curves, [*creep, *event], strict=True):
        np.testing.assert_array_equal(line.get_xdata(), thick["x"])
        np.testing.assert_array_equal(line.get_ydata(), thick["slip_rate"].isel(time=i))
    assert inset.get_yscale() == "log" and "(m/s)" in inset.get_ylabel()
    length = float(thick_row["length"])
    assert any(set(line.get_xdata()) == {length} for line in inset.get_lines())
    onset = times[creep[-1]]
    later = [1e3 * (times[i] - onset) for i in event]
    texts = [text.get_text() for text in inset.get_legend().get_texts()]
    assert texts[3:] == [f"$t_c={onset:.1f}$ s"] + [f"$t_c+{t:.3g}$ ms" for t in later]


def test_a_run_without_an_event_is_drawn_without_marks(theory, lengths, thick):
    still = thick.isel(time=slice(0, 60))
    shown = lengths["id"] == THICK
    unknown = {name: lengths[name].where(~shown) for name in ("onset_time", "length")}
    (inset,) = figure_3.draw(theory, lengths.assign(unknown), still, THICK).axes[0].child_axes
    assert len([line for line in inset.get_lines() if len(line.get_xdata()) > 2]) == 4
    assert not inset.texts


def test_marks_of_one_height_stand_side_by_side(axes):
    """Those of other laws and older interfaces were drawn upon the usual ones."""
    usual = axes.transData.transform([[0.05, 0.5]])[0]
    moved = {}
    for container in axes.containers:
        line, _, (bars,) = container
        moved[container.get_label()] = line.get_transform().transform([[0.05, 0.5]])[0] - usual
        at = bars.get_transform().transform([[0.05, 0.5]])[0] - usual
        np.testing.assert_allclose(at, moved[container.get_label()])
    assert moved["FEM, aging law"].tolist() == [0.0, 0.0]
    assert len({round(float(x)) for x, _ in moved.values()}) == len(moved)


def table(*rows):
    law, initial_state = zip(*rows, strict=True)
    columns = {"evolution": ("run", list(law)), "initial_state": ("run", list(initial_state))}
    return xr.Dataset(columns)


def test_every_law_has_a_look_of_its_own():
    names = ["slip", "halfway", "my_law", "aging", "slip"]
    found = list(laws.kinds(table(*((name, 1.0) for name in names), ("slip", 5.0))))
    labels = ["aging law", "slip law", "slip law", "halfway law", "my law law"]
    assert [name for name, *_ in found] == labels
    assert [old for _, old, *_ in found] == [False, False, True, False, False]
    assert len({(marker, colour) for *_, (marker, _, colour, _), _ in found}) == 5


@pytest.mark.parametrize(("rows", "shown"), [
    ([("slip", 1.0), ("aging", 1.0), ("aging", 1e3)], [("aging", 1.0)]),
    ([("slip", 1.0), ("halfway", 1.0), ("slip", 5.0)], [("slip", 1.0)]),
    ([("slip", 7.0), ("halfway", 1.0), ("slip", 5.0)], [("slip", 7.0), ("slip", 5.0)]),
])  # fmt: skip
def test_what_is_shown_where_one_law_is(rows, shown):
    found = figure_patch.shown(table(*rows).assign(role=("run", ["own"] * 3)))
    assert list(zip(found["evolution"].values, found["initial_state"].values, strict=True)) == shown


def test_other_laws_are_drawn(theory, lengths, thick):
    """The paper's lengths as if they were of laws that the paper does not have."""
    names = {"aging": "halfway", "slip": "third"}
    law = [names[law] for law in lengths["evolution"].values]
    others = lengths.assign(evolution=("run", law))
    axes = figure_3.draw(theory, others, thick, THICK).axes[0]
    assert {"FEM, halfway law", "FEM, third law"} <= set(points(axes))
    assert sum(len(c[0].get_xdata()) for c in axes.containers) == 11  # all that have a length
    columns = ("length", "length_low", "length_high")
    patches = others.rename({name: f"stability_{name}" for name in columns})
    left, right = figure_3.draw_extended(theory, others, patches).axes
    assert "halfway law" in [text.get_text() for text in right.get_legend().get_texts()]
    assert len(left.containers) > 3
    assert set(figure_patch.shown(patches)["evolution"].values) == {"halfway"}
