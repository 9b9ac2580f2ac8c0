"""The film of a run and the animation drawn from it."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from PIL import Image

from nucleation.fem.grid import Grid
from nucleation.model.material import Material
from nucleation.model.parameters import Parameters
from nucleation.simulation.run import simulate
from replication.figures import film
from replication.figures.beyond import animation

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def filmed(simulation, table):
    return film.film_dataset(simulation, table.isel(run=0))


def test_shear_stress_of_a_known_displacement():
    """Bilinear along x and linear along y on a graded mesh: the differences are exact."""
    grid = Grid(2.0, 0.5, 8, 6, 3.0)
    x, y = np.meshgrid(grid.x, grid.y)
    body = SimpleNamespace(
        grid=grid, grid_below=None, nodal_values=lambda field: (3.0 * y * (1.0 + x), 5.0 * x)
    )
    still = SimpleNamespace(displacement=None)
    stress = film.shear_stress(body, still, [Material(shear_modulus=7.0)])
    np.testing.assert_allclose(stress, 7.0 * (3.0 * (1.0 + x) + 5.0), rtol=1e-12)
    # with a body below, whose nodes are counted downwards, the same field gives its own stress
    below = Grid(2.0, 0.3, 8, 4, 2.0)
    x2, y2 = np.meshgrid(below.x, -below.y)
    body.grid_below = below
    body.nodal_values_below = lambda field: (3.0 * y2 * (1.0 + x2), 5.0 * x2)
    materials = [Material(shear_modulus=7.0), Material(shear_modulus=2.0)]
    both = film.shear_stress(body, still, materials)
    heights, rows = film.levels(body)
    assert both.shape == (12, 9) and heights.shape == (12,)
    np.testing.assert_array_equal(both[5:], stress)
    np.testing.assert_allclose(both[:5], np.tile(2.0 / 7.0 * stress[:1], (5, 1)), rtol=1e-12)
    np.testing.assert_allclose(heights[[0, 4, 5, 11]], [-0.3, 0.0, 0.0, 0.5])
    assert rows.tolist() == list(range(12))


@pytest.mark.parametrize("velocity", [1e-5, 1e-8])
def test_the_event_is_shown_for_a_memory_time_to_either_side(velocity):
    parameters = Parameters().replaced({"velocity": velocity})
    memory_time = parameters.memory_time
    time = memory_time * np.linspace(0.0, 100.0, 1001)
    rate = velocity * (1.0 + 1e3 * (np.arange(1001) == 520))
    record = xr.Dataset(
        {"step_time": ("step", time), "maximal_slip_rate": ("step", rate)},
        attrs={"parameters": parameters.to_json()},
    )
    begin, end = film.event_interval(record, 50.0 * memory_time)
    assert begin == pytest.approx(49.0 * memory_time) and end == pytest.approx(53.0 * memory_time)


def test_film_is_of_the_same_run(filmed, simulation, table):
    """Within the patch the stress beside the interface is near that of the interface, and the
    free side has next to none."""
    recorded = simulation.sel(time=filmed["time"], x=filmed["x"])
    np.testing.assert_array_equal(filmed["slip_rate"], recorded["slip_rate"])
    patch = {"time": filmed["time"] < table["onset_time"].values[0], "x": slice(2, 7)}
    at_interface = recorded["shear_stress"].isel(patch).mean("x")
    beside = filmed["block_shear_stress"].isel(y=0).isel(patch).mean("x")
    crept = at_interface > 3e5  # Pa
    assert crept.sum() > 10
    np.testing.assert_allclose(beside[crept], at_interface[crept], rtol=0.15)
    top = np.abs(filmed["block_shear_stress"].isel(y=-1)).max()
    assert top < 0.3 * filmed["block_shear_stress"].max()


def test_animation_has_a_picture_for_every_moment(filmed, table, tmp_path):
    few = filmed.isel(time=[0, 20, 40])
    path = tmp_path / "animation.gif"
    animation.save(animation.frames(few, table.isel(run=0)), path, still=1)
    with Image.open(path) as saved:
        assert saved.n_frames == 4
        shown = []
        for number in range(4):
            saved.seek(number)
            shown.append(saved.convert("RGB").tobytes())
        assert shown[0] == shown[2] != shown[1]
        assert saved.convert("RGB").getpixel((1, 1)) == (255, 255, 255)


@pytest.fixture(scope="module")
def filmed_pair():
    """A pair of coarse blocks, a layer on one three times as stiff; too short for an event."""
    parameters = Parameters().replaced(
        {
            "height": 0.01, "length": 0.6, "n_x": 40, "n_y": 40, "end_time": 1.0,
            "second_body": "deformable", "second_height": 0.02, "second_n_y": 5,
            "second_shear_modulus": 9.3e9, "second_far_side": "clamped",
        }
    )  # fmt: skip
    record = simulate(parameters)
    row = xr.Dataset({"onset_time": np.nan, "length": 0.2})
    return record, film.film_dataset(record, row), row


def test_film_of_a_pair_shows_both_bodies(filmed_pair):
    """On either side the stress is that of the interface, so far as elements go."""
    record, filmed, _ = filmed_pair
    y, stress = filmed["y"].values, filmed["block_shear_stress"].values
    assert (y[0], y[-1]) == (-0.02, 0.01) and (y == 0.0).sum() == 2
    assert (np.diff(y) >= 0.0).all() and y.size == 6 + film.MOST_ROWS  # the upper one is thinned
    last = record["shear_stress"].sel(time=filmed["time"][-1], x=filmed["x"]).values
    within = slice(1, 4)
    assert last[within].mean() > 3e5
    for level in np.flatnonzero(y == 0.0):
        beside = stress[-1, level, within].mean()
        assert beside == pytest.approx(last[within].mean(), rel=0.3)
    assert np.abs(stress[-1, -1]).max() < 0.2 * last.max() < np.abs(stress[-1, 0]).max()


def test_animation_of_a_pair_has_both_bodies_and_the_interface(filmed_pair):
    _, filmed, row = filmed_pair
    figure, _ = animation._panels(filmed, row)
    block = figure.axes[1]
    assert block.get_ylim() == (-0.02, 0.01)
    assert len(block.collections) == 2  # filled contours of either body
    (interface,) = block.lines
    assert set(interface.get_ydata()) == {0.0}
    for image in animation.frames(filmed.isel(time=[0, -1]), row):
        assert image.size[1] > 0.7 * image.size[0]
