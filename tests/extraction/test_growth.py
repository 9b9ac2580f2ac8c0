"""Where growth of the patch begins: few frames instead of all, and the fit at the crossing."""

import dataclasses
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from nucleation.extraction import growth
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.growth import FITTED, fitted_crossing, follow_patch, rough_crossing
from nucleation.model.friction import Friction
from nucleation.model.heterogeneity import Heterogeneity
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.recording import Recorder
from nucleation.simulation.run import instants, simulate
from nucleation.simulation.start import composed
from nucleation.theory.creep.lengths import stability_point
from replication.configuration.runs import StudyRun
from replication.tables.ratios import STABILITY, gather_stability

pytestmark = pytest.mark.slow
PARAMETERS = PAPER_RUN.replaced(
    height=0.02, block_length=1.8, n_x=120, n_y=6, end_time=11.0, tolerance=5e-2
)
THEORY = 0.451  # m


@pytest.fixture(scope="module")
def simulation():
    return simulate(PARAMETERS)


@pytest.fixture(scope="module")
def followed(simulation):
    return follow_patch(simulation, ExtractionSettings())


def test_growth_begins_at_half_of_the_theory_in_a_mode_of_half_a_wave(followed):
    length = float(followed["stability_length"])
    assert 0.5 < length / THEORY < 0.62
    assert followed["stability_length_low"] < length < followed["stability_length_high"]
    assert 5.0 < followed["stability_frequency"] < 20.0
    mode = np.hypot(followed["mode_real"].values, followed["mode_imaginary"].values)
    assert mode.max() == pytest.approx(1.0)
    assert 0.3 * length < followed["x"].values[mode.argmax()] < 0.9 * length
    assert mode[0] == 0.0
    assert (mode[followed["x"].values > length + 0.04] == 0.0).all()
    changes = np.diff(mode[: int(length / 0.015)])
    assert (np.diff(np.sign(changes)) != 0).sum() == 1  # one maximum


def test_few_frames_equal_all_frames(simulation, followed, monkeypatch):
    monkeypatch.setattr(growth, "SCANNED", 10**6)
    monkeypatch.setattr(growth, "NEAR", 10**6)
    every = follow_patch(simulation, ExtractionSettings())
    assert followed.sizes["instant"] <= 100 < every.sizes["instant"]
    for name in ("oscillation_growth", "growth_rate"):
        known = dict(zip(every["instant_time"].values, every[name].values, strict=True))
        again = [known[time] for time in followed["instant_time"].values]
        np.testing.assert_array_equal(followed[name], again)
    expected = float(every["stability_length"])
    assert float(followed["stability_length"]) == pytest.approx(expected, rel=0.015)


def test_rough_crossing_ignores_single_instants_and_gaps():
    growth = np.array([-3.0, np.nan, 0.5, -1.0, -0.5, 0.1, 0.7, -5.0, 2.0, 3.0])
    assert rough_crossing(np.arange(10.0), growth) == 5.0
    assert np.isnan(rough_crossing(np.arange(7.0), -np.ones(7)))
    assert np.isnan(rough_crossing(np.arange(7.0), np.ones(7)))
    assert np.isnan(rough_crossing(np.arange(7.0), np.full(7, np.nan)))


def test_a_narrow_window_of_oscillation_is_found():
    """Between two of the instants scanned the pair begins to grow, and stops to oscillate."""
    growth_begins, length = 0.31, np.linspace(0.1, 0.6, 4001)

    def rates(frames):
        near = length[frames] - growth_begins
        fastest = np.where(near > 0.0, 300.0 * near, -0.01) + 0j
        return fastest, np.where(np.abs(near) < 0.004, 300.0 * near + 9j, np.nan + 0j)

    found, frame = growth.beginning_of_growth(np.arange(length.size), length, rates)
    assert found["stability_length"] == pytest.approx(growth_begins, rel=1e-6)
    assert length[frame] == pytest.approx(growth_begins, abs=5e-4)


def test_line_through_the_crossing():
    length = np.linspace(0.17, 0.23, 601)
    exact = 3.0 * (length - 0.2) + 1j * (12.0 - 20.0 * (length - 0.2))
    fit = fitted_crossing(length, exact)
    expected = (0.2, 0.2, 0.2, 0.0, 12.0)
    np.testing.assert_allclose([fit[name] for name in FITTED], expected, atol=1e-12)
    # growth that varies within each hop widens the range by its standard deviation over the slope
    shaken = exact + 0.06 * np.sin(2 * np.pi * length / 0.002)
    fit = fitted_crossing(length, shaken)
    assert fit["stability_length"] == pytest.approx(0.2, abs=2e-3)
    width = fit["stability_length_high"] - fit["stability_length"]
    assert width == pytest.approx(0.06 / np.sqrt(2.0) / 3.0, rel=0.05)
    assert fit["stability_length_error"] < 0.3 * width
    for few in (length < 0.1702, length < 0.19):  # too few, and none beyond the crossing
        assert np.isnan(fitted_crossing(length[few], exact[few])["stability_length"])
    assert np.isnan(fitted_crossing(length, -exact)["stability_length"])


def test_table_compares_with_the_reference_study():
    """Of the same fault alone: neither of another height nor of another material."""
    stiff = {"shear_modulus": 9e9}
    declared = [("paper", {}, 0.22), ("converged", {}, 0.2), ("paper", {"height": 0.1}, 0.5)]
    declared += [("converged", stiff, 0.8), ("paper", stiff, 0.84)]
    runs, patches = [], []
    for role, changes, length in declared:
        own = PARAMETERS.replaced(**changes)
        runs.append(StudyRun(role, "mine", own, 0.4, PARAMETERS.fault, role=role).to_dict())
        patches.append(xr.Dataset(dict.fromkeys(FITTED, 1.0) | {"stability_length": length}))
    table = gather_stability(runs, patches)
    assert set(table.data_vars) == set(STABILITY)
    np.testing.assert_allclose(table["stability_ratio"], [0.55, 0.5, 1.25, 2.0, 2.1])
    np.testing.assert_allclose(table["stability_change"], [0.1, 0.0, np.nan, 0.0, 0.05], atol=1e-12)


LAW = Friction(law="dieterich_ruina", slip_distance=1.25e-7)
WEAK = Heterogeneity(varies="friction", change=-0.8, width=0.25)
LOADED = PAPER_RUN.replaced(
    loading="remote",
    stress_rate=1e5,
    initial_state=0.01,
    initial_stress="uniform_shear",
    initial_shear_stress=7.5e4,
    height=0.1,
    block_length=1.2,
    n_x=161,
    n_y=6,
    grading=4.0,
    second_body="deformable",
)


def test_a_patch_in_the_interior_turns_unstable_where_theory_says():
    """It begins where the fault is weakest: the numbers of docs/creeping_patch.md, coarser."""
    law = LAW.with_expansion(1e-5, 0.41, 0.0017, 0.0039)
    parameters = LOADED.replaced(friction_law=law, longest_step=0.4)
    parameters = replace(parameters, heterogeneity=WEAK)
    dynamics, velocity = composed(parameters), parameters.fault.velocity
    recorder = Recorder(parameters, dynamics)
    for instant in instants(parameters, dynamics=dynamics):
        recorder.record(instant.state, instant.report)
        if instant.report.interface.slip_rate.max() > 30.0 * velocity:
            break
    found = follow_patch(recorder.dataset(), ExtractionSettings())
    critical = parameters.critical_length
    theory, _ = stability_point(dataclasses.replace(parameters.patches, law=None), critical)
    assert theory == pytest.approx(float(found["stability_length"]), rel=0.04)
    assert found["stability_length_error"] < 0.03 * theory
