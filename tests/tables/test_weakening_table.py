"""Simulated drops beside L_s, L_run and the law, also of other faults: tables and the figure."""

import numpy as np
import pytest
import xarray as xr
from asked import expected_drop
from thin_limit import thin_limit

from nucleation.datasets.variables import table
from nucleation.run.derived import ensemble, fault
from nucleation.run.run import PAPER_RUN
from replication.figures import figure_weakening
from replication.tables import drops as module
from replication.tables.drops import (
    EXPECTED,
    OTHER_FAULTS,
    WEAKENING,
    WEAKENING_CURVES,
    expected,
    gather_other_faults,
    weakening_curves,
    weakening_files,
)
from replication.tables.lengths import COLUMNS as LENGTHS

STRONG = PAPER_RUN.replaced(perturbation="normal_load", strength=1e-4)


def lengths(parameters, seeds):
    """A table of lengths: the force of each run drops at 0.6 m, plus a tenth for each seed."""
    names = [name for name in WEAKENING if name in LENGTHS and name not in EXPECTED]
    columns = {name: LENGTHS[name] for name in (*names, "zeta", "a")}
    rows = []
    for seed in seeds:
        row = dict.fromkeys(columns, 0.0)
        row |= {"study": "own", "id": f"run-{seed}", "evolution": "aging", "below": "rigid"}
        row |= {"kind": "normal_load", "seed": seed, "fault": fault(parameters)}
        row |= {"length": 0.6 + 0.1 * seed, "critical_length": 1.0, "height": 0.02}
        rows.append(row | {"zeta": 0.014, "a": 0.007})
    return table(rows, columns)


def gathered(seeds):
    """The table of runs of one fault, without curves."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(module, "weakening_curves", lambda runs: xr.Dataset())
        return weakening_files([lengths(STRONG, seeds)], [{"parameters": STRONG.to_dict()}])[".nc"]


def test_a_row_has_the_answer_of_the_law():
    known = expected_drop(STRONG)
    row = expected(STRONG)
    assert row["stability_length"] == known.stability_length
    assert row["law_length"] == row["expected_length"] == known.law.length
    assert row["expected_low"] < row["expected_length"] < row["expected_high"]
    assert np.isnan(row["runaway_length"])


def test_a_fault_without_an_answer_has_its_reason():
    row = expected(PAPER_RUN)
    assert np.isnan(row["expected_length"])
    assert "nothing is perturbed" in row["doubt"]


def test_every_run_is_beside_the_theory_of_its_fault():
    found = gathered([1, 2])
    assert found["length"].values.tolist() == pytest.approx([0.7, 0.8])
    assert np.unique(found["law_length"]).size == 1
    np.testing.assert_allclose(found["zeta_over_a"], 2.0)


def drawn_rows():
    """Two realisations for each of three weakenings."""
    one = gathered([1, 2])
    return [one.assign(zeta_over_a=("run", np.full(2, value))) for value in (0.5, 1.0, 3.0)]


def with_curves(rows):
    """A table with the same curve for all lengths."""
    x = np.geomspace(0.2, 6.0, 9)
    lines = ("curve_stability", "curve_runaway", "curve_law")
    curves = {name: (("system", "curve"), [1.0 / np.sqrt(x)]) for name in lines}
    curves |= {"curve_study": ("system", ["own"]), "curve_below": ("system", ["rigid"])}
    curves |= {"curve_height": ("system", [0.02]), "curve_half_spaces": ("system", [False])}
    curves["curve_ratio"] = ("curve", x)
    return xr.concat(rows, dim="run").merge(xr.Dataset(curves))


def test_the_figure_has_a_panel_for_each_base_with_curves():
    rows = drawn_rows()
    alone = rows[0].assign(height=("run", np.full(2, 1.0)))  # of one weakening: no curve
    table = with_curves([*rows, alone])
    (axes,) = figure_weakening.draw(table).axes
    x = table["curve_ratio"].values
    for line in axes.lines[:3]:
        np.testing.assert_array_equal(line.get_xydata(), np.transpose([x, 1.0 / np.sqrt(x)]))
    points = [container.lines[0] for container in axes.containers]
    assert [float(point.get_xdata()[0]) for point in points] == [0.5, 1.0, 3.0]
    assert points[0].get_ydata() == pytest.approx(0.75)


@pytest.mark.slow
def test_curves_of_a_thin_layer_and_of_half_spaces():
    """L_s of a thin layer is that of the thin limit; high blocks have the curves of half-spaces."""
    law = {"friction_law": "dieterich_ruina", "strength": 1e-4, "perturbation": "normal_load"}
    thin = PAPER_RUN.replaced(**(law | {"height": 0.002}))
    high = PAPER_RUN.replaced(**(law | {"height": 3.0, "second_body": "deformable"}))
    same = {"study": "own", "critical_length": 0.5}
    runs = [same | {"parameters": parameters.to_dict()} for parameters in (thin, high)]
    found = weakening_curves(runs, [2.5, 6.0])
    assert set(found) == set(WEAKENING_CURVES)
    assert found["curve_half_spaces"].values.tolist() == [False, True]
    limits = [thin_limit(ratio)[0] for ratio in (2.5, 6.0)]
    np.testing.assert_allclose(found["curve_stability"][0], limits, rtol=0.05)
    higher = high.replaced(height=600.0, second_height=600.0)
    runs[1] = runs[1] | {"parameters": higher.to_dict()}
    again = weakening_curves(runs[1:], [2.5, 6.0])
    np.testing.assert_allclose(again["curve_law"][0], found["curve_law"][1], rtol=1e-2)
    assert np.isnan(found["curve_runaway"]).all()


FAULTS = [STRONG, STRONG.replaced(strength=1e-5)]
RUNS = [{"parameters": parameters.to_dict()} for parameters in FAULTS]


def drops(lengths):
    """The study's table: a list of lengths (m) for each fault."""
    digests = [ensemble(FAULTS[i]) for i, own in enumerate(lengths) for _ in own]
    count = len(digests)
    columns = {name: np.zeros(count) for name in OTHER_FAULTS if name not in EXPECTED}
    columns |= {"length": np.concatenate(lengths), "ensemble": np.array(digests)}
    columns["reached_length"] = np.nan_to_num(columns["length"], nan=0.9)
    columns |= {"zeta": np.full(count, 0.014), "a": np.full(count, 0.007)}
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


def test_each_fault_has_its_own_realisations():
    known = [expected_drop(parameters) for parameters in FAULTS]
    first = [known[0].low, known[0].high, 1.01 * known[0].high, 0.5]
    second = [1.001 * known[1].low, 0.999 * known[1].low]
    found = gather_other_faults(drops([first, second]), RUNS)
    assert found["realisations"].values.tolist() == [4, 2]
    assert found["inside"].values.tolist() == [2, 1]
    np.testing.assert_allclose(found["length"], [np.mean(first), np.mean(second)])
    np.testing.assert_allclose(found["expected_length"], [one.length for one in known])
    alone = gather_other_faults(drops([[known[0].length, np.nan]]), RUNS[:1])  # one has no drop
    assert alone["inside"].values.tolist() == [1] and np.isnan(alone["length"])
    assert alone["reached_length"].values.tolist() == [0.9]
    np.testing.assert_allclose(found["zeta_over_a"], 2.0)
