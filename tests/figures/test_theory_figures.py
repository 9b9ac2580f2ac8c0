"""Figures 1, 2, S1 and Table S1 show what they are given."""

import numpy as np
import pytest
from matplotlib.text import Text

from nucleation.figures import style
from nucleation.figures.paper import figure_1, figure_2, figure_s1, table_s1
from nucleation.model.friction.law import Friction


def test_figure_1_names_every_quantity_of_the_caption():
    texts = " ".join(t.get_text() for t in figure_1.draw().findobj(Text))
    for name in ("H^{(1)}", "H^{(2)}", r"\mu^{(1)}", r"\nu^{(2)}", r"\sigma_0", "$V$", "$x$", "$y$",
                 "$H$", "$L$", "rigid", "free", "(a)", "(b)"):  # fmt: skip
        assert name in texts


def test_figure_2_has_a_curve_for_each_ratio(theory):
    (axes,) = figure_2.draw(theory).axes
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


def test_figure_s1_shows_both_laws_and_the_velocity(theory):
    (axes,) = figure_s1.draw(theory).axes
    full, logarithmic, velocity = axes.get_lines()
    assert axes.get_xscale() == "log" and "(m/s)" in axes.get_xlabel()
    np.testing.assert_array_equal(full.get_ydata(), theory["steady_friction"])
    np.testing.assert_array_equal(logarithmic.get_ydata(), theory["steady_friction_logarithmic"])
    np.testing.assert_array_equal(full.get_xdata(), theory["slip_rate"])
    assert set(velocity.get_xdata()) == {float(theory["velocity"])}
    assert velocity.get_linestyle() == "--"
    assert (full.get_color(), logarithmic.get_color()) == (style.FULL_LAW, style.LOGARITHMIC_LAW)


def test_table_s1_holds_the_papers_values():
    rows = {row.symbol: row for row in table_s1.rows(Friction())}
    assert list(rows) == ["D", "b", "v*", "θ", "φ*", "v₀", "ξ"]
    values = [row.value for row in rows.values()]
    assert values == pytest.approx([5e-7, 0.075, 1e-7, 5 / 18, 3.3e-4, 1e-9, 0.005], rel=1e-15)
    assert [row.unit for row in rows.values()] == ["m", "-", "m/s", "-", "s", "m/s", "-"]


@pytest.mark.parametrize(
    ("value", "text"),
    [(5e-7, "5×10⁻⁷"), (1e-7, "10⁻⁷"), (3.3e-4, "3.3×10⁻⁴"), (0.075, "0.075"), (5 / 18, "5/18"),
     (0.2778, "0.2778"), (0.0, "0"), (2e6, "2×10⁶"), (0.005, "0.005")],
)  # fmt: skip
def test_values_are_written_as_in_the_paper(value, text):
    assert table_s1.value_text(value) == text


def test_table_s1_as_markdown():
    lines = table_s1.to_markdown(table_s1.rows(Friction())).splitlines()
    assert len(lines) == 9 and {line.count("|") for line in lines} == {5}
    assert r"| v\* | 10⁻⁷ | m/s |" in lines[4]
