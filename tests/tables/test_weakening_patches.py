"""Weakening patches beside theory: the table of made-up records, and its figure."""

import numpy as np
import pytest
import xarray as xr
from asked import critical_length, weakening_patch_length
from configurations import papers

from nucleation.model.quantities import ParameterError
from nucleation.run.run import Run
from replication.figures import figure_weakening
from replication.tables.weakening_patches import CURVE, outcome, patch_of, weakening_patches_table

FASTEST = {"creep": 1.5, "slow slip": 150.0, "event": 2e5}  # over V
FAULT = {
    "shear_modulus": 3.1e9, "poisson_ratio": 1 / 3, "normal_stress": 1e6, "a": 0.0068,
    "zeta": 0.0034, "slip_distance": 5e-7, "friction": 0.4, "height": 10.0,
}  # fmt: skip


@pytest.fixture(scope="module")
def runs():
    """Three runs of one patch width each, with zeta/a = 0.5 and r = 1."""
    every = papers().runs_of("weakening_patches")
    own = [run for run in every if run.run.heterogeneity.change == -2.0]
    return own[: len(FASTEST)]


@pytest.fixture(scope="module")
def table(runs):
    made = [
        xr.Dataset({"slip_rate": (("time", "x"), 1e-5 * np.array([[1.0, 1.0], [1.0, fastest]]))})
        for fastest in FASTEST.values()
    ]
    return weakening_patches_table([run.to_dict() for run in runs], made)


@pytest.mark.slow
def test_table_has_the_theory_of_each_patch(runs, table):
    simulated = table.isel(run=slice(0, len(runs)))
    assert simulated["outcome"].values.tolist() == list(FASTEST)
    assert simulated["fastest"].values == pytest.approx(list(FASTEST.values()))
    smallest = float(weakening_patch_length(outside_zeta=-0.0034, **FAULT))
    assert simulated["smallest_width"].values == pytest.approx(smallest, rel=1e-4)
    assert simulated["critical_length"].values == pytest.approx(float(critical_length(**FAULT)))
    widths = [run.run.heterogeneity.width for run in runs]
    assert simulated["width_ratio"].values == pytest.approx(np.array(widths) / smallest, rel=1e-4)
    assert simulated["strengthening"].values == pytest.approx(1.0)
    curve = table.isel(run=slice(len(runs), None))
    assert set(curve["outcome"].values) == {"theory"}
    assert curve["strengthening"].values == pytest.approx(CURVE)
    at_one = np.interp(1.0, curve["strengthening"], curve["smallest_width"])
    assert at_one == pytest.approx(smallest, rel=5e-3)


@pytest.mark.slow
def test_figure_has_each_run_by_its_outcome(table):
    (axes,) = figure_weakening.draw_patches(table).axes
    looks = {marker: colour for _, marker, colour in figure_weakening.LOOKS.values()}
    drawn = {line.get_marker(): line for line in axes.lines if line.get_marker() in looks}
    assert {marker: line.get_color() for marker, line in drawn.items()} == looks
    over_critical = table["width"] / table["critical_length"]
    for name, (_, marker, _) in figure_weakening.LOOKS.items():
        own = over_critical[table["outcome"] == name]
        assert drawn[marker].get_ydata() == pytest.approx(own.values)


def test_outcomes():
    for name, fastest in FASTEST.items():
        assert outcome(fastest) == name


@pytest.mark.parametrize(
    "change", [{"heterogeneity": "friction", "change": 0.5}, {"shape": "bump"}]
)
def test_other_heterogeneity_is_refused(runs, change):
    parameters = Run.from_dict(runs[0].to_dict()["parameters"]).replaced(**change)
    with pytest.raises(ParameterError, match="it must be zeta with a step"):
        patch_of(parameters)
