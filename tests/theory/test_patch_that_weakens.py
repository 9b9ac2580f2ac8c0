"""W_c by theory: an independent route in a period, its limits, and what it must not depend on."""

import functools
import math
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from asked import critical_length, spectrum, weakening_patch_length

from nucleation.lengths.formulas import FINITE_PATCH
from nucleation.model.quantities import ParameterError
from nucleation.theory import weakening_patch

A = 0.01
FAULT = {
    "shear_modulus": 30e9,
    "poisson_ratio": 0.25,
    "normal_stress": 50e6,
    "a": A,
    "slip_distance": 5e-6,
    "friction": 0.6,
}
OTHER = {"second_shear_modulus": 90e9}
BASE = {"second_shear_modulus": math.inf, "height": 0.05}


def over_critical(ratio, strengthening, **changed):
    """W_c/L_c for zeta/a of the patch and -zeta/zeta of the surroundings."""
    fault = FAULT | {"zeta": ratio * A} | changed
    outside = {"outside_zeta": -strengthening * ratio * A}
    if "outside_a" in fault:
        outside["outside_a"] = fault.pop("outside_a")
    return float(weakening_patch_length(**outside, **fault) / critical_length(**fault))


usual = functools.cache(over_critical)


def largest_growth(width, period, number, ratio, strengthening, outside_a, fault):
    """Growth rate of a patch in a period, by all Fourier modes up to a number, over V/D.

    ``a s^2 u + s (M - zeta) u + M u = 0`` with the roots of the uniform fault's Eq. (5) for M: two
    roots have the product ``M/a``. Width and period are in metres.
    """
    n = np.arange(-number, number + 1)
    k = 2.0 * np.pi * n / period
    moving = k != 0.0
    elastic = np.zeros(n.size, dtype=complex)
    roots = spectrum(k[moving], **fault, zeta=ratio * A, velocity=fault["slip_distance"])
    elastic[moving] = A * roots[0] * roots[1]
    apart = np.subtract.outer(n, n)
    within = width / period * np.sinc(apart * width / period)
    outside = np.eye(n.size) - within
    direct = A * within + outside_a * outside
    weakening = ratio * A * within - strengthening * ratio * A * outside
    inverse = np.linalg.inv(direct)
    stiffness = np.diag(elastic)
    companion = np.block(
        [
            [np.zeros_like(stiffness), np.eye(n.size)],
            [-inverse @ stiffness, -inverse @ (stiffness - weakening)],
        ]
    )
    rates = np.linalg.eigvals(companion)
    drift = np.abs(rates) < 1e-9  # uniform slip, which the bodies don't resist
    return rates[~drift].real.max()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "strengthening", "outside_a", "changed"),
    [
        (0.5, 1.0, A, BASE),
        (2.288, 0.43, A, BASE),
        (0.5, 1.0, 2.0 * A, BASE),
        (0.5, 1.0, A, {**OTHER, "height": 0.1, "second_height": 0.2}),
    ],
)
def test_fourier_modes_of_a_period_agree(ratio, strengthening, outside_a, changed):
    """All modes of a long period in thin layers, whose interaction falls off exponentially.

    The Fourier series of the step leaves an error that falls with its square.
    """
    fault = FAULT | changed
    own = over_critical(ratio, strengthening, outside_a=outside_a, **changed)
    critical = float(critical_length(**fault, zeta=ratio * A))

    def growth(width, number):
        period = 12.0 * own * critical
        arguments = (period, number, ratio, strengthening, outside_a, fault)
        return largest_growth(width * own * critical, *arguments)

    assert growth(0.99, 120) < 0.0 < growth(1.01, 120)


def test_surroundings_of_much_larger_a_leave_a_width():
    """Fourier modes of a period of 16 W grow from 0.2307 and 0.2398 mu D/(a sigma0) on.

    Narrow patches turn the phase up to high frequencies if a differs six times or more.
    """
    fault = FAULT | {"plane": "antiplane", "zeta": 5.0 * A}
    scale = FAULT["shear_modulus"] * FAULT["slip_distance"] / (A * FAULT["normal_stress"])
    for ratio, modes in ((6.5, 0.231), (10.0, 0.240)):
        width = weakening_patch_length(outside_zeta=-0.5 * A, outside_a=ratio * A, **fault)
        assert float(width) / scale == pytest.approx(modes, rel=0.01)


@pytest.mark.slow
def test_half_spaces_are_the_limit_of_long_periods():
    """In a period P of half-spaces the threshold is higher by a term in 1/P^2, and meets W_c."""
    critical = float(critical_length(**FAULT, zeta=0.5 * A))

    def threshold(period):
        low, high = 0.42, 0.48
        while high - low > 1e-4:
            middle = 0.5 * (low + high)
            length = middle * critical
            number = 10 * period
            grown = largest_growth(length, period * length, number, 0.5, 1.0, A, FAULT)
            low, high = (low, middle) if grown > 0.0 else (middle, high)
        return low

    short, long = threshold(8), threshold(16)
    assert (4.0 * long - short) / 3.0 == pytest.approx(over_critical(0.5, 1.0), rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "strong", "stronger"), [(0.1, 290.0, 2900.0), (1.0, 30.0, 300.0), (10.0, 9.0, 99.0)]
)
def test_rigid_surroundings_are_a_limit(ratio, strong, stronger):
    """Surroundings that strengthen very much don't slip: the asperity of Uenishi and Rice."""
    rigid = FINITE_PATCH / math.pi
    before, after = (abs(over_critical(ratio, r) / rigid - 1.0) for r in (strong, stronger))
    assert after < before
    assert after < 0.015


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "name", "value"),
    [
        (weakening_patch, "POLYNOMIALS", 24),
        (weakening_patch, "FREQUENCIES", 200),
        (weakening_patch, "SLOWEST", 1e-7),
        (weakening_patch, "TURN", 0.3),
        (weakening_patch, "FACTOR", 1.1),
        (weakening_patch, "PRECISION", 1e-7),
        (weakening_patch, "OCTAVE_POINTS", 14),
        (weakening_patch, "OCTAVES", (-28, 13)),
    ],
)
def test_it_does_not_depend_on_how_it_is_found(monkeypatch, module, name, value):
    before = usual(0.5, 0.7, **OTHER, height=0.8)
    weakening_patch.patch_basis.cache_clear()
    monkeypatch.setattr(module, name, value)
    after = over_critical(0.5, 0.7, **OTHER, height=0.8)
    weakening_patch.patch_basis.cache_clear()
    assert after == pytest.approx(before, rel=1.5e-5)


@pytest.mark.slow
def test_arrays_and_status():
    """Broadcast as NumPy's and by name; NaN where no width is the smallest."""
    fault = FAULT | {"zeta": [[0.005], [-0.001]]}
    found = weakening_patch_length(outside_zeta=[-0.005, 0.001, -0.01], **fault)
    assert found.shape == (2, 3)
    assert np.isfinite(found).tolist() == [[True, False, True], [False] * 3]
    alone = weakening_patch_length(outside_zeta=-0.01, **FAULT, zeta=0.005)
    assert found[0, 2] == alone
    assert np.ndim(alone) == 0
    outside = xr.DataArray([-0.005, -0.01], dims="r")
    named = weakening_patch_length(outside_zeta=outside, **FAULT, zeta=0.005)
    assert named.attrs["units"] == "m"
    np.testing.assert_array_equal(named.values, found[0, [0, 2]])


def test_bad_parameters_are_refused():
    with pytest.raises(ParameterError, match="outside_zeta"):
        weakening_patch_length(outside_zeta=math.nan, **FAULT, zeta=0.005)
    with pytest.raises(ParameterError, match="outside_a"):
        weakening_patch_length(outside_zeta=-0.005, outside_a=-1.0, **FAULT, zeta=0.005)
    with pytest.raises(ParameterError, match="outside_zeta"):
        weakening_patch_length(outside_zeta=[-0.1, -0.2], **FAULT, zeta=[0.1, 0.2, 0.3])


@pytest.mark.slow
def test_table_of_the_page():
    """docs/creeping_patch.md has W_c/L_c between half-spaces."""
    page = Path(__file__).parents[2] / "docs" / "creeping_patch.md"
    _, head, table = page.read_text(encoding="utf-8").partition(r"| $\zeta/a$ | $r$ = 0.1 |")
    strengthening = [0.1, *map(float, re.findall(r"[\d.]+", table.partition("\n")[0]))]
    rows = re.findall(r"^\| ([\d.]+) \| (.*) \|$", table.partition("\n\n")[0], re.MULTILINE)
    assert head and len(rows) == 6
    for ratio, cells in rows:
        stated = [float(cell) for cell in cells.split(" | ")]
        found = [over_critical(float(ratio), r) for r in strengthening]
        assert found == pytest.approx(stated, abs=6e-4)
