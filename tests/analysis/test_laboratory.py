"""Published laboratory faults: what the file may hold, and the lengths that follow."""

import math
from importlib import resources

import numpy as np
import pytest
import yaml

from nucleation.analysis import laboratory
from nucleation.analysis.laboratory import NEEDED, READ, laboratory_table, read_fault
from nucleation.api import ParameterError, critical_length, stability_length
from nucleation.figures.beyond import figure_laboratory

FAULTS = {fault.name: fault for fault in laboratory.laboratory_faults()}
ENTRIES = yaml.safe_load(
    resources.files("nucleation.analysis").joinpath("laboratory.yaml").read_text()
)
TABLE = laboratory_table(ENTRIES)
WORDS = {"title": "A (2000)", "material": "glass", "source": "doi:1", "read": "all", "says": "long"}


def entry(**quantities):
    return WORDS | {"measured": {"p. 1": quantities}}


def test_every_number_says_where_it_is_from():
    for fault in FAULTS.values():
        assert fault.title and fault.source and fault.read
        assert set(fault.numbers) == set(laboratory.ENTRIES)
        for number in fault.numbers.values():
            assert number.status in (*READ, "unknown") and number.where
            assert (number.status == "unknown") == math.isnan(number.low)


def test_what_was_not_read_is_blank():
    blank = [fault.numbers for fault in FAULTS.values() if fault.read == "not read"]
    assert blank and {n.status for numbers in blank for n in numbers.values()} == {"unknown"}


def test_lengths_only_where_all_is_known():
    rows = TABLE.to_dataframe().set_index("laboratory_fault")
    for name, fault in FAULTS.items():
        known = all(fault.numbers[n].low == fault.numbers[n].high for n in NEEDED)
        assert np.isfinite(rows.loc[name, "theory_length"]) == known == (not fault.unknown)
        assert bool(rows.loc[name, "unknown"]) == (not known)
    assert rows["theory_length"].notna().sum() == 2


@pytest.mark.parametrize("function", [critical_length, stability_length])
def test_lengths_fall_inversely_with_the_stress(function):
    """As Latour and others (2013) saw: of half-spaces; thin bodies give way as its root."""
    sample = FAULTS["pyquake3d_laboratory"].parameters
    stress = np.array([1e7, 2e7, 4e7])

    def exponents(**own):
        return np.diff(np.log(function(**sample | {"normal_stress": stress} | own))) / math.log(2.0)

    assert exponents() == pytest.approx(-1.0, abs=1e-6)
    thin = exponents(height=1e-5, second_shear_modulus=math.inf, friction=0.0)
    assert thin == pytest.approx(-0.5, abs=0.01)


def test_units_and_ranges():
    fault = read_fault("glass", entry(normal_stress=["1 MPa", "2 MPa"], a=0.01))
    assert fault.numbers["normal_stress"][:2] == (1e6, 2e6)
    assert "normal_stress" in fault.unknown and "a" not in fault.unknown


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (entry(normal_stress="1 m"), "glass.normal_stress = '1 m' is not allowed: .* Pa is needed"),
        (entry(a="-1"), r"glass.a = -1.0 is not allowed: direct-effect coefficient a must lie in"),
        (entry(stress="1 MPa"), "glass.stress is not allowed: known are shear_modulus"),
        ({"title": "A (2000)"}, r"glass: lacks \['material', 'read', 'source'\]"),
        (entry() | {"plane": "antiplane"}, "glass.plane = 'antiplane' is not allowed"),
        (WORDS | {"measured": {"a": 0.01}}, "glass.measured is not allowed: numbers stand below"),
        (WORDS | {"sure": {"p. 1": {"a": 0.01}}}, r"has \['sure'\] which is no key"),
    ],
)
def test_what_is_refused(given, said):
    with pytest.raises(ParameterError, match=said):
        read_fault("glass", given)


def test_the_figure_has_a_row_for_each_known_length():
    axes = figure_laboratory.draw(TABLE).axes[0]
    titles = [label.get_text() for label in axes.get_yticklabels()]
    lengths = np.isfinite([TABLE[n].values for n in ("fault_length", "theory_length")])
    assert titles == list(TABLE["title"].values[lengths.any(axis=0)])
    legend = [text.get_text() for text in axes.figure.legends[0].get_texts()]
    assert legend == ["fault", "$L_s$, $L_c$ of assumed numbers", "observed"]
