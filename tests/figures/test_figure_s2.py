"""Figure S2: the space-time image on its true times, and the driving force."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.collections import QuadMesh

from nucleation.pictures import run
from nucleation.run.run import PAPER_RUN


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
    [("force", 7.2e4, 72.0, "kN/m"), ("force", 5.0, 5.0, "N/m"), ("force", 3e7, 30.0, "MN/m"),
     ("force", 1e-30, 1e-21, "nN/m"), ("force", 0.0, 0.0, "N/m"), ("time", 2e-3, 2.0, "ms"),
     ("time", 16.0, 16.0, "s"), ("time", 10800.0, 3.0, "h"), ("time", 864000.0, 10.0, "days"),
     ("time", 3.15576e8, 10.0, "years")],
)  # fmt: skip
def test_units_follow_the_size_of_the_data(unit_of, largest, shown, name):
    scale, unit = run.prefixed(largest, "N/m") if unit_of == "force" else run.time_unit(largest)
    assert scale * largest == pytest.approx(shown) and unit == name
