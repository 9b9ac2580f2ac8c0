"""Simulated lengths of the literature: how they are read, and what the committed table says."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from lengths.test_in_use import crack_coefficients

from nucleation.extraction import measures as zones
from nucleation.run.run import PAPER_RUN
from replication.tables import literature

FRAME = pd.read_csv(Path(__file__).parents[2] / "results" / "reference" / "literature.csv")


def record(x, rates, states=1.0):
    """A simulation of slip rates and states over time and x."""
    columns = {"slip_rate": rates, "state": np.broadcast_to(states, rates.shape)}
    return xr.Dataset({name: (("time", "x"), own) for name, own in columns.items()}, {"x": x})


@pytest.mark.parametrize(("name", "factor"), [("thin_layer", 2.0), ("state_evolution", 1.0)])
def test_a_zone_of_known_width_is_read_at_the_slip_rate_asked_for(name, factor):
    x = np.linspace(0.0, 1.0, 2002)
    widths, fastest = np.array([0.1, 0.2]), np.array([1e-5, 1e-3])
    shape = 0.5 ** ((x - 0.5) / (0.5 * widths[:, None])) ** 2  # half the maximum at width/2
    rates = fastest[:, None] * shape
    simulation = record(x, rates)
    found = zones.zone_length(simulation, 1e-4, zones.DEFINITIONS[name])
    assert found == pytest.approx(factor * 0.15, rel=1e-3)
    assert np.isnan(zones.zone_length(simulation, 1e-2, zones.DEFINITIONS[name]))


def test_the_fixed_length_is_read_from_the_part_of_it_that_its_solution_has_at_half_the_maximum():
    """The edges of ``|x| < 1.3774 L_b`` are beyond what a slip rate shows."""
    n, c = crack_coefficients(1.3774)
    x = np.linspace(0.0, 0.999, 2000)
    v = np.sin(np.outer(np.arccos(x), n)) @ c
    part = zones.DEFINITIONS["rubin_ampuero_localised"].part
    assert part == pytest.approx(np.interp(-0.5, -v / v[0], x), rel=1e-3)


def test_a_crack_is_read_between_its_tips_though_slip_is_slow_within():
    """The tips are at 0.3 and 0.7; the middle is slower than a tenth of them."""
    x = np.linspace(0.0, 1.0, 2001)
    tips = 0.5 ** ((x - 0.3) / 0.01) ** 2 + 0.999 * 0.5 ** ((x - 0.7) / 0.01) ** 2
    shape = np.maximum(tips, np.where(abs(x - 0.5) < 0.2, 0.02, 0.0))
    rates = np.array([1e-5, 1e-3])[:, None] * shape
    found = zones.zone_length(record(x, rates), 1e-4, zones.DEFINITIONS["rubin_ampuero_crack"])
    assert found == pytest.approx(0.4 + 2 * 0.01 * np.sqrt(np.log2(10.0)), abs=1e-3)


def test_far_ahead_is_read_half_a_period_from_the_fastest_point():
    x = np.linspace(0.0, 1.0, 101)
    away = np.abs((x - 0.2 + 0.5) % 1.0 - 0.5)  # from x = 0.2; half a period away is x = 0.7
    rates = np.array([1e-6, 1e-2])[:, None] * np.exp(-20.0 * away)
    states = np.array([2.0, 4.0])[:, None] * (1.0 + away)
    simulation = record(x, rates, states)
    rate, state_ratio = zones.far_ahead(simulation, 1e-4, 5e-7)
    mean = 0.5 * (1e-6 + 1e-2) * np.exp(-10.0)  # linear in log of the largest rate: half way
    assert rate == pytest.approx(mean, rel=1e-6)
    assert state_ratio == pytest.approx(mean * 3.0 * 1.5 / 5e-7, rel=1e-6)
    assert np.isnan(zones.far_ahead(simulation, 1.0, 5e-7)).all()
    stuck = simulation.assign(slip_rate=simulation["slip_rate"].where(away < 0.4, 0.0))
    assert np.isnan(zones.far_ahead(stuck, 1e-4, 5e-7)).all()


def test_a_zone_that_expands_before_steady_state_is_nearer_to_the_length_of_its_slip_rate():
    """v phi/D of 13 far ahead: the asymptote is far away."""
    away = FRAME[(FRAME["name"] == "rubin_ampuero_crack") & (FRAME["far_state_ratio"] > 5.0)]
    ratio = away["simulated_length"] / away["finite_speed_length"]
    assert len(away) == len(literature.SLIP_RATES)
    assert (abs(np.log(ratio)) < abs(np.log1p(away["difference"]))).all()


SETTINGS = {
    "thin_layer": {"second_body": "rigid"},
    "state_evolution": {"second_body": "deformable", "evolution": "slip"},
    "rubin_ampuero_localised": {"second_body": "deformable", "zeta_over_a": 4.0},
    "rubin_ampuero_crack": {"second_body": "deformable", "zeta_over_a": 0.5},
    "between both": {"second_body": "deformable", "zeta_over_a": 1.2},
}


def test_a_run_is_read_as_the_length_whose_setting_it_is():
    x = np.linspace(0.0, 1.0, 401)
    rate = np.array([1e-6, 2e3])[:, None] * 0.5 ** ((x - 0.5) / 0.05) ** 2
    simulation = record(x, rate)
    runs = []
    for name, changes in SETTINGS.items():
        ratio = changes.get("zeta_over_a", 2.0)
        constants = {"friction": 0.41, "a": 0.0068, "zeta_over_a": ratio}
        parameters = PAPER_RUN.replaced(**changes | constants)
        runs.append({"id": name, "parameters": parameters.to_dict()})
    read = literature.literature_table(runs, [simulation] * len(runs)).to_dataframe()
    assert list(read["id"].unique()) == [*SETTINGS]
    assert list(read["name"].unique()) == [*SETTINGS][:-1]
    assert len(read) == len(SETTINGS) * len(literature.SLIP_RATES)
    gap = read[read["id"] == "between both"]  # beside the fixed length, which does not hold there
    assert set(gap["name"]) == {"rubin_ampuero_localised"} and (gap["formula_length"] > 0.0).all()
    assert gap["definition"].str.contains("beyond its limit").all()
    difference = read["simulated_length"] / read["formula_length"] - 1.0
    np.testing.assert_allclose(read["difference"], difference)
    thin = read[read["name"] == "thin_layer"]  # twice the width at half of the maximum, 0.1 m
    np.testing.assert_allclose(thin["simulated_length"], 0.2, rtol=1e-2)
