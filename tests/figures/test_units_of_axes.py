"""Units of axes follow the size of the data."""

import pytest

from nucleation.pictures.run import prefixed, time_unit


@pytest.mark.parametrize(
    ("largest", "scale", "name"),
    [(7.2e4, 1e-3, "kN/m"), (5.0, 1.0, "N/m"), (3e7, 1e-6, "MN/m"), (1e-30, 1e9, "nN/m"),
     (0.0, 1.0, "N/m")],
)  # fmt: skip
def test_prefixes_of_a_force(largest, scale, name):
    found, unit = prefixed(largest, "N/m")
    assert found == pytest.approx(scale) and unit == name


@pytest.mark.parametrize(
    ("longest", "shown", "name"),
    [(2e-3, 2.0, "ms"), (16.0, 16.0, "s"), (10800.0, 3.0, "h"), (864000.0, 10.0, "days"),
     (3.15576e8, 10.0, "years")],
)  # fmt: skip
def test_units_of_time(longest, shown, name):
    scale, unit = time_unit(longest)
    assert scale * longest == pytest.approx(shown) and unit == name
