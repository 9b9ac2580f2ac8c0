"""The realisations: what they are made of, their statistics, and that any part stands alone."""

import numpy as np
import pytest
from scipy.interpolate import BSpline
from scipy.stats import kstest

from benchmarks.crosscheck.freefem import coefficients_of
from nucleation.model.realisations import (
    MEAN_SQUARE,
    Series,
    Sheet,
    correlation,
    normals,
    spectral_density,
)


def test_numbers_are_standard_normal_and_independent():
    rows = np.array([normals(5, 1, row, 4000) for row in range(5)])
    assert kstest(rows.ravel(), "norm").pvalue > 1e-3
    others = np.array([normals(6, 1, 0, 4000), normals(5, 2, 0, 4000)])
    correlation = np.corrcoef(np.vstack((rows, others))) - np.eye(7)
    assert np.abs(correlation).max() < 0.06


def test_numbers_never_change():
    # from version to version and machine to machine; the last digits are those of ndtri
    expected = [-0.48155270891676, 0.68738093117408, 0.10638599016041]
    np.testing.assert_allclose(normals(1, 1, 0, 3), expected, rtol=1e-12)


@pytest.mark.parametrize("made", [Series(4, 0.05), Sheet(4, 0.05, 0.1, np.linspace(0.0, 1.0, 7))])
def test_coefficients_are_those_of_the_values(made):
    """Evaluated anew, as another program would do it that is given the coefficients alone."""
    until = 20.0  # s: more than one block of coefficients
    given = coefficients_of(made, 4, until)
    basis = BSpline(np.arange(-3.0, given.shape[0] + 1.0), given / MEAN_SQUARE**0.5, 3)
    for time in (0.0, 1.234, until):
        own = made.values(time) if isinstance(made, Sheet) else made.value(time)
        np.testing.assert_allclose(own, basis(time / made.spacing + made.phase), rtol=1e-9)


def test_slope_and_integral_belong_to_the_series():
    series, step = Series(2, 0.3), 1e-4
    for time in (0.0005, 0.7, 12.34):
        slope = (series.value(time + step) - series.value(time - step)) / (2 * step)
        assert series.slope(time) == pytest.approx(slope, rel=1e-5, abs=1e-6)
    times = np.linspace(0.0, 40.0, 40001)
    values = np.array([series.value(t) for t in times])
    by_parts = np.trapezoid(values, times)
    assert series.integral(0.0) == 0.0
    assert series.integral(40.0) == pytest.approx(by_parts, abs=1e-6)


@pytest.mark.parametrize("scale", [0.05, 2.0])
def test_correlation_and_spectral_density_are_a_pair(scale):
    """One at no lag; its integral is the correlation time; its Fourier transform the density."""
    lag = np.linspace(-4.0, 4.0, 4001) * scale
    values = correlation(lag, scale)
    assert correlation(0.0, scale) == pytest.approx(1.0)
    assert np.trapezoid(values, lag) == pytest.approx(scale, rel=1e-6)
    for omega in np.array([0.5, 2.0, 5.0]) / scale:
        transformed = np.trapezoid(values * np.cos(omega * lag), lag)
        assert spectral_density(omega, scale) == pytest.approx(transformed, abs=1e-6 * scale)


def test_sheet_is_the_same_on_every_mesh_and_in_every_order():
    coarse, fine = np.linspace(0.0, 2.4, 401), np.linspace(0.0, 2.4, 1601)
    one, other = Sheet(4, 0.05, 0.1, coarse), Sheet(4, 0.05, 0.1, fine)
    times = (0.0, 3.3, 1.1, 40.0)
    seen = {t: one.values(t) for t in times}
    for time in reversed(times):
        np.testing.assert_allclose(seen[time], other.values(time)[::4], atol=1e-9)
        np.testing.assert_array_equal(seen[time], Sheet(4, 0.05, 0.1, coarse).values(time))


def test_sheet_is_correlated_in_time_and_along_x():
    x = np.linspace(0.0, 400.0, 1001)  # the spacing is 0.4 correlation lengths
    sheet = Sheet(3, 1.0, 1.0, x)
    rows = np.array([sheet.values(t) for t in np.arange(0.0, 400.0, 0.4)])
    septic = BSpline.basis_element(np.arange(-4.0, 5.0), extrapolate=False)
    near = float(septic(0.4 / MEAN_SQUARE)) / MEAN_SQUARE
    assert rows.var() == pytest.approx(1.0, abs=0.02)
    assert (rows[1:] * rows[:-1]).mean() == pytest.approx(near, abs=0.02)
    assert (rows[:, 1:] * rows[:, :-1]).mean() == pytest.approx(near, abs=0.02)
    assert (rows[1:, 1:] * rows[:-1, :-1]).mean() == pytest.approx(near**2, abs=0.02)
