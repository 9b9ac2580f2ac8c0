"""The film of a run and the animation drawn from it."""

from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from nucleation.analysis import film
from nucleation.fem.grid import Grid
from nucleation.figures.beyond import animation

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def filmed(simulation, table):
    return film.film_dataset(simulation, table.isel(run=0))


def test_shear_stress_of_a_known_displacement():
    """Bilinear along x and linear along y on a graded mesh: the differences are exact."""
    grid = Grid(2.0, 0.5, 8, 6, 3.0)
    x, y = np.meshgrid(grid.x, grid.y)
    body = SimpleNamespace(grid=grid, nodal_values=lambda field: (3.0 * y * (1.0 + x), 5.0 * x))
    stress = film.shear_stress(body, SimpleNamespace(displacement=None), 7.0)
    np.testing.assert_allclose(stress, 7.0 * (3.0 * (1.0 + x) + 5.0), rtol=1e-12)


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


def test_film_shows_twice_the_critical_length_and_the_event(filmed, table):
    length, onset = (float(table[name][0]) for name in ("length", "onset_time"))
    assert filmed["x"].max() <= 2.0 * length < filmed["x"].max() + 0.1 * length
    assert filmed["time"][0] == 0.0 and filmed["time"][-1] > onset
    assert filmed.sizes["time"] <= sum(film.MOST_FRAMES)


def test_animation_has_a_picture_for_every_moment(filmed, table, tmp_path):
    few = filmed.isel(time=[0, 20, 40])
    path = tmp_path / "animation.gif"
    animation.save(animation.frames(few, table.isel(run=0)), path)
    with Image.open(path) as saved:
        assert saved.n_frames == 3
        assert saved.convert("RGB").getpixel((1, 1)) == (255, 255, 255)
