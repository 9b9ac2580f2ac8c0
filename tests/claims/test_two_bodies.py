"""Verdicts on two bodies follow from the table of pairs."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from reference_evidence import PAIRED, REFERENCE, in_pairs
from reference_evidence import modes as modes_of
from reference_evidence import table as of_reference

from replication.claims import printed
from replication.claims import table as table_of_claims

FOUND = PAIRED["two bodies, simulated"]


def table(ratio=0.8, slope=-1.0):
    contrast = np.array([0.0, 0.1, 0.3, -0.1, -0.3])
    same = {
        "strength": 1e-5,
        "kind": "normal_load",
        "study": "pairs",
        "seed": 0,
        "length": 0.5 * ratio,
        "stability_ratio": 0.5,
        "poisson_ratio": 1.0 / 3.0,
    }
    columns = {name: [value] * 7 for name, value in same.items()} | {
        "role": ["pairs_identical"] * 2 + ["pairs_contrast"] * 5,
        "height": [0.01, *[1.0] * 6],
        "critical_length": [0.1, *[0.5] * 6],
        "length_ratio": [0.3, *[ratio] * 6],
        "half_space_ratio": [1.0, 1.0, *(1.0 + slope * np.abs(contrast))],
        "f_beta": [0.0, 0.0, *contrast],
        "zeta_over_a": [2.4, 2.4, *[3.0] * 5],
        "id": [f"run-{i}" for i in range(7)],
        "ensemble": [f"{i}" for i in range(7)],
    }
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


def repeated(table, factors):
    """The same faults in several realisations, with lengths that differ by these factors."""
    runs = np.tile(np.arange(table.sizes["run"]), len(factors))
    many = np.repeat(factors, table.sizes["run"])
    found = table.isel(run=runs).assign(seed=("run", np.arange(runs.size)))
    return found.assign({name: found[name] * many for name in ("length", "length_ratio")})


def modes(g1=1.0, g2=1.0, name="half-spaces"):
    """Rates of one mode of each of two pairs, with these multiples of the response of Eq. (7)."""
    f, a, zeta = 0.41, 0.0068, 0.016
    ell = 5e-7  # m
    v = 1e-5  # m/s
    sigma0 = 1e6  # Pa
    mu = 3.1e9  # Pa
    k = 10.0  # 1/m
    psi = np.array([3.0, 0.4])
    nu = (0.25, 0.1)
    expected = np.array([printed.bimaterial_transfer(x, *nu) for x in psi])
    response = expected @ [g1, -1j * f * g2]
    load = mu * k * ell / sigma0 * response  # Eq. (5): a l^2 + (load - zeta) l + load = 0
    rates = np.array([np.roots([a, x - zeta, x]) for x in load]) * v / ell
    same = {
        "id": name,
        "shear_modulus": mu,
        "poisson_ratio": nu[0],
        "second_poisson_ratio": nu[1],
        "friction": f,
        "a": a,
        "zeta": zeta,
        "slip_distance": ell,
        "velocity": v,
        "normal_stress": sigma0,
        "mode_wavenumber": k,
    }
    found = {name: ("run", np.array([value] * 2)) for name, value in same.items()}
    found["second_shear_modulus"] = "run", psi * mu
    found["measured_growth"] = ("run", "branch"), rates.real
    found["measured_frequency"] = ("run", "branch"), rates.imag
    return xr.Dataset(found)


def judged(name, table=None, modes_=None):
    evidence = {"pairs": table, "modes": modes_}
    return table_of_claims.evaluate_one(name, FOUND[name], evidence)


@pytest.mark.parametrize(
    ("factors", "verdict", "reach"),
    [
        ((0.95, 1.0, 1.05), "replicated", "across the bound, 0.75"),
        ((0.93, 0.92, 1.01), "not supported", "across the bound, 0.75"),
        ((0.99, 1.0, 1.01), "replicated", None),
    ],
)
def test_the_mean_of_the_realisations_decides_for_any_range(factors, verdict, reach):
    row = judged("pairs-half-spaces", repeated(table(0.77), factors))
    assert row["verdict"] == verdict
    assert judged("pairs-bimaterial", repeated(table(0.77), factors))["verdict"] == verdict
    assert row["ours"] == pytest.approx(0.77 * np.mean(factors))
    assert row["uncertainty"] == pytest.approx([0.77 * min(factors), 0.77 * max(factors)])
    assert ("reaches" in row["reason"]) == bool(reach) and (reach or "") in row["reason"]


def test_the_two_senses_are_separate():
    row = judged("pairs-smaller", senses((0.7, 1.2), (0.5, 0.6)))
    assert row["ours"] == 1.2
    row = judged("pairs-bimaterial", senses((0.7, 1.2), (0.5, 0.6)))
    assert (row["ours"], row["uncertainty"]) == (0.5, [0.5, 0.5])  # of that pair alone


@pytest.mark.parametrize(("slope", "verdict"), [(-1.0, "replicated"), (0.2, "not supported")])
def test_contrast_has_to_shorten(slope, verdict):
    row = judged("pairs-decreasing", table(slope=slope))
    assert row["verdict"] == verdict
    assert row["ours"] == pytest.approx(0.8 * slope)
    assert judged("pairs-smaller", table(1.2, slope=0.2))["verdict"] == "not supported"


@pytest.mark.parametrize(
    ("factors", "verdicts"),
    [
        ((1.005, 0.995), ("replicated", "replicated")),
        ((1.02, 1.0), ("not replicated", "replicated")),
        ((1.0, -1.0), ("replicated", "not replicated")),
    ],
)
def test_the_response_of_half_spaces_is_read_from_the_rates(factors, verdicts):
    for name, factor, verdict in zip(("pairs-g1", "pairs-g2"), factors, verdicts, strict=True):
        row = judged(name, modes_=modes(*factors))
        assert (row["verdict"], row["ours"]) == (verdict, pytest.approx(factor))


@pytest.mark.parametrize(("higher", "left_out"), [(1.0, False), (1.09, False), (1.2, True)])
def test_a_length_that_depends_on_the_height_decides_nothing(higher, left_out):
    """Identical blocks with the zeta/a of the pairs, twice as high, in another study."""
    pairs = table(1.2, slope=0.2)
    identical = pairs.isel(run=[2])
    names = {"role": "pairs_weak", "ensemble": "taller", "id": "taller"}
    taller = identical.assign({name: ("run", [value]) for name, value in names.items()})
    for name, factor in (("height", 2.0), ("length_ratio", higher)):
        taller[name] = factor * identical[name]
    row = judged("pairs-smaller", xr.concat([pairs, taller], "run"))
    assert row["verdict"] == ("cannot be checked" if left_out else "not supported")
    other = pairs.isel(run=slice(2, None))
    ids = "run", [f"other-{i}" for i in range(5)]
    other = other.assign(length_ratio=0.7 * other["length_ratio"], ensemble=ids, id=ids)
    other = other.assign(zeta_over_a=0.0 * other["zeta_over_a"] + 10.0)
    row = judged("pairs-smaller", xr.concat([pairs, taller, other], "run"))
    assert row["verdict"] == ("replicated" if left_out else "not supported")


def senses(below, above):
    """Lengths over L_c^M with the stiffer body below and above, at contrasts of 0.1 and 0.3."""
    lengths = np.array([0.7, 0.7, 0.6, below[0], below[1], above[0], above[1]])
    found = table()
    return found.assign(length_ratio=("run", lengths), half_space_ratio=("run", np.ones(7)))


def test_the_modulus_is_judged_by_the_mean_of_both_senses():
    row = judged("pairs-modulus", senses((0.7, 0.9), (0.5, 0.6)))
    assert row["verdict"] == "not supported" and row["ours"] == pytest.approx(0.75 / 0.6)
    row = judged("pairs-modulus", senses((0.7, 0.75), (0.5, 0.55)))
    assert row["verdict"] == "replicated" and row["ours"] == pytest.approx(0.65 / 0.6)


def test_the_contrast_is_judged_by_the_difference_of_the_senses():
    def lengths(effect):
        return 0.6 * (1.0 + effect), 0.6 * (1.0 - effect)

    for large, verdict in ((0.15, "replicated"), (0.1, "not supported")):
        ends = [lengths(0.05), lengths(large)]
        row = judged("pairs-contrast", senses(*zip(*ends, strict=True)))
        assert row["verdict"] == verdict and row["ours"] == pytest.approx(large / 0.15)


def test_both_senses_are_needed():
    found = senses((0.7, 0.9), (0.5, 0.6)).isel(run=slice(0, 6))
    row = judged("pairs-modulus", found)
    assert row["verdict"] == "cannot be checked" and "lacks a sense" in row["reason"]


def test_without_runs_nothing_is_judged():
    empty = table().isel(run=slice(0, 1))
    evidence = {"pairs": empty, "modes": modes(name="stiff above, clamped")}
    rows = table_of_claims.evaluate(in_pairs(PAIRED), evidence)
    assert {row["verdict"] for row in rows} == {"cannot be checked"}


def test_every_equation_on_two_bodies_has_a_simulated_verdict():
    """On the committed tables; without a verdict, the reason explains why."""
    rows = pd.read_csv(REFERENCE / "claims_pairs.csv").set_index("id")
    places = " ".join(rows["where"])
    assert all(name in places for name in ("(6)", "(7)", "(8)", "(9)", "Fig. 2"))
    assert list(rows.index) == list(FOUND)
    evidence = {"pairs": of_reference("pairs.csv"), "modes": modes_of("pair_modes.csv")}
    for row in table_of_claims.evaluate(in_pairs(PAIRED), evidence):
        assert row["verdict"] == rows.loc[row["id"], "verdict"]
        assert row["ours"] == pytest.approx(rows.loc[row["id"], "ours"], rel=1e-4)
