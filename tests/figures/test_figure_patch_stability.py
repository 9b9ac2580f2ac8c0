"""The figures of the patches' stability show their datasets, legibly."""

import drawn_layout
import numpy as np
import pytest
import xarray as xr

from nucleation.run.run import PAPER_RUN
from replication.figures import figure_3, figure_patch

HEIGHTS = np.array([0.005, 0.02, 0.1, 0.02, 0.1] * 2)
THEORY = 3.0 * np.sqrt(HEIGHTS)
X = np.linspace(0.0, 1.0, 101)


@pytest.fixture
def table():
    ratio = np.array([0.50] * 5 + [0.55] * 5)
    columns = {
        "role": ["paper"] * 5 + ["converged"] * 5,
        "height": HEIGHTS,
        "critical_length": THEORY,
        "evolution": ["aging", "aging", "aging", "slip", "aging"] * 2,
        "initial_state": [1.0, 1.0, 1.0, 1.0, 1e3] * 2,
        "stability_length": ratio * THEORY,
        "stability_length_low": (ratio - 0.01) * THEORY,
        "stability_length_high": (ratio + 0.02) * THEORY,
    }
    return xr.Dataset({name: ("run", np.asarray(values)) for name, values in columns.items()})


@pytest.fixture
def patches(table):
    """Growth from -3 to 3 and a mode of half a wave, phase turned, for each run."""
    made = []
    for theory, length in zip(THEORY, table["stability_length"].values, strict=True):
        shape = np.where(length > X, np.sin(np.pi * X / length), 0.0) * np.exp(0.4j)
        columns = {
            "patch_length": ("instant", theory * np.linspace(0.1, 0.9, 30)),
            "oscillation_growth": ("instant", np.linspace(-3.0, 3.0, 30)),
            "oscillation_frequency": ("instant", np.linspace(17.0, 9.0, 30)),
            "instant_time": ("instant", np.linspace(1.0, 30.0, 30)),
            "stability_frequency": 2.0 * np.pi,  # 1/s: periods of a second
            "mode_real": ("x", shape.real),
            "mode_imaginary": ("x", shape.imag),
        }
        attributes = {"parameters": PAPER_RUN.to_json()}
        made.append(xr.Dataset(columns, coords={"x": X}, attrs=attributes))
    return made


@pytest.fixture
def drawn(table, patches):
    return figure_patch.draw_stability(table, patches)


@pytest.fixture
def extended(theory, lengths, table):
    return figure_3.draw_extended(theory, lengths, table)


def test_growth_frequency_and_modulus_of_the_mode_of_the_converged_runs(drawn):
    for axes, first in zip(drawn.axes[:2], (-3.0, 17.0), strict=True):
        clouds = [line for line in axes.lines if line.get_marker() == "."]
        late = [li for li in axes.lines if li.get_marker() == "x" and li.get_xdata().size]
        assert len(clouds) == len(late) == 3
        for line, last in zip(clouds, late, strict=True):
            assert last.get_xdata().size == 4  # instants in the last four periods
            x = np.append(line.get_xdata(), last.get_xdata())
            np.testing.assert_allclose(x, np.linspace(0.1, 0.9, 30))
            assert line.get_ydata()[0] == first
    modes = [line for line in drawn.axes[2].lines if len(line.get_xdata()) == X.size]
    assert len(modes) == 3
    for line in modes:
        x, y = line.get_data()
        np.testing.assert_allclose(y[x < 1], np.sin(np.pi * x[x < 1]), atol=1e-12)


def test_extended_figure_has_all_lengths(extended, theory, lengths, table):
    left, right = extended.axes
    for part, line in zip((1.0, 0.5), left.lines, strict=False):
        np.testing.assert_array_equal(line.get_ydata(), part * theory["critical_length"])
    for axes, scale_lengths, scale_table in (
        (left, 1.0, 1.0),
        (right, lengths["critical_length"].values, THEORY),
    ):
        points = {tuple(p) for c in axes.containers for p in np.transpose(c.lines[0].get_data())}
        drops = zip(lengths["height"].values, lengths["length"].values / scale_lengths, strict=True)
        assert {point for point in drops if np.isfinite(point[1])} <= points
        values = table["stability_length"].values / scale_table
        grown = zip(HEIGHTS[5:], np.broadcast_to(values, HEIGHTS.shape)[5:], strict=True)
        assert set(grown) <= points
    bars = [c.lines[2][0] for c in right.containers if c.lines[2] and "unstable" in c.get_label()]
    ends = np.concatenate([[segment[:, 1] for segment in bar.get_segments()] for bar in bars])
    np.testing.assert_allclose(ends, np.broadcast_to([0.54, 0.57], ends.shape))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["drawn", "extended"])
def test_figures_are_legible(name, request):
    figure = request.getfixturevalue(name)
    drawn_layout.require_legible(figure)
    assert all(axes.get_xlabel() and axes.get_ylabel() for axes in figure.axes)
