"""The crosscheck's figure shows both records."""

import drawn_layout
import numpy as np
import pytest
import xarray as xr

from nucleation.figures.checks import figure_crosscheck
from nucleation.model.parameters import Parameters

ONSETS = (10.0, 9.5)  # s


PAIR = {"second_body": "deformable", "second_shear_modulus": 6.2e9, "second_bottom": "clamped"}


def record(height, factor, **second):
    """A patch that grows like the root of time, with a force that follows it."""
    time, x = np.linspace(0.0, 11.0, 300), np.linspace(0.0, 1.0, 401)
    edge = factor * 0.1 * np.sqrt(time / 10.0)
    rate = 1e-5 * np.where(x < edge[:, None], 1.0, 1e-9)
    return xr.Dataset(
        {
            "slip_rate": (("time", "x"), rate),
            "step_time": ("step", time),
            "driving_force": ("step", -7e4 * factor * np.sqrt(time / 10.0)),
        },
        coords={"time": time, "x": x},
        attrs={"parameters": Parameters().replaced({"height": height, **second}).to_json()},
    )


@pytest.fixture
def drawn():
    table = xr.Dataset(
        {
            "onset_time": ("run", [ONSETS[0]] * 3),
            "onset_time_freefem": ("run", [ONSETS[1]] * 3),
            "length": ("run", [0.1] * 3),
            "length_freefem": ("run", [0.098] * 3),
        }
    )
    pairs = [(record(height, 1.0), record(height, 1.02)) for height in (0.005, 0.05)]
    pairs.append((record(0.02, 1.0, **PAIR), record(0.02, 1.03, **PAIR)))
    return figure_crosscheck.draw(pairs, table)


def test_curves(drawn):
    force = drawn.axes[3]
    assert [line.get_label() for line in force.lines] == ["this project", "FreeFem++"]
    np.testing.assert_allclose(force.lines[1].get_ydata(), 1.02 * force.lines[0].get_ydata())
    difference = drawn.axes[6].lines[1]
    assert difference.get_label() == "$f_d(t)$"
    np.testing.assert_allclose(difference.get_ydata(), 2.0, atol=1e-6)
    assert difference.get_xdata()[-1] == ONSETS[1]


def test_onsets_are_marked(drawn):
    marks = {
        tuple(line.get_xydata()[0]) for line in drawn.axes[0].lines if len(line.get_xdata()) == 1
    }
    assert marks == {(ONSETS[0], 0.1), (ONSETS[1], 0.098)}


def test_two_blocks_have_a_column_and_a_legend_of_their_own(drawn):
    top, force, difference = drawn.axes[2::3]
    assert top.get_title() == "$H=0.02$ m"
    said = top.get_legend().get_title().get_text()
    assert "lower clamped" in said and r"\mu_2=2\,\mu" in said
    assert [axes.get_title() for axes in drawn.axes[:2]] == ["$H=0.005$ m", "$H=0.05$ m"]
    np.testing.assert_allclose(force.lines[1].get_ydata(), 1.03 * force.lines[0].get_ydata())
    np.testing.assert_allclose(difference.lines[1].get_ydata(), 3.0, atol=1e-6)


@pytest.mark.slow
def test_text_is_legible_and_neither_overlaps_nor_is_cut(drawn):
    drawn_layout.require_legible(drawn)
