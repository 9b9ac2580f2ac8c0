"""Figures 1, 2, S1 and Table S1 show what they are given."""

import csv
import io

import numpy as np
import pytest

from nucleation.model.friction import Friction
from replication.figures import theory as figures


def test_figure_2_has_a_curve_for_each_ratio(theory):
    (axes,) = figures.figure_2(theory).axes
    lines = axes.get_lines()
    assert len(lines) == theory.sizes["zeta_over_a"]
    for line in lines:
        value = float(line.get_label().strip("$"))
        expected = theory["bimaterial_length_ratio"].sel(zeta_over_a=value)
        np.testing.assert_array_equal(line.get_xdata(), theory["f_beta"])
        np.testing.assert_array_equal(line.get_ydata(), expected)
    heights = [line.get_ydata()[-1] for line in lines]
    assert heights == sorted(heights, reverse=True), "the legend has the order of the curves"
    assert len({line.get_linestyle() + str(line.get_color()) for line in lines}) == len(lines)


def test_table_s1_holds_the_papers_values():
    table = figures.table_s1(Friction(law="product"))
    rows = list(csv.DictReader(io.StringIO(table[".csv"])))
    assert [row["symbol"] for row in rows] == ["D", "b", "v*", "θ", "φ*", "v₀", "ξ"]
    values = [float(row["value"]) for row in rows]
    assert values == pytest.approx([5e-7, 0.075, 1e-7, 5 / 18, 3.3e-4, 1e-9, 0.005], rel=1e-15)
    assert [row["unit"] for row in rows] == ["m", "-", "m/s", "-", "s", "m/s", "-"]
    lines = table[".md"].splitlines()
    assert r"| v\* | 10⁻⁷ | m/s |" in lines[4]


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (5e-7, "5×10⁻⁷"),
        (1e-7, "10⁻⁷"),
        (3.3e-4, "3.3×10⁻⁴"),
        (0.075, "0.075"),
        (5 / 18, "5/18"),
        (0.2778, "0.2778"),
        (0.0, "0"),
        (2e6, "2×10⁶"),
        (0.005, "0.005"),
    ],
)
def test_values_are_written_as_in_the_paper(value, text):
    assert figures.value_text(value) == text
