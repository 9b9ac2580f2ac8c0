"""The figures of the verification: nothing is cut, slopes are those of the orders."""

import drawn_layout
import made_up_checks
import numpy as np
import pytest

from nucleation.figures.checks import figure_dispersion, figure_verification
from nucleation.verification.orders import ERRORS, REFINEMENTS


@pytest.fixture
def convergence():
    return made_up_checks.convergence()


@pytest.fixture
def dispersion():
    return made_up_checks.dispersion()


@pytest.fixture(params=["figure_verification", "figure_dispersion"])
def drawn(request, convergence, dispersion):
    if request.param == "figure_verification":
        return figure_verification.draw(convergence)
    return figure_dispersion.draw(dispersion)


def test_text_is_legible_and_neither_overlaps_nor_is_cut(drawn):
    drawn_layout.require_legible(drawn)


def test_nothing_is_cut(drawn):
    """Within the abscissa's limits every line and marker lies well inside the axes."""
    for axes in drawn.axes:
        left, right = axes.get_xlim()
        to_axes = axes.transData + axes.transAxes.inverted()
        for line in axes.get_lines():
            if line.get_transform() == axes.transData:
                x, y = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
                shown = (x >= left) & (x <= right)
                height = to_axes.transform(np.column_stack([x, y])[shown])[:, 1]
                assert height.min() > 0.02
                assert height.max() < 0.98


def test_every_mode_is_a_marker(dispersion):
    figure = figure_dispersion.draw(dispersion)
    for axes, name in zip(figure.axes, ("growth", "frequency"), strict=True):
        markers = [line for line in axes.get_lines() if line.get_marker() in "os"]
        drawn = np.sort(np.concatenate([line.get_ydata() for line in markers]))
        np.testing.assert_array_equal(drawn, np.sort(dispersion[f"measured_{name}"].values.ravel()))


def test_errors_and_slopes(convergence):
    figure = figure_verification.draw(convergence)
    for axes, refinement, order in zip(figure.axes, REFINEMENTS, (2, 2, 3), strict=True):
        errors = convergence.sel(refinement=refinement)
        by_label = {line.get_label(): line.get_ydata() for line in axes.get_lines()}
        for problem in ("aging", "slip"):
            for quantity, name in zip(("slip rate", "state"), list(ERRORS)[1:], strict=True):
                np.testing.assert_array_equal(
                    by_label[f"{problem} law, {quantity}"], errors[name].sel(problem=problem)
                )
        assert ("elastodynamics, displacement" in by_label) == (order == 2)
        (guide,) = (line for line in axes.get_lines() if line.get_linestyle() == ":")
        (x0, y0), (x1, y1) = guide.get_xydata()
        assert np.log(y1 / y0) / np.log(x1 / x0) == pytest.approx(order)
