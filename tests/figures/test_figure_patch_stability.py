"""The companion figure of the patches' stability shows its datasets."""

import numpy as np
import pytest
import xarray as xr

from nucleation.figures import figure_patch_stability

HEIGHTS = np.array([0.005, 0.02, 0.1, 0.02, 0.1])
THEORY = np.array([0.2, 0.4, 0.8, 0.4, 0.8])


@pytest.fixture
def drawn():
    common = {
        "law": ("run", ["aging", "aging", "aging", "slip", "aging"]),
        "height": ("run", HEIGHTS),
        "phi0": ("run", [1.0, 1.0, 1.0, 1.0, 1e3]),
        "theory_length": ("run", THEORY),
    }
    lengths = xr.Dataset({**common, "length": ("run", 0.8 * THEORY)})
    table = xr.Dataset(
        {
            **common,
            "stability_length": ("run", 0.5 * THEORY),
            "stability_length_low": ("run", 0.45 * THEORY),
            "stability_length_high": ("run", 0.6 * THEORY),
        }
    )
    patches = [
        xr.Dataset(
            {
                "patch_length": ("instant", length * np.linspace(0.1, 0.9, 30)),
                "growth_rate": ("instant", np.linspace(-1.0, 1.0, 30)),
            }
        )
        for length in THEORY
    ]
    return figure_patch_stability.draw(lengths, table, patches)


def test_growth_of_the_usual_runs(drawn):
    clouds = [line for line in drawn.axes[0].lines if line.get_xdata().__len__() == 30]
    assert len(clouds) == 3
    for line in clouds:
        np.testing.assert_allclose(line.get_xdata(), np.linspace(0.1, 0.9, 30))
        np.testing.assert_allclose(line.get_ydata(), np.linspace(-1.0, 1.0, 30))


def test_ratios_and_their_error_bars(drawn):
    axes = drawn.axes[1]
    labels = axes.get_legend_handles_labels()[1]
    assert labels == ["aging law", "slip law", "aging law, older interface"]
    for container in axes.containers:
        np.testing.assert_allclose(container.lines[0].get_ydata(), 0.5)
        for low, high in (bar[:, 1] for bar in container.lines[2][0].get_segments()):
            assert (low, high) == (pytest.approx(0.45), pytest.approx(0.6))
    drops = [line for line in axes.lines if line.get_label() in labels]
    heights = np.concatenate([line.get_xdata() for line in drops])
    np.testing.assert_allclose(np.sort(heights), np.sort(HEIGHTS))
    assert all(np.allclose(line.get_ydata(), 0.8) for line in drops)


def test_axes_have_labels_with_units(drawn):
    for axes in drawn.axes:
        assert axes.get_xlabel()
        assert axes.get_ylabel()
    assert "1/s" in drawn.axes[0].get_ylabel()
