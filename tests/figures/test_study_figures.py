"""The figures of refinement and sensitivity: every row is drawn, nothing is cut or overlaps."""

import drawn_layout
import numpy as np
import pytest
import xarray as xr

from nucleation.figures.beyond import figure_sensitivity
from nucleation.figures.beyond.figure_sensitivity import label
from nucleation.figures.checks import figure_convergence, figure_hops

HEIGHTS = (0.005, 0.02, 0.1)


def dataset(rows):
    return xr.Dataset({name: ("run", [row[name] for row in rows]) for name in rows[0]})


def sequence(refined, values, height, **fixed):
    usual = {
        "n_x": 800, "n_y": 8, "longest_step": 0.1, "tolerance": 1e-2, "kind": "normal_load",
        "strength": 1e-5, "seed": 1, "evolution": "aging", "phi0": 1.0,
        "fault": f"{height}{fixed.get('law')}{fixed.get('phi0')}",
    }  # fmt: skip
    for i, value in enumerate(values):
        error = 0.1 * 0.1**i if i + 1 < len(values) else 0.0
        yield {
            **usual, **fixed, refined: value, "refinement": refined, "height": height,
            "length_over_theory": 0.7 - error, "length_difference": -error,
            "onset_difference": error / 3.0,
        }  # fmt: skip


@pytest.fixture
def table():
    rows = []
    for height, law, age in ((0.005, "aging", 1.0), (0.02, "aging", 1.0), (0.1, "aging", 1.0),
                             (0.02, "slip", 1.0), (0.1, "aging", 1e3)):  # fmt: skip
        own = {"evolution": law, "phi0": age}
        rows += sequence("n_x", [400, 800, 1600], height, **own)
        rows += sequence("n_y", [8, 16], height, **own)
        rows += sequence("longest_step", [0.1, 0.05, 0.02], height, **own)
        rows += sequence("tolerance", [1e-2, 2.5e-3], height, **own)
    rows += sequence("n_x", [400, 800, 1600], 0.02, kind="state", longest_step=0.05)
    quiet = {"kind": "none", "strength": 0.0, "seed": 0, "longest_step": 0.02}
    for height in (0.005, 0.02):
        rows += sequence("n_x", [400, 800, 1600], height, **quiet)
    rows += sequence("longest_step", [0.1, 0.04, 0.02], 0.02, **quiet)
    return dataset(rows)


@pytest.fixture
def hops():
    made = []
    for n_x in (400, 800, 1600):
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


@pytest.fixture(params=["convergence", "hops", "sensitivity"])
def drawn(request, table, hops, patch, sensitivity):
    if request.param == "convergence":
        return figure_convergence.draw(table)
    if request.param == "hops":
        return figure_hops.draw(hops, patch)
    return figure_sensitivity.draw(sensitivity)


@pytest.mark.slow
def test_text_is_legible_and_neither_overlaps_nor_is_cut(drawn):
    drawn_layout.require_legible(drawn)


def drawn_at(axes):
    """Places and values of the markers of an axes."""
    return sorted(
        (round(float(x), 2), float(y))
        for line in axes.get_lines()
        for x, y in line.get_xydata()
        if np.isfinite(y)
    )


@pytest.mark.parametrize(("panel", "name"), [(0, "onset_difference"), (1, "length_difference")])
def test_every_perturbed_run_but_the_finest_is_a_point_at_its_fault_or_kind(table, panel, name):
    axes = figure_convergence.draw(table).axes[panel]
    labels = ["0.005", "0.02", "0.1", "0.1 older", "0.02 slip", "all, state"]
    words = [text.get_text() for text in axes.get_xticklabels()]
    assert panel == 0 or words == labels  # the upper panel has none of its own
    declared = table.isel(run=np.flatnonzero(table["kind"].values != "none"))
    apart = 100.0 * np.abs(declared[name].values)
    points = drawn_at(axes)
    np.testing.assert_allclose(sorted(y for _, y in points), sorted(apart[apart > 0.0]))
    found = figure_convergence.places(declared)
    for place, rows in enumerate(found.values()):
        own = 100.0 * np.abs(rows[name].values)
        near = [y for x, y in points if abs(x - place) < 0.5]
        np.testing.assert_allclose(sorted(near), sorted(own[own > 0.0]))


def test_runs_that_agree_are_drawn_at_the_edge(table):
    same = table.assign(onset_difference=0.0 * table["onset_difference"])
    axes = figure_convergence.draw(same).axes[0]
    assert {y for _, y in drawn_at(axes)} == {figure_convergence.LEAST}


@pytest.mark.parametrize(("panel", "refined"), [(2, "n_x"), (3, "longest_step")])
def test_quiet_runs_are_dashed_beside_perturbed_ones(table, panel, refined):
    axes = figure_convergence.draw(table).axes[panel]
    for dash, calm in (("--", True), ("-", False)):
        lines = [line for line in axes.get_lines() if line.get_linestyle() == dash]
        drawn = {tuple(point) for line in lines for point in line.get_xydata()}
        rows = table.to_dataframe()
        rows = rows[(rows["refinement"] == refined) & rows["height"].isin([0.005, 0.02])]
        rows = rows[rows["kind"].eq("none") if calm else rows["kind"].eq("normal_load")]
        rows = rows[rows["evolution"] == "aging"]
        assert drawn == set(zip(rows[refined], rows["length_over_theory"], strict=True))
    if refined == "longest_step":
        assert axes.get_xlim()[0] > axes.get_xlim()[1]


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
