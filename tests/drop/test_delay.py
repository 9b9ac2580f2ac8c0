"""The law of the drop against its closed form, against realisations, and against a simulation."""

import dataclasses
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from configurations import CONFIG, papers

from nucleation.drop.continued import complex_trend, continued, exponent_of, roughness_weights
from nucleation.drop.delay import SAMPLED, TINY, grown, growth
from nucleation.drop.mode_history import ModeHistory, followed, mode_history
from nucleation.extraction.extraction import extract
from nucleation.model.realisations import Series, Sheet, profile, spectral_density
from nucleation.model.settings import Perturbation
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.run import simulate

PARAMETERS = PAPER_RUN.replaced(height=0.02, block_length=2.7, n_x=400, n_y=8)
START, SPEED, SLOPE, FREQUENCY = 0.25, 0.014, 50.0, 11.0  # L_s, dL/dt, d Re Lambda/dL, Im Lambda
LOAD = Perturbation(kind="normal_load", strength=1e-5)


def history(share=600.0):
    """A mode whose growth is linear in the length of a patch that grows steadily."""
    x = np.linspace(0.0, 2.7, 401)
    length = np.linspace(0.18, 0.33, 40)
    along_x = np.zeros((40, 401), dtype=complex)
    along_x[:, :30] = 0.1
    rate = SLOPE * (length - START) + 1j * FREQUENCY
    constant = np.full(40, share, dtype=complex)
    time = (length - 0.18) / SPEED
    return ModeHistory(
        PARAMETERS.patches, x, time, length, rate, constant, constant, along_x, along_x
    )


def realised(history, declared):
    """How the mode grows in the realisation of the declared seed; its strength is not used."""
    path = continued(history)
    if declared.kind == "strength":
        x = np.arange(0.0, path.length[-1], declared.correlation_length / SAMPLED)
        rough = profile(declared.seed, declared.correlation_length, x)
        sums = ((log, float(abs(a @ rough))) for log, a in roughness_weights(history, path, x))
        return grown(path, np.array([log + np.log(max(s, TINY)) for log, s in sums]))
    return grown(path, log_integrated(path, forcing(history, path, declared)))


def forcing(history, path, declared):
    """``g xi`` (1/s) at the times of a path, for the seed of a forcing in time."""
    memory, seed = history.patches.memory, declared.seed
    time = declared.correlation_time * memory
    if declared.kind == "state":
        sheet = Sheet(seed, time, declared.correlation_length, history.x)
        state = complex_trend(history, history.state / memory)
        places = zip(path.length, path.time, strict=True)
        return np.array([state(length) @ sheet.values(t) for length, t in places])
    series = Series(seed, time)
    if declared.kind == "normal_load":
        weights = complex_trend(history, history.normal_load)
        return weights(path.length) * [series.value(t) for t in path.time]
    weights = complex_trend(history, history.drive * history.patches.velocity)
    return weights(path.length) * [series.integral(t) for t in path.time]


def log_integrated(path, forcing):
    """log|A| (per strength) from ``dA/dt = Lambda A + forcing``, from zero on, without overflow."""
    exponent, step = exponent_of(path), path.time[1] - path.time[0]
    seeds = np.cumsum(step * forcing * np.exp(-exponent))
    return exponent.real + np.log(np.maximum(np.abs(seeds), TINY))


def length_at(law, amplitude):
    """Length (m) at which the amplitude per strength last passes a value."""
    level = np.log(amplitude)
    last = np.flatnonzero(law.log_amplitude < level)[-1]
    around = slice(last, last + 2)
    return np.interp(level, law.log_amplitude[around], law.length[around])


def exact_median(strength, share=600.0):
    density = spectral_density(FREQUENCY, 0.05)
    gathered = np.sqrt(np.log(2.0) * density) * (np.pi / (SLOPE * SPEED)) ** 0.25
    effective = strength * share * gathered
    return START + np.sqrt(2.0 * SPEED * np.log(1.0 / effective) / SLOPE)


@pytest.mark.parametrize("strength", [1e-10, 1e-7, 1e-5])
def test_linear_growth_gives_the_closed_form(strength):
    found = growth(history(), LOAD)
    drop, closed = found.drop(strength), found.closed_form(history(), strength)
    assert np.isnan(found.drop(1e-300).length)  # where the law does not reach
    assert drop.length == pytest.approx(exact_median(strength), rel=2e-3)
    assert closed.length == pytest.approx(exact_median(strength), rel=2e-3)
    assert closed.front_length == pytest.approx(START, rel=1e-3)
    assert drop.low < drop.length < drop.high


def test_drops_come_once_in_a_period_at_any_phase():
    """Against drawn amplitudes and phases: Rayleigh ones, and even ones over a period's growth."""
    law, strength, generator = growth(history(), LOAD), 1e-5, np.random.default_rng(5)
    amplitudes = np.sqrt(-np.log(generator.uniform(size=4000)))
    reached = np.array([length_at(law, 1.0 / (strength * a)) for a in amplitudes])
    period = SPEED * 2.0 * np.pi / FREQUENCY
    drops = reached + period * generator.uniform(-0.5, 0.5, size=4000)
    found = law.drop(strength)
    assert (found.low, found.length, found.high) == pytest.approx(
        tuple(np.quantile(drops, [0.16, 0.5, 0.84])), abs=0.03 * period
    )
    assert np.quantile(reached, 0.84) - np.quantile(reached, 0.16) < 0.9 * (found.high - found.low)


@pytest.mark.parametrize(
    "kind", ["drive_velocity", "normal_load", pytest.param("state", marks=pytest.mark.slow)]
)
def test_mean_square_of_realisations(kind):
    declared = Perturbation(kind=kind, strength=1e-5, correlation_length=0.05)
    mean = growth(history(), declared)
    late = int(0.8 * mean.time.size)
    squares = [
        np.exp(2 * realised(history(), dataclasses.replace(declared, seed=s)).log_amplitude[late])
        for s in range(24)
    ]
    assert np.mean(squares) == pytest.approx(np.exp(2 * mean.log_amplitude[late]), rel=0.6)


@pytest.fixture(scope="module")
def own():
    return mode_history(PARAMETERS.patches, 0.4509, PARAMETERS.fault.initial_state)


def test_less_friction_everywhere_is_as_more_load(own):
    assert own.rate.real[0] < 0.0 < own.rate.real[-1]
    np.testing.assert_allclose(own.normal_load, own.strength.sum(axis=1), rtol=0.05)


@pytest.mark.slow
def test_a_perturbed_run_drops_where_its_own_realisation_says(own):
    declared = Perturbation(kind="state", strength=1e-3, seed=4)
    run = PARAMETERS.replaced(
        n_x=400, n_y=6, grading=20.0, end_time=60.0, time_after_event=0.0, longest_step=0.1
    )
    run = replace(run, perturbation=declared)
    measured = extract(simulate(run))
    expected = length_at(realised(own, declared), 1e3)
    assert measured["length"] == pytest.approx(expected, rel=0.05)


RUNS = {run.id: run for run in papers().runs}
TABLE = pd.read_csv(CONFIG.parent / "results" / "reference" / "drop.csv")
TABLE = TABLE[(TABLE.strength > 0.0) & TABLE.id.isin(list(RUNS))]
KIND = ["evolution", "height", "kind", "strength", "correlation_length"]


def drops(table):
    """The law's drop for each kind of run, with means of the simulated and the table's."""
    histories, rows = {}, []
    for _, same in table.groupby(KIND):
        run, first = RUNS[same.id.iloc[0]], same.iloc[0]
        fault = first.evolution, first.height
        if fault not in histories:
            histories[fault] = mode_history(
                run.run.patches, run.critical_length, run.run.fault.initial_state
            )
        declared = run.run.perturbation
        drop = growth(histories[fault], declared).drop(declared.strength)
        rows.append((same.length.mean(), same.law_length.mean(), drop.length))
    return np.array(rows).T


def test_one_fault_under_each_kind():
    """Normal load, state and drive, 1e-5: sixteen seeds each, six of the drive."""
    known = TABLE[(TABLE.evolution == "aging") & (TABLE.height == 0.02) & (TABLE.strength == 1e-5)]
    simulated, tabulated, found = drops(known[known.kind != "strength"])
    assert simulated.size == 3
    assert found == pytest.approx(simulated, rel=0.01)
    assert found == pytest.approx(tabulated, rel=1e-6)


@pytest.mark.slow
def test_all_kinds_heights_and_laws():
    simulated, tabulated, found = drops(TABLE[TABLE.strength < 2e-4])
    off = 100.0 * (found / simulated - 1.0)
    assert np.sqrt(np.mean(off**2)) < 0.8 and np.abs(off).max() < 2.1
    assert found == pytest.approx(tabulated, rel=1e-6)


def test_a_mode_is_followed_until_its_rate_jumps():
    """To another mode, or where it leaves its oscillation behind."""
    length = np.linspace(0.8, 1.2, 9)
    pair = 40.0 * (length - 1.0) + 1j * np.sqrt(np.maximum(100.0 - 4e3 * (length - 1.0) ** 2, 0.0))
    alone = np.where(pair.imag > 0.0, pair, np.nan)
    assert followed(length, alone, 1.01).tolist() == [1, 2, 3, 4, 5, 6]
    with_another = np.where(pair.imag > 0.0, pair, -4e4 + 300j)
    assert followed(length, with_another, 1.01).tolist() == [1, 2, 3, 4, 5, 6]
    assert followed(length, np.full(9, np.nan + 0j), 1.01).size == 0
