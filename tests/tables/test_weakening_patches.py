"""Weakening patches: the tables of made-up records, and their figure."""

import math

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from asked import critical_length, weakening_patch_length
from configurations import papers
from docs.samples import ROOT

from nucleation.api import Fault
from nucleation.lengths.weakening_patch import patch_answer
from nucleation.model.quantities import ParameterError
from nucleation.simulation.run import simulate
from replication.tables.weakening_patches import (
    bounds_of,
    outcome,
    patch_of,
    patch_outcomes_table,
    period_growth,
    weakening_patches_table,
)

RAISED = 1.02  # W_c by the period, of made-up rows
FASTEST = {"creep": 1.5, "slow slip": 150.0, "event": 800.0}  # over V
DYNAMIC = 2.0 * 0.0068 * 1e6 / 3.1e9 * math.sqrt(3.1e9 / 1200.0) / 1e-5
FAULT = {
    "shear_modulus": 3.1e9,
    "normal_stress": 1e6,
    "a": 0.0068,
    "slip_distance": 5e-7,
    "plane": "antiplane",
}


def runs_of(varies, zeta):
    """The runs with surroundings of one kind and zeta, at the larger V."""
    found = []
    for run in papers().runs_of("weakening_patches"):
        fault = run.run.fault
        own = run.run.heterogeneity.varies, fault.plane, fault.velocity
        around = patch_of(run.run).outside.zeta[0]
        if own == (varies, "antiplane", 1e-5) and around == pytest.approx(zeta):
            found.append(run)
    return found


def made(runs, fastest):
    """The table of runs with these largest slip rates over V."""
    rates = [1e-5 * np.array([1.0, largest]) for largest in fastest]
    records = [xr.Dataset({"maximal_slip_rate": ("step", own)}) for own in rates]
    return weakening_patches_table([run.to_dict() for run in runs], records)


@pytest.fixture(scope="module")
def table():
    """Three runs of one patch width each, with zeta/a = 0.5 and r = 1."""
    return made(runs_of("zeta", -0.0034)[-3:], FASTEST.values())


def test_table_has_the_theory_of_each_patch(table):
    assert table["outcome"].values.tolist() == list(FASTEST)
    assert table["fastest"].values == pytest.approx(list(FASTEST.values()))
    assert table["dynamic_rate"].values == pytest.approx(DYNAMIC)
    fault = FAULT | {"zeta": 0.0034}
    smallest = float(weakening_patch_length(outside_zeta=-0.0034, **fault))
    assert table["smallest_width"].values == pytest.approx(smallest, rel=1e-4)
    critical = float(critical_length(**fault))
    assert table["critical_length"].values == pytest.approx(critical, rel=1e-4)
    assert table["width_ratio"].values == pytest.approx(table["width"].values / smallest, rel=1e-4)
    assert table["strengthening"].values == pytest.approx(1.0)
    state_length = 3.1e9 * 5e-7 / (0.0102 * 1e6)
    cells = table["width"] * table["period"] / table["n_x"]
    assert table["elements"].values == pytest.approx((0.5 * state_length / cells).values, rel=1e-4)


def test_surroundings_of_another_a():
    """b is the same, so that a of the surroundings is a + zeta + r zeta."""
    table = made(runs_of("a", -0.0068)[:1], [1.0])
    assert float(table["zeta_over_a"][0]) == pytest.approx(0.5)
    assert float(table["outside_a"][0]) == pytest.approx(0.0068 * 2.5)
    fault = FAULT | {"zeta": 0.0034}
    smallest = weakening_patch_length(outside_zeta=-0.0068, outside_a=0.017, **fault)
    assert float(table["smallest_width"][0]) == pytest.approx(float(smallest), rel=1e-4)


def test_outcomes():
    for name, fastest in FASTEST.items():
        assert outcome(fastest, DYNAMIC) == name
    assert outcome(DYNAMIC, DYNAMIC, dropped=True) == "event"
    assert outcome(0.4 * DYNAMIC, DYNAMIC, dropped=True) == "undecided"


@pytest.mark.parametrize(
    ("part", "expected"), [(0.49, "slow slip"), (0.51, "undecided"), (0.99, "undecided")]
)
def test_slip_nearly_as_fast_as_in_an_event_is_undecided(part, expected):
    """With other steps it is up to twice as fast."""
    assert outcome(part * DYNAMIC, DYNAMIC) == expected


def row(ratio, outcome, velocity=1e-5):
    period = {"period_ratio": ratio / RAISED}
    return {"width_ratio": ratio, "outcome": outcome, "velocity": velocity} | period


@pytest.mark.parametrize(
    ("rows", "bounds"),
    [
        ([row(0.9, "creep"), row(1.1, "slow slip"), row(1.3, "event", 1e-9)], (1.1, 1.3)),
        ([row(1.1, "slow slip"), row(1.2, "slow slip", 1e-9), row(1.3, "event", 1e-9)], (1.1, 1.3)),
        ([row(1.1, "event"), row(1.2, "slow slip", 1e-9), row(1.3, "event", 1e-9)], (1.0, 1.3)),
        ([row(1.1, "slow slip"), row(1.2, "event"), row(1.3, "slow slip", 1e-9)], (1.1, math.inf)),
        (
            [
                row(1.1, "slow slip"),
                row(1.2, "undecided"),
                row(1.3, "slow slip"),
                row(1.4, "undecided", 1e-9),
                row(1.5, "event", 1e-9),
            ],
            (1.1, 1.5),
        ),
        (
            [
                row(1.1, "slow slip"),
                row(1.4, "event"),
                row(1.5, "slow slip"),
                row(1.6, "event", 1e-9),
                row(1.8, "event", 1e-9),
            ],
            (1.1, 1.6),
        ),
    ],
)
def test_bounds(rows, bounds):
    """Slow slip ends below the first event at any V, and events begin above the last slow slip."""
    slow, events = bounds
    assert bounds_of(pd.DataFrame(rows)) == pytest.approx((max(1.0, slow / RAISED), events))


def test_bounds_of_each_friction(table):
    (found,) = patch_outcomes_table(table).to_dataframe().to_dict("records")
    assert (found["varies"], found["zeta_over_a"], found["strengthening"]) == ("zeta", 0.5, 1.0)
    assert found["slow_slip_up_to"] == pytest.approx(table["period_ratio"].values[1])
    assert found["events_from"] == pytest.approx(table["width_ratio"].values[2])


OTHERS = [{"heterogeneity": "friction", "change": 0.5}, {"shape": "bump"}]


@pytest.mark.parametrize("change", OTHERS)
def test_other_heterogeneity_is_refused(change):
    run = runs_of("zeta", -0.0034)[0].run.replaced(**change)
    with pytest.raises(ParameterError, match="it must be zeta or a with a step"):
        patch_of(run)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("elements", "said", "simulated"),
    [(12, "it creeps", "creep"), (14, "slow slip or events", "slow slip"), (22, "events", "event")],
)
def test_what_is_said_of_a_patch_agrees_with_a_coarse_simulation(elements, said, simulated):
    """zeta/a = 0.5 and r = 1 on half of the study's elements: 0.97, 1.13 and 1.77 W_c."""
    study = runs_of("zeta", -0.0034)[-1].run
    number = study.block.n_x // 2 + 1
    width = elements * study.block.length / number
    run = study.replaced(n_x=number, n_y=10, width=width)
    record = [{"id": "coarse", "parameters": run.to_dict()}]
    table = weakening_patches_table(record, [simulate(run)])
    assert table["outcome"].values == [simulated]
    fault = Fault(**FAULT, zeta=0.0034, velocity=1e-5, height=study.fault.height)
    assert patch_answer(fault, -0.0034, width=width)["outcome"].startswith(said)


@pytest.mark.slow
def test_periods_of_the_study_raise_the_critical_width_by_little():
    """W_c of a period by all Fourier modes, odd ones too, is that of the table's even ones."""
    rows = pd.read_csv(ROOT / "results" / "reference" / "weakening_patches.csv")
    for _, own in rows.groupby(["varies", "zeta_over_a", "strengthening", "plane"]):
        row = own.iloc[0]
        unit = row["critical_length"] * row["zeta_over_a"] / np.pi
        raised = row["width_ratio"] / row["period_ratio"]
        assert 0.997 < raised < 1.025
        width, period = raised * row["smallest_width"] / unit, row["period"] * row["width"] / unit
        outside = row["outside_a"] / row["a"], -row["strengthening"] * row["zeta_over_a"]
        assert growth(0.99 * width, period, row["zeta_over_a"], *outside) < 0.0
        assert growth(1.01 * width, period, row["zeta_over_a"], *outside) > 0.0


@pytest.mark.parametrize(
    ("zeta", "around"), [(0.5, (1.0, -0.5)), (2.3, (1.0, -0.23)), (0.5, (2.5, -1.0))]
)
def test_a_long_period_has_the_critical_width_of_half_spaces(zeta, around):
    """Lengths in units of mu* D/(a sigma0), in which L_c is pi over zeta/a."""
    a, b = FAULT["a"], around[0] * FAULT["a"]
    fault = FAULT | {"zeta": zeta * a}
    width = float(weakening_patch_length(outside_zeta=around[1] * a, outside_a=b, **fault))
    width *= np.pi / zeta / float(critical_length(**fault))
    assert period_growth(0.99 * width, 60.0 * width, zeta, *around) < 0.0
    assert period_growth(1.01 * width, 60.0 * width, zeta, *around) > 0.0


def growth(width, period, zeta, outside_a, outside_zeta):
    """The largest growth rate of a patch among two layers as high as half a period, over V/D."""
    n = np.arange(-60, 61)
    k = 2.0 * np.pi * np.abs(n) / period
    apart = np.subtract.outer(n, n)
    within = width / period * np.sinc(apart * width / period)
    around = np.eye(n.size) - within
    inverse = np.linalg.inv(within + outside_a * around)
    stiffness = np.diag(0.5 * k * np.tanh(0.5 * k * period))
    damping = inverse @ (stiffness - zeta * within - outside_zeta * around)
    nothing = np.zeros_like(stiffness)
    companion = np.block([[nothing, np.eye(n.size)], [-inverse @ stiffness, -damping]])
    rates = np.linalg.eigvals(companion)
    return rates[np.abs(rates) > 1e-9].real.max()  # without the uniform slip
