"""The figures of refinement and sensitivity: every row is drawn, nothing is cut or overlaps."""

import drawn_layout
import numpy as np
import pytest
import xarray as xr

from nucleation.figures import style
from nucleation.figures.beyond import figure_sensitivity
from nucleation.figures.beyond.figure_sensitivity import label
from nucleation.figures.checks import figure_convergence

HEIGHTS = (0.005, 0.02, 0.1)


def dataset(rows):
    return xr.Dataset({name: ("run", [row[name] for row in rows]) for name in rows[0]})


def sequence(refined, values, height, **fixed):
    usual = {"n_x": 400, "n_y": 20, "longest_step": 0.02, "tolerance": 1e-2}
    for i, value in enumerate(values):
        error = 0.3 * 0.2**i
        yield {
            **usual, **fixed, refined: value, "refinement": refined, "height": height,
            "length_over_theory": 0.85 - error, "onset_time_high": 19.0 - 20 * error,
            "drop_time_change": 16 * error if i else np.nan,
        }  # fmt: skip


@pytest.fixture
def table():
    rows = []
    for height in HEIGHTS:
        rows += sequence("n_x", [400, 800, 1600, 3200], height)
        rows += sequence("n_y", [10, 20, 40], height)
    rows += sequence("n_x", [800, 1600, 3200], HEIGHTS[0], longest_step=0.01)
    for height in HEIGHTS:
        rows += sequence("longest_step", [0.32, 0.16, 0.08, 0.04, 0.02], height)
        rows += sequence("longest_step", [0.08, 0.04, 0.02, 0.01], height, n_x=1600)
        rows += sequence("tolerance", [4e-2, 1e-2, 2.5e-3], height, n_x=800)
    return dataset(rows)


@pytest.fixture
def hops():
    made = []
    for n_x in (400, 800, 1600, 3200):
        hop = np.linspace(1.0, 19.0, n_x // 8)
        time = np.linspace(0.0, 19.3, 2000)
        rate = 5e-6 + 8e-7 * np.sin(11 * time) + 4e-5 * (time > 19.0)
        made.append(
            xr.Dataset(
                {
                    "hop_time": ("hop", hop),
                    "hop_length": ("hop", 0.2 * np.sqrt(hop / 19.0)),
                    "hop_frequency": ("hop", np.linspace(90.0, 11.0, hop.size) * n_x / 400),
                    "inner_slip_rate": ("time", rate),
                    "sample_time": ("sample", time[600:-80]),
                    "oscillation_amplitude": ("sample", 1e-9 * np.exp(0.3 * time[600:-80])),
                    "onset_time": 19.0,
                    "velocity": 1e-5,
                    "n_x": n_x,
                },
                {"time": time},
            )
        )
    return made


@pytest.fixture
def patch():
    length = np.linspace(0.03, 0.19, 300)
    return xr.Dataset(
        {
            "patch_length": ("instant", length),
            "oscillation_frequency": ("instant", 18.0 - 40.0 * length),
            "stability_length": 0.13,
        }
    )


@pytest.fixture
def sensitivity():
    words = ("base", "rho x 0.5", "rho x 2", "rho = 0", "L x 2", "D x 0.5", "V x 2", "sigma0 x 2",
             "tau0 = 0", "tau0 = 50000 Pa", "edge at 0.5 V", "edge at 0.001 V", "drop by 0.005",
             "end of the drop")  # fmt: skip
    return dataset(
        [
            {"height": h, "variation": word, "length_change": 0.01 * i, "ratio_change": 0.2 - h * i}
            for h in HEIGHTS
            for i, word in enumerate(words)
        ]
    )


@pytest.fixture(params=["convergence", "sensitivity"])
def drawn(request, table, hops, patch, sensitivity):
    if request.param == "convergence":
        return figure_convergence.draw(table, hops, patch)
    return figure_sensitivity.draw(sensitivity)


@pytest.mark.slow
def test_text_is_legible_and_neither_overlaps_nor_is_cut(drawn):
    assert drawn_layout.overlaps(drawn) == []
    assert drawn_layout.cut_off(drawn) == []
    assert drawn_layout.sizes(drawn).min() >= style.SMALL


@pytest.mark.slow
def test_files_embed_their_fonts(drawn, tmp_path):
    pdf, png = style.save(drawn, tmp_path / "figure")
    content = pdf.read_bytes()
    assert b"/FontFile2" in content and b"/Type3" not in content
    assert png.stat().st_size > 10_000


@pytest.mark.parametrize(("row", "name"), [(0, "length_over_theory"), (1, "onset_time_high")])
def test_every_run_is_a_point(table, hops, patch, row, name):
    figure = figure_convergence.draw(table, hops, patch)
    refinements = ("n_x", "n_y", "longest_step", "tolerance")
    for axes, refined in zip(figure.axes[4 * row : 4 * row + 4], refinements, strict=True):
        of_it = table["refinement"].values == refined
        expected = set(zip(table[refined].values[of_it], table[name].values[of_it], strict=True))
        drawn = {tuple(point) for line in axes.get_lines() for point in line.get_xydata()}
        assert drawn == expected


def test_sequences_of_one_height_are_told_apart(table, hops, patch):
    """Two curves of one colour, with long and with short steps, looked the same."""
    figure = figure_convergence.draw(table, hops, patch)
    looks = [
        (line.get_color(), line.get_linestyle(), line.get_fillstyle())
        for line in figure.axes[0].get_lines()
    ]
    assert len(looks) == len(HEIGHTS) + 1 == len(set(looks))
    (legend,) = figure.legends
    assert "steps of 0.01 $D/V$" in [text.get_text() for text in legend.get_texts()]


def test_steps_get_finer_to_the_right_and_orders_have_a_guide(table, hops, patch):
    figure = figure_convergence.draw(table, hops, patch)
    for axes in (figure.axes[2], figure.axes[9]):
        assert axes.get_xlim()[0] > axes.get_xlim()[1]
    (guide,) = (line for line in figure.axes[9].get_lines() if line.get_linestyle() == ":")
    (x0, y0), (x1, y1) = guide.get_xydata()
    assert np.log(y1 / y0) / np.log(x1 / x0) == pytest.approx(3.0)


def test_every_variation_is_a_row_and_every_height_a_marker(sensitivity):
    figure = figure_sensitivity.draw(sensitivity)
    for axes, name in zip(figure.axes, ("length_change", "ratio_change"), strict=True):
        markers = [line for line in axes.get_lines() if line.get_linestyle() == "None"]
        assert len(markers) == len(HEIGHTS)
        drawn = np.concatenate([line.get_xdata() for line in markers])
        expected = 100.0 * sensitivity[name].values[sensitivity["variation"].values != "base"]
        np.testing.assert_allclose(np.sort(drawn), np.sort(expected))


@pytest.mark.parametrize(
    ("variation", "expected"),
    [
        ("rho x 0.5", r"$\rho\times0.5$"),
        ("rho = 0", r"$\rho=0$"),
        ("tau0 = 50000 Pa", r"$\tau_0=0.05$ MPa"),
        ("edge at 0.5 V", "edge at 0.5 $V$"),
        ("end of the drop", "end of the drop"),
    ],
)
def test_labels(variation, expected):
    assert label(variation) == expected
