"""The project's solver against an independent one: the same block solved by FreeFem++.

The two codes share nothing but the problem: elements, time integration, linear algebra and the
treatment of the interface differ. At the same nodes along x they have to agree before the event.
"""

import dataclasses
import os
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from configurations import papers

from nucleation.datasets.variables import DatasetError
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.record import Record
from nucleation.model.parameters import Geometry, Mesh, Parameters, Stepping
from nucleation.model.perturbation import IN_TIME, Perturbation
from nucleation.model.second_body import SecondBody
from nucleation.simulation.run import simulate
from replication.verification.crosscheck import compare, freefem
from replication.verification.crosscheck.plan import CrosscheckSettings, runs

pytestmark = pytest.mark.system

ROOT = Path(__file__).parents[2]
SCRIPTS = ROOT / "workflow" / "crosscheck"
REFERENCE = pd.read_csv(ROOT / "results" / "reference" / "crosscheck.csv", index_col="id")
END = 2.0  # s
PARAMETERS = Parameters(
    geometry=Geometry(height=0.005, length=0.5),
    mesh=Mesh(n_x=100, n_y=4),
    stepping=Stepping(end_time=END),
)

PAIR = Parameters(
    geometry=Geometry(height=0.02, length=0.15),
    mesh=Mesh(n_x=60, n_y=4),
    stepping=Stepping(end_time=1.0),
    perturbation=Perturbation(kind="normal_load", strength=0.01, seed=2),
    second_body=SecondBody(
        kind="deformable", shear_modulus=6.2e9, poisson_ratio=0.2, density=2000.0, height=0.03,
        n_y=6,
    ),
)  # fmt: skip


def solved_by_freefem(directory, parameters=PARAMETERS):
    """The record of FreeFem++. It may be missing on a developer's machine, but not in CI."""
    if not freefem.installed() and os.environ.get("CI") != "true":
        pytest.skip(freefem.MISSING)
    return freefem.solve(SCRIPTS, directory, parameters, CrosscheckSettings())


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    """The record of both solvers, over some thousand steps."""
    theirs = solved_by_freefem(tmp_path_factory.mktemp("freefem"))
    return simulate(PARAMETERS), theirs


def at_end(record, name):
    """A field of the interface at the end of the run, at the same nodes for both solvers."""
    return record[name].isel(time=-1).values


def forces_at(times, records):
    return [np.interp(times, r["step_time"].values, r["driving_force"].values) for r in records]


def difference_of_forces(records, times):
    first, second = forces_at(times, records)
    return second / first - 1.0


def rms_of(values):
    return np.sqrt(np.mean(values**2))


def test_both_solvers_agree_on_the_block(pair):
    """On f_d, on L(t) to a hop, and on the creeping nodes, two nodes from either end."""
    times = np.linspace(0.2, END, 200)
    difference = difference_of_forces(pair, times)
    assert np.abs(difference).max() < 0.01 and rms_of(difference) < 0.004
    edges = [np.interp(times, r.time, r.lengths) for r in map(Record, pair)]
    dx = PARAMETERS.geometry.length / PARAMETERS.mesh.n_x
    assert np.abs(edges[1] - edges[0]).max() < dx
    assert edges[0][-1] > 10.0 * dx
    own, theirs = pair
    stresses = dict.fromkeys(("shear_stress", "sigma_yy"), 0.01)
    for name, tolerance in ({"slip_rate": 0.03, "slip": 0.02, "state": 0.03} | stresses).items():
        first, second = at_end(own, name)[2:9], at_end(theirs, name)[2:9]
        np.testing.assert_allclose(second, first, rtol=tolerance, err_msg=name)
    assert has_friction_of(theirs, PARAMETERS.friction)


def has_friction_of(record, friction):
    """Whether shear over normal stress is a friction law of this project at every node."""
    last = record.isel(time=-1)
    found = -last["shear_stress"] / last["sigma_yy"]
    coefficient = friction.coefficient(last["slip_rate"], last["state"])
    return np.allclose(found, coefficient, rtol=1e-6, atol=1e-9)


def test_every_parameter_reaches_the_other_solver(tmp_path):
    """Numbers that all differ from the defaults arrive, and the two solvers agree on them."""
    changed = PARAMETERS.replaced(
        {"poisson_ratio": 0.2, "shear_modulus": 2e9, "slip_distance": 6e-7,
         "aging_coefficient": 0.06, "slip_rate_scale": 2e-7, "base_friction": 0.3,
         "state_scale": 5e-4, "regularisation_slip_rate": 2e-9, "rate_coefficient": 0.006,
         "normal_stress": 8e5, "velocity": 2e-5, "initial_state": 3.0, "height": 0.006,
         "n_x": 80, "end_time": 0.5}
    )  # fmt: skip
    theirs = solved_by_freefem(tmp_path, changed)
    own = simulate(changed)
    assert abs(float(theirs["driving_force"][-1] / own["driving_force"][-1]) - 1.0) < 0.01
    assert has_friction_of(theirs, changed.friction)
    assert at_end(theirs, "slip_rate")[0] == changed.loading.velocity
    assert at_end(theirs, "state")[0] == pytest.approx(changed.memory_time, rel=1e-3)  # D/V
    ahead = slice(40, 70)  # nothing happens there
    assert at_end(theirs, "state")[ahead] == pytest.approx(3.5, rel=0.01)  # it ages
    assert at_end(theirs, "sigma_yy")[ahead] == pytest.approx(-8e5, rel=1e-3)


SHAKEN = PARAMETERS.replaced({"n_x": 80, "n_y": 4, "end_time": 0.4})
STRONG = 0.05  # relative strength: seen beside the differences of the elements


@pytest.fixture(scope="module")
def quiet_forces(tmp_path_factory):
    """Driving forces of both solvers where nothing is perturbed."""
    return forces_of_both(SHAKEN, tmp_path_factory.mktemp("quiet"))


def forces_of_both(parameters, directory):
    records = simulate(parameters), solved_by_freefem(directory, parameters)
    return forces_at(np.linspace(0.1, 0.4, 200), records)


@pytest.mark.parametrize("kind", IN_TIME)
def test_both_solvers_run_under_the_same_realisation(tmp_path, quiet_forces, kind):
    """What a perturbation adds to the driving force is the same by both, and not next to nothing"""
    declared = Perturbation(kind=kind, strength=STRONG, seed=3)
    shaken = forces_of_both(dataclasses.replace(SHAKEN, perturbation=declared), tmp_path)
    own, theirs = (one - before for one, before in zip(shaken, quiet_forces, strict=True))
    assert np.abs(own).max() > 5e-4 * np.abs(quiet_forces[0]).max()
    # while one front has hopped to the next node and the other has not, they differ by more
    assert np.median(np.abs(theirs - own)) < 0.1 * np.abs(own).max()


@pytest.mark.parametrize(
    ("parameters", "changes", "words"),
    [
        (PARAMETERS, {"perturbation": "strength"}, "kind = none, drive_velocity"),
        (PARAMETERS, {"evolution": "slip"}, "evolution = aging only"),
        (PAIR, {"second_body.grading": 4.0}, r"second_body.grading = 1.0 only"),
    ],
)
def test_what_the_other_solver_lacks_is_refused(parameters, changes, words):
    with pytest.raises(freefem.FreeFemError, match=words):
        freefem.arguments(parameters.replaced(changes), CrosscheckSettings(), ExtractionSettings())


@pytest.mark.parametrize(("bottom", "rms"), [("free", 0.05), ("clamped", 5e-3), ("roller", 5e-3)])
def test_both_solvers_agree_on_a_pair(tmp_path, bottom, rms):
    """Two blocks that differ in everything, under a load that fluctuates, with each far side.

    A pair that nothing holds bends, for which so few rows of triangles are 3 % too stiff.
    """
    parameters = PAIR.replaced({"second_body.far_side": bottom, "end_time": 1.0})
    own, theirs = simulate(parameters), solved_by_freefem(tmp_path, parameters)
    assert rms_of(difference_of_forces((own, theirs), np.linspace(0.2, 1.0, 100))) < rms
    for name, tolerance in {"slip_rate": 0.1, "slip": 0.1, "sigma_yy": 0.04}.items():
        first, second = at_end(own, name)[4:10], at_end(theirs, name)[4:10]
        np.testing.assert_allclose(second, first, rtol=tolerance, err_msg=name)
    assert has_friction_of(theirs, parameters.friction)


def test_comparison_of_two_records(pair):
    """A run without an event has no differences. A drop and fast slip make an event."""
    own = simulate(PARAMETERS)
    row = compare.compare(own, pair[1])
    assert set(row) == set(compare.COLUMNS) - {"id"}
    assert np.isnan(row["onset_time"]) and np.isnan(row["patch_length_rms"])
    late = own["step_time"] > 0.95 * END
    own["driving_force"] = own["driving_force"].where(~late, 0.5 * own["driving_force"])
    own["maximal_slip_rate"] = own["maximal_slip_rate"].where(~late, 1e-3)  # m/s
    same = compare.compare(own, own)
    assert same["onset_time"] == same["onset_time_freefem"] < END
    assert same["patch_length_rms"] == same["driving_force_largest"] == 0.0
    scaled = own.assign(driving_force=1.02 * own["driving_force"])
    assert compare.compare(own, scaled)["driving_force_rms"] == pytest.approx(0.02)


def test_runs_by_both_solvers_are_rows_and_one_that_failed_is_named():
    own = simulate(PARAMETERS.replaced({"end_time": 0.05}))
    both = {"freefem": [own, own], "settings": ExtractionSettings()}
    table = compare.compared(["a", "b"], [own, own], **both)
    assert list(table["id"].values) == ["a", "b"]
    failed = own.assign_attrs(completed=0, status="failed: made up")
    with pytest.raises(DatasetError, match="the run b has no result: failed: made up"):
        compare.compared(["a", "b"], [own, failed], **both)


def test_without_the_other_program_it_is_said_how_to_get_it(tmp_path, monkeypatch):
    monkeypatch.setattr(freefem, "installed", lambda: False)
    with pytest.raises(freefem.FreeFemError, match=re.escape(freefem.MISSING)):
        freefem.solve(Path(), tmp_path, PARAMETERS, CrosscheckSettings(), ExtractionSettings())


def test_the_solvers_agree_on_the_drop():
    """Under one and the same perturbation, onset and L_c within 0.3 %."""
    rows = REFERENCE
    asked = runs(papers().base, papers().crosscheck, papers().main_text_interface)
    assert list(rows.index) == [*asked]
    assert list(rows["n_x"]) == [asked[name].mesh.n_x for name in rows.index]
    for name in ("onset_time", "length"):
        np.testing.assert_allclose(rows[f"{name}_freefem"], rows[name], rtol=3e-3)


QUANTITIES = {
    "$L(t)$, rms difference": ("patch_length_rms", "{:.2f} %", 100.0),
    "$L(t)$, largest difference (elements)": ("patch_length_elements", "{:.2f}", 1.0),
    "$f_d(t)$, largest difference": ("driving_force_largest", "{:#.2g} %", 100.0),
}


COLUMNS = ["H0.005", "H0.05", "pair"]


def test_page_states_the_reference():
    """Every number of the table in docs/verification.md is that of the reference set."""
    page = (ROOT / "docs" / "verification.md").read_text(encoding="utf-8")
    shown = REFERENCE.loc[COLUMNS]
    for label, (name, form, scale) in QUANTITIES.items():
        values = shown[name]
        cells = [form.format(scale * value) for value in values]
        assert f"| {label} | {' | '.join(cells)} |" in page
    for name, words in {"onset_time": "onset", "length": "$L$"}.items():
        apart = (shown[f"{name}_freefem"] / shown[name] - 1.0).abs()
        cells = [f"{100.0 * value:#.2g} %" for value in apart]
        assert f"| {words}, difference | {' | '.join(cells)} |" in page
