"""The project's solver against an independent one: the same block solved by FreeFem++.

The two codes share nothing but the problem: elements, time integration, linear algebra and the
treatment of the interface differ. At the same nodes along x they have to agree before the event.
"""

import shutil
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from benchmarks.crosscheck.__main__ import RUNS, runs
from benchmarks.crosscheck.freefem import PROGRAM, FreeFemError, arguments, solve
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.run import simulate

ROOT = Path(__file__).parents[2]
REFERENCE = pd.read_csv(ROOT / "results" / "reference" / "crosscheck.csv", index_col="id")
END = 2.0  # s
PARAMETERS = PAPER_RUN.replaced(height=0.005, block_length=0.5, n_x=100, n_y=4, end_time=END)


@pytest.mark.skipif(not shutil.which(PROGRAM), reason="FreeFem++ is not installed")
def test_both_solvers_agree_on_the_block(tmp_path):
    """On f_d, and on the creeping nodes, two nodes from either end."""
    own, theirs = simulate(PARAMETERS), solve(tmp_path, PARAMETERS)
    times = np.linspace(0.2, END, 200)
    first, second = (
        np.interp(times, run["step_time"].values, run["driving_force"].values)
        for run in (own, theirs)
    )
    np.testing.assert_allclose(second, first, rtol=0.01)
    stresses = dict.fromkeys(("shear_stress", "sigma_yy"), 0.01)
    for name, tolerance in ({"slip_rate": 0.03, "slip": 0.02, "state": 0.03} | stresses).items():
        first, second = (run[name].isel(time=-1).values[2:9] for run in (own, theirs))
        np.testing.assert_allclose(second, first, rtol=tolerance, err_msg=name)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"perturbation": "strength"}, "perturbation = none, drive_velocity"),
        ({"evolution": "slip"}, "evolution = aging only"),
        ({"second_body": "deformable", "second_grading": 4.0}, "second_grading = 1.0 only"),
    ],
)
def test_what_the_other_solver_lacks_is_refused(changes, words):
    with pytest.raises(FreeFemError, match=words):
        arguments(PARAMETERS.replaced(**changes))


def test_the_solvers_agree_on_the_drop():
    """Under one and the same perturbation, onset and length within 0.3 %, on the script's runs."""
    assert list(REFERENCE.index) == [*RUNS]
    own = [(run.fault.height, run.block.n_x, run.block.n_y) for run in runs().values()]
    np.testing.assert_allclose(REFERENCE[["height", "n_x", "n_y"]], own)
    for name in ("onset_time", "length"):
        np.testing.assert_allclose(REFERENCE[f"{name}_freefem"], REFERENCE[name], rtol=3e-3)


QUANTITIES = {
    "$L(t)$, rms difference": ("patch_length_rms", "{:.2f} %", 100.0),
    "$L(t)$, largest difference (elements)": ("patch_length_elements", "{:.2f}", 1.0),
    "$f_d(t)$, largest difference": ("driving_force_largest", "{:#.2g} %", 100.0),
}


def test_page_states_the_reference():
    """Every number of the table in docs/verification.md is that of the reference set."""
    page = (ROOT / "docs" / "verification.md").read_text(encoding="utf-8")
    for label, (name, form, scale) in QUANTITIES.items():
        values = REFERENCE[name]
        cells = ["–" if np.isnan(value) else form.format(scale * value) for value in values]
        assert f"| {label} | {' | '.join(cells)} |" in page
    for name, words in {"onset_time": "onset", "length": "$L$"}.items():
        apart = (REFERENCE[f"{name}_freefem"] / REFERENCE[name] - 1.0).abs()
        cells = [f"{100.0 * value:#.2g} %" for value in apart]
        assert f"| {words}, difference | {' | '.join(cells)} |" in page
