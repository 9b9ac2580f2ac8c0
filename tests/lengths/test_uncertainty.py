"""Quantiles of lengths against closed forms; what is drawn, counted and refused."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import norm

from nucleation.api import (
    critical_length,
    length_quantiles,
    lengths_in_use,
    read_samples,
    stability_length,
)
from nucleation.lengths.draws import draw
from nucleation.lengths.uncertainty import QUANTILES
from nucleation.model.quantities import ParameterError

FAULT = {"shear_modulus": 30e9, "poisson_ratio": 0.25, "normal_stress": 50e6}
FRICTION = {"a": 0.010, "zeta": 0.005}
KNOWN = FAULT | FRICTION
MEDIAN = math.pi * 40e9 * 5e-6 / (0.005 * 50e6)  # L_c (m) at D = 5 um, Eq. (6)


def of(found, key):
    return found["value"].sel(key=key).values


@pytest.mark.slow
def test_a_distance_of_a_range():
    """L_c is proportional to D: the range's own quantiles, with unequal sides."""
    found = length_quantiles(**KNOWN, slip_distance="5um (4 to 10um)", draws=151)
    below, above = math.log(5 / 4) / norm.ppf(0.95), math.log(10 / 5) / norm.ppf(0.95)
    expected = [MEDIAN * math.exp((below if q < 0.5 else above) * norm.ppf(q)) for q in QUANTILES]
    assert_allclose(of(found, "critical_length"), expected, rtol=1e-3)
    assert_allclose(of(found, "rice_ruina"), np.array(expected) / 4, rtol=1e-3)
    assert (found.sizes["quantile"], found.attrs["invalid"], found.attrs["stable"]) == (5, 0, 0)
    ratio = float(stability_length(**KNOWN, slip_distance=5e-6)) / MEDIAN
    assert_allclose(of(found, "stability_length"), np.array(expected) * ratio, rtol=1e-3)


def test_two_ranges_are_independent():
    """The logarithms' variances add up."""
    uncertain = {"slip_distance": "5um (4 to 6.25)", "normal_stress": "50MPa (32 to 78.125)"}
    lengths = critical_length(**draw(KNOWN | uncertain, draws=4000).values)
    width = math.hypot(math.log(1.25), math.log(1.5625)) / norm.ppf(0.95)
    expected = MEDIAN * np.exp(width * norm.ppf(QUANTILES))
    assert_allclose(np.quantile(lengths, QUANTILES), expected, rtol=0.03)


@pytest.mark.slow
def test_a_signed_parameter_is_normal_and_may_be_stable():
    """A stable draw has an infinite length: quantiles are those of zeta from its other end."""
    uncertain = {"zeta": "0.005 (-0.001 to 0.011)", "slip_distance": 5e-6}
    found = length_quantiles(**FAULT, a=0.01, **uncertain, draws=100)
    width = 0.006 / norm.ppf(0.95)
    negative = norm.cdf(-0.005 / width)
    share = float(found["share"].sel(key="critical_length"))
    assert share == pytest.approx(1 - negative, abs=0.006)
    assert found.attrs["stable"] == round(100 * (1 - share))
    zeta = 0.005 + width * norm.ppf(1.0 - np.array(QUANTILES))
    expected = np.where(zeta > 0.0, MEDIAN * 0.005 / zeta, np.inf)
    for key in ("critical_length", "homogeneous_sliding"):
        assert_allclose(of(found, key)[:4], expected[:4], rtol=0.03)
        assert np.isinf(of(found, key)[4]) and np.isinf(expected[4])
    assert_allclose(of(found, "critical_length")[2], MEDIAN, rtol=0.02)
    assert np.isfinite(found["error"].sel(key="critical_length")[:3]).all()
    assert np.isinf(found["error"].sel(key="critical_length")[4])


@pytest.mark.slow
def test_quantiles_hold_within_their_errors():
    """Of other seeds, and of ten times as many draws: not more than three errors off."""
    uncertain = KNOWN | {"slip_distance": "5um (3 to 10)", "normal_stress": "50MPa (20 to 90)"}
    lengths = {"draws": 200}
    few = [length_quantiles(**uncertain, **lengths, seed=seed).sel(key="critical_length")
           for seed in range(5)]  # fmt: skip
    many = critical_length(**draw(uncertain, draws=20000).values)
    exact = np.quantile(many, QUANTILES)
    for found in few:
        off = np.abs(found["value"].values - exact)
        assert (off < 3.0 * found["error"].values).all()
    scatter = np.std([found["value"].values for found in few], axis=0)
    stated = few[0]["error"].values
    assert (scatter < 2.0 * stated).all() and (stated < 0.2 * exact).all()


def test_samples_are_joint():
    """Of each row its own length; an infinite height is a half-space."""
    rows = {
        "friction": [0.6, 0.5, 0.7],
        "normal_stress": [4e7, 5e7, 6e7],
        "height": [0.1, np.inf, 10.0],
    }
    own = FAULT | {"a": 0.01, "zeta": [0.005, 0.004, 0.003], "slip_distance": 5e-6}
    found = length_quantiles(**own | {k: np.array(v) for k, v in rows.items()})
    each = lengths_in_use(**own | rows)
    for key, other in (("stability_length", "stability_length"), ("loaded_patch", "loaded_patch")):
        expected = np.quantile(each[other], QUANTILES, method="hazen")
        assert_allclose(of(found, key), expected, rtol=1e-12)


def test_draws_repeat_and_do_not_depend_on_other_ranges():
    one = KNOWN | {"slip_distance": "5um (4 to 10)"}
    first, again, other = draw(one), draw(one), draw(one, seed=1)
    more = draw(
        {"poisson_ratio": "0.25 (0.2 to 0.3)"} | one | {"poisson_ratio": "0.2 (0.1 to 0.3)"}
    )
    for drawn in (again, more):
        assert np.array_equal(first.values["slip_distance"], drawn.values["slip_distance"])
    assert not np.array_equal(first.values["slip_distance"], other.values["slip_distance"])


def test_invalid_draws_are_left_out_and_counted():
    uncertain = KNOWN | {"poisson_ratio": "0.45 (0.4 to 0.5)", "slip_distance": 5e-6}
    with pytest.raises(ParameterError, match=r"0.5.*must lie in"):
        length_quantiles(**uncertain)
    found = length_quantiles(**uncertain | {"poisson_ratio": "0.45 (0.35 to 0.499)"}, draws=40)
    beyond = 1 - norm.cdf(0.05 / 0.049 * norm.ppf(0.95))
    assert found.attrs["invalid"] == pytest.approx(40 * beyond, abs=1)
    assert found.attrs["outside"] == "poisson_ratio"
    with pytest.raises(ParameterError, match=r"no draw is a valid fault.*slip_distance"):
        draw(KNOWN | {"slip_distance": [-1.0, np.nan]})


@pytest.mark.parametrize(
    "changed, message",
    [
        ({"slip_distance": "5um (6 to 10)"}, "VALUE .LOW to HIGH.*5 and 95 %"),
        ({"slip_distance": "5um (4MPa to 10)"}, "4MPa.*stress.*m is needed"),
        ({"slip_distance": "5um (-4 to 10)"}, r"-4e-06 m .*must lie in \[1e-15"),
        ({"height": "5cm (1 to inf)"}, "finite"),
        ({"slip_distance": 5e-6}, "no parameter has a range"),
        ({"slip_distance": [5e-6, 6e-6], "a": [0.01] * 3}, "equal in number.*slip_distance 2"),
        ({"slip_distance": [[5e-6]]}, "numbers in a row"),
        ({"slip_distance": "5um (4 to 10)", "lenght": 1}, "lenght"),
    ],
)
def test_what_is_wrong_is_named(changed, message):
    with pytest.raises(ParameterError, match=message):
        length_quantiles(**KNOWN | changed)


def test_a_file_of_samples(tmp_path):
    path = tmp_path / "posterior.csv"
    path.write_text("slip_distance (um), f ,normal_stress [MPa],a\n5,0.6,50,0.01\n\n4,.5,40,1e-2\n")
    found = read_samples(path)
    assert found["slip_distance"].tolist() == [5e-6, 4e-6]
    assert found["normal_stress"].tolist() == [5e7, 4e7]
    assert found["friction"].tolist() == [0.6, 0.5] and found["a"].tolist() == [0.01, 0.01]


PLAIN = "slip_distance (um),a\n5,0.01\n4.5,0.02\n"


@pytest.mark.parametrize(
    "text",
    [
        PLAIN.replace(",", ";"),
        PLAIN.replace(",", "\t"),
        PLAIN.replace(",", ";").replace(".", ","),
        PLAIN.replace(",", "\t").replace(".", ","),
        "# of a chain, made on Monday\n" + PLAIN.replace("\n4.5", "\n  # warm\n\n4.5"),
        ",slip_distance (um),a\n0,5,0.01\n1,4.5,0.02\n",
        "Unnamed: 0;slip_distance (um);a\n0;5;0,01\n1;4,5;0,02\n",
        '"","slip_distance (um)","a"\n"1",5,0.01\n"2",4.5,0.02\n',
        "slip_distance (um),a,\n5,0.01,\n4.5,0.02,\n",
        PLAIN.replace("\n", "\r\n"),
        PLAIN.replace("(um)", "(µm)"),
    ],
    ids=["semicolons", "tabs", "semicolons, commas", "tabs, commas", "comments", "pandas' index",
         "named index", "R's index", "empty column", "CRLF", "micro"],
)  # fmt: skip
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
def test_files_of_other_programs(tmp_path, text, encoding):
    path = tmp_path / "posterior.csv"
    path.write_bytes(text.encode(encoding))
    found = read_samples(path)
    assert found.keys() == {"slip_distance", "a"}
    assert found["slip_distance"].tolist() == [5e-6, 4.5e-6] and found["a"].tolist() == [0.01, 0.02]


@pytest.mark.parametrize(
    "text, message",
    [
        ("", "is empty"),
        ("a,b\n", "no row of samples"),
        ("Dc (um)\n5\n", "column 'Dc .um.' is unknown; did you mean slip_distance"),
        ("a-b\n-0.1\n", "column 'a-b' is unknown; give zeta: zeta = b - a"),
        ("E (GPa)\n3\n", r"unknown; give shear_modulus: mu = E/\(2 \(1 \+ nu\)\)"),
        ("slip_distnce (um)\n5\n", "column 'slip_distnce .um.' is unknown.*mean slip_distance"),
        ("slip_distance (MPa)\n5\n", "column 'slip_distance .MPa.'.*stress, but m is needed"),
        ("slip_distance (um),a\n5,.01\n\n6,\n", "line 4, column 'a': the cell is empty"),
        (
            "slip_distance (um)\n5 um\n",
            "line 2, column 'slip_distance .um.': '5 um' is.*uni",
        ),
        ("a,b\n1,2,3\n", "line 2: 3 cells, but the header has 2"),
        ("f,friction\n1,2\n", "line 1: column friction is there twice"),
        ("a\n1,5\n2,5\n", "line 2: 2 cells, but the header has 1; with decimal commas"),
        ("a,b\n0,01,0,02\n", "line 2: 4 cells, but the header has 2; with decimal commas"),
        ("a;b\n0.01;0.02\n0,01;0.02\n", "line 3 has a decimal comma and line 2 a decimal point"),
        ("slip_distance;a\n1.234,5;0.01\n", "line 2, column 'slip_distance'.*thousands"),
        ("a\n1_0\n", "line 2, column 'a': '1_0' is no number"),
        ("a\n1e999\n", "line 2, column 'a': '1e999' is no number"),
        ("# a b\n0.01,0.02\n0.01,0.02\n", "line 2: there is no header"),
        ("a b\n0.01 0.02\n", "line 1: the columns are separated by blanks"),
        ("a;b\n0.01,0.02\n", "line 2: 1 cells.*columns are separated by semicolons"),
        (",a\n7,0.01\n9,0.02\n", "line 1: column 1 has no name, but a value in line 2"),
        ('a,b\n"0.01,0.02\n', "line 2: unexpected end of data"),
        ("a,b\n0.01\0,0.02\n", "is no text file"),
    ],
)
def test_a_file_that_is_wrong(tmp_path, text, message):
    path = tmp_path / "posterior.csv"
    path.write_text(text)
    with pytest.raises(ParameterError, match=message):
        read_samples(path)
