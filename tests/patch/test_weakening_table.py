"""Simulated drops beside L_s, L_run and the law: the table, and the figure that is drawn of it."""

import numpy as np
import pytest
import xarray as xr

from nucleation.analysis.lengths import COLUMNS as LENGTHS
from nucleation.datasets.variables import table
from nucleation.figures.beyond import figure_weakening
from nucleation.model.identity import fault
from nucleation.model.parameters import Parameters
from nucleation.model.perturbation import Perturbation
from nucleation.patch.expected_drop import expected_drop
from nucleation.patch.tables.weakening import MEASURED, expected, gather_weakening

STRONG = Parameters(perturbation=Perturbation(kind="normal_load", strength=1e-4))
QUIET = Parameters()


def lengths(parameters, seeds):
    """A table of lengths: the force of each run drops at 0.6 m, plus a tenth for each seed."""
    columns = {**MEASURED, **{name: LENGTHS[name] for name in REST}}
    rows = []
    for seed in seeds:
        row = dict.fromkeys(columns, 0.0)
        row |= {"study": "own", "id": f"run-{seed}", "evolution": "aging", "below": "rigid"}
        row |= {"kind": "normal_load", "seed": seed, "fault": fault(parameters)}
        row |= {"length": 0.6 + 0.1 * seed, "critical_length": 1.0, "height": 0.02}
        rows.append(row | {"zeta": 0.014, "a": 0.007})
    return table(rows, columns)


REST = ("fault", "zeta", "a")


def test_a_row_has_the_answer_of_the_law():
    known = expected_drop(STRONG)
    row = expected(STRONG)
    assert row["stability_length"] == known.stability_length
    assert row["law_length"] == row["expected_length"] == known.drop.length
    assert row["expected_low"] < row["expected_length"] < row["expected_high"]
    assert np.isnan(row["runaway_length"])


def test_a_fault_without_an_answer_has_its_reason():
    row = expected(QUIET)
    assert np.isnan(row["expected_length"])
    assert "nothing is perturbed" in row["doubt"]


def test_every_run_is_beside_the_theory_of_its_fault():
    found = gather_weakening([lengths(STRONG, [1, 2])], [{"parameters": STRONG.to_dict()}])
    assert found["length"].values.tolist() == pytest.approx([0.7, 0.8])
    assert np.unique(found["law_length"]).size == 1
    np.testing.assert_allclose(found["zeta_over_a"], 2.0)


def test_the_figure_has_a_panel_for_each_base_with_curves():
    one = gather_weakening([lengths(STRONG, [1, 2])], [{"parameters": STRONG.to_dict()}])
    weakenings = (0.5, 1.0, 3.0)
    rows = [one.assign(zeta_over_a=("run", np.full(2, value))) for value in weakenings]
    alone = one.assign(height=("run", np.full(2, 1.0)))  # of one weakening: no curve
    figure = figure_weakening.draw(xr.concat([*rows, alone], dim="run"))
    (axes,) = figure.axes
    curve = axes.lines[0]
    np.testing.assert_allclose(curve.get_xdata(), weakenings)
    np.testing.assert_allclose(curve.get_ydata(), float(one["stability_length"][0]))
    points = axes.containers[0].lines[0]
    assert points.get_ydata() == pytest.approx(0.75)
