"""Figure 3: theory, points with error bars, the inset's snapshots, and markers by law."""

import drawn_layout
import numpy as np
import pytest
import xarray as xr
from matplotlib.collections import QuadMesh

from nucleation.pictures import run, style
from nucleation.run.run import PAPER_RUN
from replication.figures import figure_3, figure_patch, laws

THICK = "paper-7"  # the run in the inset


@pytest.fixture
def axes(theory, lengths, thick):
    return figure_3.draw(theory, lengths, thick, THICK).axes[0]


def points(axes):
    """Containers of error bars by their legend."""
    return {c.get_label(): c for c in axes.containers}


@pytest.mark.parametrize(
    ("label", "marker", "colour", "runs"),
    [
        ("FEM, aging law", "o", style.AGING, range(8)),
        ("FEM, slip law", "^", style.SLIP, (8, 9)),
        (r"FEM, aging law, $\phi(t\!=\!0)=10^{3}$ s", "s", style.OLD_AGE, (10,)),
    ],
)
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


@pytest.mark.parametrize(
    ("rows", "shown"),
    [
        ([("slip", 1.0), ("aging", 1.0), ("aging", 1e3)], [("aging", 1.0)]),
        ([("slip", 1.0), ("halfway", 1.0), ("slip", 5.0)], [("slip", 1.0)]),
        ([("slip", 7.0), ("halfway", 1.0), ("slip", 5.0)], [("slip", 7.0), ("slip", 5.0)]),
    ],
)
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


@pytest.fixture
def panels(thin, thin_row):
    return run.draw(thin, thin_row).axes[:4]


def mesh_of(axes):
    (mesh,) = [c for c in axes.collections if isinstance(c, QuadMesh)]
    return mesh


def peak_time(simulation):
    return float(simulation["step_time"][simulation["maximal_slip_rate"].values.argmax()])


@pytest.mark.parametrize(("column", "unit"), [(0, 1.0), (1, 1e-3)])
def test_every_pixel_is_the_datasets_value_at_its_time_and_place(panels, thin, column, unit):
    mesh = mesh_of(panels[column])
    corners, values = mesh.get_coordinates(), mesh.get_array()
    origin = peak_time(thin) if column else 0.0
    left, right = corners[0, :-1, 0] * unit + origin, corners[0, 1:, 0] * unit + origin
    ratio = thin["shear_stress"].values / 1e6
    time, x = thin["time"].values, thin["x"].values
    assert values.shape[0] <= x.size and values.shape[1] <= time.size
    for j in range(0, values.shape[1], 7):
        inside = (time >= left[j] - 1e-9) & (time <= right[j] + 1e-9)
        candidates = ratio[inside][:, : values.shape[0]]
        assert np.isclose(candidates, values[:, j], rtol=1e-12, atol=0).all(axis=1).any()
    np.testing.assert_allclose(corners[1:-1, 0, 1], (x[1:] + x[:-1])[: len(values) - 1] / 2)


def test_force_is_the_datasets_with_the_sign_of_a_compression(panels, thin):
    whole, event = (axes.get_lines()[0] for axes in panels[2:])
    np.testing.assert_array_equal(whole.get_xdata(), thin["step_time"])
    np.testing.assert_allclose(whole.get_ydata(), -thin["driving_force"] / 1e3, rtol=1e-14)
    np.testing.assert_allclose(event.get_xdata(), (thin["step_time"] - peak_time(thin)) * 1e3)
    x, (left, right) = event.get_xdata(), panels[3].get_xlim()
    seen = event.get_ydata()[(x >= left) & (x <= right)]
    low, high = panels[3].get_ylim()
    assert seen.size > 20 and low < seen.min() and seen.max() < high
    assert "(kN/m)" in panels[2].get_ylabel() and "(ms)" in panels[3].get_xlabel()
    assert "(m)" in panels[0].get_ylabel() and "(s)" in panels[2].get_xlabel()


def test_panels_share_their_axes_and_mark_onset_and_length(panels, thin, thin_row):
    image, zoom, force, _ = panels
    assert image.get_xlim() == force.get_xlim() == (0.0, 16.0)
    assert image.get_ylim() == zoom.get_ylim()
    length, onset = (line.get_xydata() for line in image.get_lines()[:2])
    assert set(length[:, 1]) == {float(thin_row["length"])}
    assert set(onset[:, 0]) == {float(thin_row["onset_time"])}
    (bar,) = image.containers[0][2][0].get_segments()
    limits = [float(thin_row[key]) for key in ("length_low", "length_high")]
    np.testing.assert_allclose(bar[:, 1], limits, rtol=1e-12)
    start, end = zoom.get_xlim()
    assert -10.0 < start < 0.0 < end < 10.0  # ms about the highest slip rate


def test_an_event_is_a_step_at_its_time_though_output_is_sparse_before():
    time = np.concatenate([[0.0, 6.0, 12.0], 13.0 + 1e-4 * np.arange(500), [14.0, 16.0]])
    kept = run.thin(time, 0.0, 16.0, 400)
    assert np.isclose(time[kept], 13.0).any() and kept.size < 10
    assert kept[0] == 0 and (np.diff(kept) > 0).all()
    assert np.diff(time[kept[:-1]]).min() >= 0.5 * 16.0 / 400


def test_only_what_slipped_is_shown(thin):
    x = thin["x"].values
    slip = np.where(x < 0.3 * x[-1], 1e-4, 0.0)
    slip[-3:] = 1e-4  # the corner of the free edge slips at the start
    quiet = thin.assign(slip=thin["slip"].copy(data=np.tile(slip, (thin.sizes["time"], 1))))
    assert 0.35 * x[-1] < run.slipped_extent(quiet) < 0.45 * x[-1]
    all_slipped = quiet.assign(slip=quiet["slip"] * 0.0 + 1e-4)
    assert run.slipped_extent(all_slipped) == x[-1]


def test_the_zoom_takes_the_first_event_only():
    time = np.linspace(0.0, 10.0, 10001)
    rate = 1e-5 + 0.1 * (np.abs(time - 5.002) < 2.1e-3) + 0.1 * (np.abs(time - 8.0) < 2.1e-3)
    record = xr.Dataset({"step_time": ("step", time), "maximal_slip_rate": ("step", rate)})
    record.attrs["parameters"] = PAPER_RUN.to_json()
    start, peak, end = run.event_window(record, 5.0)
    assert 4.99 < start < 5.0 <= peak <= 5.004 < end < 5.01


def test_a_record_without_an_onset_is_drawn(thin):
    row = xr.Dataset(dict.fromkeys(("onset_time", "length", "length_low", "length_high"), np.nan))
    figure = run.draw(thin, row)
    assert len(figure.axes) == 5


@pytest.mark.parametrize(
    ("unit_of", "largest", "shown", "name"),
    [
        ("force", 7.2e4, 72.0, "kN/m"),
        ("force", 5.0, 5.0, "N/m"),
        ("force", 3e7, 30.0, "MN/m"),
        ("force", 1e-30, 1e-30, "N/m"),
        ("force", 2e-8, 20.0, "nN/m"),
        ("force", 2e-5, 20.0, "µN/m"),
        ("force", 0.0, 0.0, "N/m"),
        ("time", 2e-3, 2.0, "ms"),
        ("time", 16.0, 16.0, "s"),
        ("time", 10800.0, 3.0, "h"),
        ("time", 864000.0, 10.0, "days"),
        ("time", 3.15576e8, 10.0, "years"),
    ],
)
def test_units_follow_the_size_of_the_data(unit_of, largest, shown, name):
    scale, unit = run.prefixed(largest, "N/m") if unit_of == "force" else run.time_unit(largest)
    assert scale * largest == pytest.approx(shown) and unit == name
