"""Simulated lengths of the literature: how they are read, and what the committed table says."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from answers.test_in_use import crack_coefficients

from nucleation.analysis import literature
from nucleation.answers.in_use import LENGTHS
from nucleation.figures.beyond import figure_literature
from nucleation.model.friction.law import Friction
from nucleation.model.parameters import Parameters

FRAME = pd.read_csv(Path(__file__).parents[2] / "results" / "reference" / "literature.csv")


@pytest.mark.parametrize(("name", "factor"), [("thin_layer", 2.0), ("state_evolution", 1.0)])
def test_a_zone_of_known_width_is_read_at_the_slip_rate_asked_for(name, factor):
    x = np.linspace(0.0, 1.0, 2002)
    widths, fastest = np.array([0.1, 0.2]), np.array([1e-5, 1e-3])
    shape = 0.5 ** ((x - 0.5) / (0.5 * widths[:, None])) ** 2  # half the maximum at width/2
    simulation = xr.Dataset({"slip_rate": (("time", "x"), fastest[:, None] * shape)}, {"x": x})
    found = literature.zone_length(simulation, 1e-4, literature.DEFINITIONS[name])
    assert found == pytest.approx(factor * 0.15, rel=1e-3)
    assert np.isnan(literature.zone_length(simulation, 1e-2, literature.DEFINITIONS[name]))


def test_the_fixed_length_is_read_from_the_part_of_it_that_its_solution_has_at_half_the_maximum():
    """The edges of ``|x| < 1.3774 L_b`` are beyond what a slip rate shows."""
    n, c = crack_coefficients(1.3774)
    x = np.linspace(0.0, 0.999, 2000)
    v = np.sin(np.outer(np.arccos(x), n)) @ c
    part = literature.DEFINITIONS["rubin_ampuero_localised"].part
    assert part == pytest.approx(np.interp(-0.5, -v / v[0], x), rel=1e-3)


def test_every_length_in_use_has_a_row_and_those_without_a_run_a_reason():
    assert {length.key for length in LENGTHS} == set(FRAME["name"])
    assert FRAME["definition"].notna().all()


def test_asymptotes_are_met_where_their_source_claims_them():
    late = FRAME[np.isclose(FRAME["read_at"], 0.1)].set_index("name")["difference"]
    assert late[["rubin_ampuero_localised", "thin_layer"]].abs().max() < 0.05


def test_the_figure_draws_every_simulated_length():
    table = xr.Dataset({name: ("run", FRAME[name]) for name in FRAME})
    left, right = figure_literature.draw(table).axes
    assert [line.get_label() for line in left.lines[:4]] == [
        kind[0] for kind in figure_literature.KINDS.values()
    ]
    assert len(right.lines) > 8


SETTINGS = {
    "thin_layer": {"second_body": "rigid"},
    "state_evolution": {"second_body": "deformable", "evolution": "slip"},
    "rubin_ampuero_localised": {"second_body": "deformable", "zeta_over_a": 4.0},
    "rubin_ampuero_crack": {"second_body": "deformable", "zeta_over_a": 0.5},
    "between both": {"second_body": "deformable", "zeta_over_a": 1.2},
}


def test_a_run_is_read_as_the_length_whose_setting_it_is():
    """Beside its formula; lengths without a run have their reason, and what is none has no row."""
    x = np.linspace(0.0, 1.0, 401)
    rate = np.array([1e-6, 1.0])[:, None] * 0.5 ** ((x - 0.5) / 0.05) ** 2
    simulation = xr.Dataset({"slip_rate": (("time", "x"), rate)}, {"x": x})
    runs = []
    for name, changes in SETTINGS.items():
        ratio = changes.get("zeta_over_a", 2.0)
        friction = Friction().with_expansion(1e-5, 0.41, 0.0068, ratio * 0.0068)
        own = {key: value for key, value in changes.items() if key != "zeta_over_a"}
        parameters = Parameters(friction=friction).replaced(own)
        runs.append({"id": name, "parameters": parameters.to_dict()})
    table = literature.literature_table(runs, [simulation] * len(runs)).to_dataframe()
    read = table[table["id"] != ""]
    assert list(read["id"].unique()) == list(read["name"].unique()) == [*SETTINGS][:-1]
    assert len(read) == 4 * len(literature.SLIP_RATES)
    difference = read["simulated_length"] / read["formula_length"] - 1.0
    np.testing.assert_allclose(read["difference"], difference)
    thin = read[read["name"] == "thin_layer"]  # twice the width at half of the maximum, 0.1 m
    np.testing.assert_allclose(thin["simulated_length"], 0.2, rtol=1e-2)
    others = table[table["id"] == ""]
    assert {*others["name"]} == {length.key for length in LENGTHS} - {*SETTINGS}
    assert others["definition"].ne("").all() and others["simulated_length"].isna().all()
