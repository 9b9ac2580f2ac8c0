"""The figures of the verification: nothing is cut, slopes are those of the orders."""

import drawn_layout
import numpy as np
import pytest
import xarray as xr

from nucleation.convergence import ERRORS, PROBLEMS, REFINEMENTS
from nucleation.figures import figure_dispersion, figure_verification, style

LEVELS = 2.0 ** -np.arange(4)


@pytest.fixture
def convergence():
    order = np.array([2, 2, 3])[None, :, None]
    factor = 1e-3 * np.arange(1, 4)[:, None, None]
    data = {
        name: (("problem", "refinement", "level"), (i + 1) * factor * LEVELS**order)
        for i, name in enumerate(ERRORS)
    }
    spacings = {
        "element_size": 0.125, "step_size": 5.7e-6, "quasi_static_step_size": 2.3e-2
    }  # fmt: skip
    dataset = xr.Dataset(
        {**data, **{name: ("level", size * LEVELS) for name, size in spacings.items()}},
        {"problem": list(PROBLEMS), "refinement": list(REFINEMENTS)},
    )
    lacking = {"problem": "elastodynamics", "refinement": "quasi_static_step"}
    for name in ERRORS:
        dataset[name].loc[lacking] = np.nan
    return dataset


@pytest.fixture
def dispersion():
    """Branches that fall steeply beyond the last mode."""
    height, modes, curve = (
        np.array([0.01, 0.1]),
        np.linspace(0.5, 2.0, 7),
        np.linspace(0.4, 2.1, 80),
    )

    def rates(k):
        growth = np.stack([1 - k**3, 0.8 - 0.7 * k], axis=-1)
        frequency = np.stack([k, -0.9 * k], axis=-1)
        return np.stack([growth, 0.5 * growth]), np.stack([frequency, 0.8 * frequency])

    at, along = ("height", "mode", "branch"), ("height", "curve", "branch")
    data = {
        "mode_wavenumber": (("height", "mode"), np.stack([20 * modes, 10 * modes])),
        "curve_wavenumber": (("height", "curve"), np.stack([20 * curve, 10 * curve])),
        "critical_wavenumber": ("height", [20.0, 10.0]),
        "memory_time": 1.0,
    }
    for kind, dims, k in (("measured", at, modes), ("curve", along, curve)):
        for part, values in zip(("growth", "frequency"), rates(k), strict=True):
            data[f"{kind}_{part}"] = (dims, values)
    return xr.Dataset(data, {"height": height})


@pytest.fixture(params=["figure_verification", "figure_dispersion"])
def drawn(request, convergence, dispersion):
    if request.param == "figure_verification":
        return figure_verification.draw(convergence)
    return figure_dispersion.draw(dispersion)


def test_text_is_legible_and_neither_overlaps_nor_is_cut(drawn):
    assert drawn_layout.overlaps(drawn) == []
    assert drawn_layout.cut_off(drawn) == []
    assert drawn_layout.sizes(drawn).min() >= style.SMALL


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
            for quantity, name in (("slip rate", ERRORS[1]), ("state", ERRORS[2])):
                np.testing.assert_array_equal(
                    by_label[f"{problem} law, {quantity}"], errors[name].sel(problem=problem)
                )
        assert ("elastodynamics, displacement" in by_label) == (order == 2)
        (guide,) = (line for line in axes.get_lines() if line.get_linestyle() == ":")
        (x0, y0), (x1, y1) = guide.get_xydata()
        assert np.log(y1 / y0) / np.log(x1 / x0) == pytest.approx(order)
